#include "dynamics/inverse_kinematics.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/dense.hpp"
#include "core/error.hpp"
#include "dynamics/kinematics.hpp"

namespace chainreel {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr int kStarts = 48;        // along the common bend of the joints behind the first
constexpr int kBends = 192;        // of it, between which it is sought
constexpr int kHalvings = 60;
constexpr int kSlideStarts = 9;    // of a first joint that slides
constexpr int kTried = 8;          // starts, the nearest first
constexpr int kMostSteps = 200;
constexpr double kOnLimit = 1e-9;  // rad or m: what a joint may pass its limit by round-off

bool slides(const Body& body) {
  return body.joint.kind == JointKind::prismatic;
}

// In (-pi, pi].
double wrapped(double angle) {
  const double turned = std::remainder(angle, 2 * kPi);
  return turned <= -kPi ? turned + 2 * kPi : turned;
}

double lower(const Body& body) {
  return slides(body) ? body.joint.limit.lower : -kPi;
}
double upper(const Body& body) {
  return slides(body) ? body.joint.limit.upper : kPi;
}

}  // namespace

PointSolver::PointSolver(const Chain& chain, Elbow elbow)
    : chain_(chain), elbow_(elbow), ws_(chain), at_rest_(std::size_t(chain.nv), 0.0) {
  const auto refuse = [&](const std::string& why) {
    throw Error(ExitCode::usage, "a field needs a planar chain of two or three joints: " + chain.name + " " + why);
  };
  if (!chain.planar) refuse("moves in space");
  if (!chain.serial || chain.has_mimic || chain.has_floating || chain.nv < 2 || chain.nv > 3)
    refuse("has " + std::to_string(chain.nv) + " freedoms, or branches, or joints that are tied to others");
  for (std::size_t b = 1; b < chain.bodies.size(); ++b) {
    const Body& body = chain.bodies[b];
    if (slides(body) && !(std::isfinite(body.joint.limit.lower) && std::isfinite(body.joint.limit.upper)))
      refuse("has the sliding joint '" + body.joint.name +
             "' without limits, so that its workspace has no end: give it <limit lower= upper=>");
  }
  ex_ = chain.planar->plane.ex;
  ey_ = chain.planar->plane.ey;
  find_reach();
  if (chain.nv == 2) make_starts();
}

Eigen::Vector2d PointSolver::tip(const std::vector<double>& q) {
  compute_kinematics(chain_, ws_, q, at_rest_);
  return in_plane(frame_position(chain_, ws_, chain_.end_effector));
}

double PointSolver::joint_sign(int body) const {
  return chain_.planar->bodies[std::size_t(body)].sign;
}

// Distances between joints do not depend on the pose but for what slides.
void PointSolver::find_reach() {
  std::vector<double> q(std::size_t(chain_.nq), 0.0);
  double sliding = 0;
  for (std::size_t b = 1; b < chain_.bodies.size(); ++b) {
    const Body& body = chain_.bodies[b];
    if (!slides(body)) continue;
    q[std::size_t(body.joint.q_index)] = (lower(body) + upper(body)) / 2;
    sliding += (upper(body) - lower(body)) / 2;
  }
  const Eigen::Vector2d end = tip(q);
  Eigen::Vector2d before = in_plane(ws_.X_WB[1].translation());
  middle_ = before.x() * ex_ + before.y() * ey_;
  reach_ = sliding;
  for (std::size_t b = 2; b < chain_.bodies.size(); ++b) {
    const Eigen::Vector2d here = in_plane(ws_.X_WB[b].translation());
    reach_ += (here - before).norm();
    before = here;
  }
  reach_ += (end - before).norm();
}

void PointSolver::bend_alike(std::vector<double>& q, double s) const {
  for (std::size_t b = 2; b < chain_.bodies.size(); ++b) {
    const Body& body = chain_.bodies[b];
    const double bend = (elbow_ == Elbow::up ? -1 : 1) * joint_sign(int(b)) * s * kPi;
    q[std::size_t(body.joint.q_index)] = slides(body) ? lower(body) + s * (upper(body) - lower(body)) : bend;
  }
}

void PointSolver::make_starts() {
  const Body& first = chain_.bodies[1];
  const int firsts = slides(first) ? kSlideStarts : 1;
  for (int i = 0; i < firsts; ++i)
    for (int k = 0; k < kStarts; ++k) {
      Start start{std::vector<double>(std::size_t(chain_.nq), 0.0), {}};
      if (slides(first)) start.q[0] = lower(first) + (i + 0.5) / firsts * (upper(first) - lower(first));
      bend_alike(start.q, (k + 0.5) / kStarts);
      start.tip = tip(start.q);
      starts_.push_back(std::move(start));
    }
}

// Within the limits of the joints, and there.
bool PointSolver::accept(std::vector<double>& q, const Eigen::Vector2d& point) {
  for (std::size_t b = 1; b < chain_.bodies.size(); ++b) {
    const Body& body = chain_.bodies[b];
    double& value = q[std::size_t(body.joint.q_index)];
    if (!slides(body)) value = wrapped(value);
    if (value < body.joint.limit.lower - kOnLimit || value > body.joint.limit.upper + kOnLimit) return false;
  }
  return (tip(q) - point).norm() <= kReached;
}

std::optional<std::vector<double>> PointSolver::closed_form(const Eigen::Vector2d& point) {
  std::vector<double> q(2, 0.0);
  const Eigen::Vector2d end = tip(q);
  const Eigen::Vector2d base = in_plane(ws_.X_WB[1].translation()), elbow = in_plane(ws_.X_WB[2].translation());
  const Eigen::Vector2d a = elbow - base, b = end - elbow, d = point - base;
  const double c = (d.squaredNorm() - a.squaredNorm() - b.squaredNorm()) / (2 * a.norm() * b.norm());
  // Above its own joint the direction of the first link is free.
  if (!(std::abs(c) <= 1) || d.norm() < kReached) return std::nullopt;
  const auto angle = [](const Eigen::Vector2d& v) { return std::atan2(v.y(), v.x()); };
  const double turn = (elbow_ == Elbow::up ? -1 : 1) * std::acos(c);  // from the first link to the second
  const double second = turn - (angle(b) - angle(a));
  // The end effector seen from the base, with the first joint at zero.
  const Eigen::Vector2d seen = a + Eigen::Rotation2Dd(second) * b;
  q[0] = joint_sign(1) * (angle(d) - angle(seen));
  q[1] = joint_sign(2) * second;
  if (!accept(q, point)) return std::nullopt;
  return q;
}

// Levenberg-Marquardt: the damping falls with each step that comes nearer.
bool PointSolver::improve(std::vector<double>& q, const Eigen::Vector2d& point) {
  double damping = 1e-3 * reach_ * reach_;
  Eigen::Vector2d error = point - tip(q);
  for (int step = 0; step < kMostSteps && error.norm() > kReached / 10; ++step) {
    compute_jacobian(chain_, ws_, q, chain_.end_effector, Task::linear);
    const Eigen::Matrix2d JJt = ws_.J * ws_.J.transpose() + damping * Eigen::Matrix2d::Identity();
    const Eigen::VectorXd dq = ws_.J.transpose() * solve_symmetric(JJt, error);
    std::vector<double> next = q;
    for (std::size_t i = 0; i < next.size(); ++i) next[i] += dq(Eigen::Index(i));
    const Eigen::Vector2d left = point - tip(next);
    if (left.norm() < error.norm()) {
      q = next;
      error = left;
      damping /= 10;
    } else {
      damping = std::max(damping, 1e-16 * reach_ * reach_) * 10;
      if (damping > 1e6 * reach_ * reach_) return false;
    }
  }
  return error.norm() <= kReached;
}

// The first joint changes neither how far the end effector is from it, where it turns, nor how far it is across its way, where it slides: the least common bend
// at which that is right.
std::optional<std::vector<double>> PointSolver::bent_alike(const Eigen::Vector2d& point) {
  const bool turns = !slides(chain_.bodies[1]);
  std::vector<double> q(std::size_t(chain_.nq), 0.0);
  const Eigen::Vector2d base = in_plane(middle_), d = point - base;
  tip(q);
  const Eigen::Vector2d way = in_plane(ws_.X_WB[1].linear() * chain_.bodies[1].joint.axis), across(-way.y(), way.x());
  const auto off = [&](double s) {
    bend_alike(q, s);
    const Eigen::Vector2d end = tip(q);
    return turns ? (end - base).norm() - d.norm() : across.dot(end - point);
  };
  const auto moved_there = [&]() -> std::optional<std::vector<double>> {
    std::vector<double> there = q;
    const Eigen::Vector2d end = tip(q), seen = end - base;
    if (!turns)
      there[0] += way.dot(point - end);
    else if (d.norm() > kReached)
      there[0] += joint_sign(1) * (std::atan2(d.y(), d.x()) - std::atan2(seen.y(), seen.x()));
    if (accept(there, point)) return there;
    return std::nullopt;
  };
  // There the distance touches zero in place of passing it.
  if (turns && d.norm() <= kReached) {
    double best = 0;
    for (int k = 1; k <= kBends; ++k)
      if (off(double(k) / kBends) < off(best)) best = double(k) / kBends;
    double low = std::max(best - 1.0 / kBends, 0.0), high = std::min(best + 1.0 / kBends, 1.0);
    for (int i = 0; i < 2 * kHalvings; ++i) {
      const double left = low + (high - low) / 3, right = high - (high - low) / 3;
      if (off(left) < off(right))
        high = right;
      else
        low = left;
    }
    off((low + high) / 2);
    return moved_there();
  }
  double last = 0, at_last = off(0);
  if (std::abs(at_last) <= kReached / 10)
    if (auto found = moved_there()) return found;
  for (int k = 1; k <= kBends; ++k) {
    const double next = double(k) / kBends, at_next = off(next);
    if ((at_last > 0) != (at_next > 0)) {
      double low = last, high = next;
      for (int i = 0; i < kHalvings; ++i) {
        const double middle = (low + high) / 2;
        ((off(middle) > 0) == (at_last > 0) ? low : high) = middle;
      }
      off(high);
      if (auto found = moved_there()) return found;
    }
    last = next, at_last = at_next;
  }
  return std::nullopt;
}

std::optional<std::vector<double>> PointSolver::pose_at(const Eigen::Vector3d& where) {
  const Eigen::Vector2d point = in_plane(where), base = in_plane(middle_), d = point - base;
  if (d.norm() > reach_) return std::nullopt;
  const bool turns = !slides(chain_.bodies[1]);
  if (chain_.nv == 2 && turns && !slides(chain_.bodies[2])) return closed_form(point);
  if (chain_.nv == 3) return bent_alike(point);

  // A first joint that turns brings each start into the direction of the point.
  std::vector<std::pair<double, const Start*>> order;
  for (const Start& start : starts_) {
    const double off = turns ? std::abs((start.tip - base).norm() - d.norm()) : (start.tip - point).norm();
    order.emplace_back(off, &start);
  }
  const auto tried = order.begin() + std::min<std::ptrdiff_t>(kTried, std::ptrdiff_t(order.size()));
  std::partial_sort(order.begin(), tried, order.end());
  for (auto it = order.begin(); it != tried; ++it) {
    std::vector<double> q = it->second->q;
    if (turns && d.norm() > kReached) {
      const Eigen::Vector2d s = it->second->tip - base;
      q[0] += joint_sign(1) * (std::atan2(d.y(), d.x()) - std::atan2(s.y(), s.x()));
    }
    if (improve(q, point) && accept(q, point)) return q;
  }
  return std::nullopt;
}

}  // namespace chainreel
