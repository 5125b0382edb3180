#include "sim/choice/deviation.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/dense.hpp"
#include "core/error.hpp"
#include "core/scalar.hpp"
#include "dynamics/kinematics.hpp"

namespace chainreel {
namespace {

constexpr double kPixels = 1080;      // a page's height
constexpr double kFitMargin = 0.06;   // of the box, on every side
constexpr double kPage = 16.0 / 9.0;  // width over height
constexpr double kLeastSize = 1e-6;   // m: what has no extent; pictures show it a metre high

// In the plane of a planar chain, else in the world.
void axes_of(const Chain& chain, Eigen::Vector3d& x, Eigen::Vector3d& y) {
  x = chain.planar ? chain.planar->plane.ex : Eigen::Vector3d::UnitX();
  y = chain.planar ? chain.planar->plane.ey : Eigen::Vector3d::UnitY();
}

PictureSize picture_of(const Chain& chain, const Eigen::AlignedBox3d& box) {
  if (box.isEmpty() || !(box.diagonal().norm() > kLeastSize)) return {1 / kPixels, 1};
  const double diagonal = box.diagonal().norm();
  // A mechanism in space is seen from anywhere: its box is as high as it is long.
  const double height = chain.planar ? std::max(box.sizes().y(), box.sizes().x() / kPage) : diagonal;
  return {height * (1 + 2 * kFitMargin) / kPixels, diagonal};
}

bool has_shapes(const Outline& outline) {
  return std::any_of(outline.points.begin(), outline.points.end(), [](const auto& points) { return !points.empty(); });
}

bool turns(const Joint& joint) {
  return joint.kind != JointKind::prismatic;
}

// rad; quaternions x y z w of any length above 0. Exact for small angles, too.
double turn_between(ConstVec a, ConstVec b) {
  const Eigen::Quaterniond p = Eigen::Quaterniond(a[3], a[0], a[1], a[2]).normalized();
  const Eigen::Quaterniond q = Eigen::Quaterniond(b[3], b[0], b[1], b[2]).normalized();
  const Eigen::Quaterniond apart = p.conjugate() * q;
  return 2 * std::atan2(apart.vec().norm(), std::abs(apart.w()));
}

double larger(double largest, double apart) {
  return std::isfinite(apart) ? std::max(largest, apart) : kInfinity;
}

}  // namespace

MotionSize motion_size(const Simulation& simulation, const Trajectory& trajectory) {
  const Chain& chain = simulation.chain;
  const SeenPoints points(simulation);
  Workspace ws(chain);
  std::vector<Eigen::Vector3d> places;
  const std::vector<double> zeros(std::size_t(chain.nv));
  Eigen::AlignedBox3d bars, all;
  Eigen::Vector3d x, y;
  axes_of(chain, x, y);
  const Eigen::Vector3d z = x.cross(y);
  for (int k = 0; k < trajectory.size(); ++k) {
    compute_kinematics(chain, ws, trajectory.q_at(k), zeros);
    points.read(ws, places);
    for (std::size_t i = 0; i < places.size(); ++i) {
      const Eigen::Vector3d p(x.dot(places[i]), y.dot(places[i]), z.dot(places[i]));
      all.extend(p);
      if (i < points.bars()) bars.extend(p);
    }
  }
  const PictureSize bodies = picture_of(chain, all);
  return {chain.planar || !has_shapes(simulation.outline) ? picture_of(chain, bars) : bodies, bodies};
}

void check_accuracy(const Chain& chain, const Accuracy& accuracy) {
  if (accuracy.unit != AccuracyUnit::rad) return;
  if (std::any_of(chain.bodies.begin() + 1, chain.bodies.end(), [](const Body& body) { return turns(body.joint); }))
    return;
  throw Error(ExitCode::bad_input, "'accuracy': " + to_string(accuracy) +
                                       " judges angles, and no joint of this chain turns: ask for m, px or relative");
}

Deviation::Deviation(const Simulation& simulation, const Accuracy& accuracy, const MotionSize& size)
    : chain_(simulation.chain),
      points_(simulation),
      is_angle_(accuracy.unit == AccuracyUnit::rad),
      diagonal_(size.bodies.diagonal),
      ws_(chain_),
      zeros_(std::size_t(chain_.nv)),
      zero_(zero_configuration(chain_)) {
  check_accuracy(chain_, accuracy);
  if (accuracy.unit == AccuracyUnit::px) unit_of_bars_ = size.bars.metres_per_px, unit_of_bodies_ = size.bodies.metres_per_px;
  if (accuracy.unit == AccuracyUnit::relative) unit_of_bars_ = size.bars.diagonal, unit_of_bodies_ = size.bodies.diagonal;
}

double Deviation::angle_apart(ConstVec a, ConstVec b) const {
  double largest = 0;
  for (std::size_t i = 1; i < chain_.bodies.size(); ++i) {
    const Joint& joint = chain_.bodies[i].joint;
    const auto at = std::size_t(joint.q_index);
    if (joint.kind == JointKind::floating) {
      const Eigen::Vector3d way(a[at] - b[at], a[at + 1] - b[at + 1], a[at + 2] - b[at + 2]);
      largest = larger(largest, way.norm() / diagonal_);
      largest = larger(largest, turn_between(a.subspan(at + 3, 4), b.subspan(at + 3, 4)));
      continue;
    }
    const double apart = std::abs(joint.ratio * (a[at] - b[at]));
    largest = larger(largest, joint.kind == JointKind::revolute ? apart : apart / diagonal_);
  }
  return largest;
}

double Deviation::points_apart(ConstVec a, ConstVec b) {
  compute_kinematics(chain_, ws_, a, zeros_);
  points_.read(ws_, places_);
  compute_kinematics(chain_, ws_, b, zeros_);
  points_.read(ws_, other_);
  double largest = 0;
  for (std::size_t i = 0; i < places_.size(); ++i) {
    largest = larger(largest, (places_[i] - other_[i]).norm() / unit_at(i));
  }
  return largest;
}

double Deviation::at(const Trajectory& a, const Trajectory& b, int k) {
  return is_angle_ ? angle_apart(a.q_at(k), b.q_at(k)) : points_apart(a.q_at(k), b.q_at(k));
}

double Deviation::largest_number(const Trajectory& run) {
  double largest = 0;
  for (int k = 0; k < run.size(); ++k) {
    if (is_angle_) {
      largest = std::max(largest, angle_apart(run.q_at(k), zero_));
      continue;
    }
    compute_kinematics(chain_, ws_, run.q_at(k), zeros_);
    points_.read(ws_, places_);
    for (std::size_t i = 0; i < places_.size(); ++i)
      largest = std::max(largest, places_[i].lpNorm<Eigen::Infinity>() / unit_at(i));
  }
  return largest;
}

double Deviation::largest(const Trajectory& a, const Trajectory& b, int samples) {
  if (a.size() < samples || b.size() < samples) return kInfinity;
  double largest = 0;
  for (int k = 0; k < samples; ++k) largest = std::max(largest, at(a, b, k));
  return largest;
}

namespace {

using Eigen::Vector3d;

constexpr double kTurn = 0.5;       // rad or m, that a freedom is moved by
constexpr double kUnmoved = 1e-12;  // of the mechanism's extent

bool spans_space(const std::vector<Vector3d>& points) {
  Eigen::AlignedBox3d box;
  for (const Vector3d& p : points) box.extend(p);
  return !box.isEmpty() && box.sizes().minCoeff() > 0;
}

// The corners of the uniform box with this mass and inertia: along a principal axis i half as long as
// sqrt(3 (I_j + I_k - I_i) / (2 m)). Files that give moments about one axis only make it flat.
std::vector<Vector3d> corners_of_equal_box(const Inertia& inertia) {
  if (!(inertia.mass > 0)) return {};
  const SymmetricEigen principal = eigen_of_symmetric(inertia.about_com);
  const Vector3d moments = principal.values;
  Eigen::Matrix3d half = principal.vectors;
  for (int i = 0; i < 3; ++i)
    half.col(i) *= std::sqrt(std::max(0.0, 3 * (moments.sum() - 2 * moments[i]) / (2 * inertia.mass)));
  if (!half.allFinite() || half.isZero(0)) return {};
  std::vector<Vector3d> corners;
  for (int i = 0; i < 8; ++i)
    corners.push_back(inertia.com + half * Vector3d(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1));
  return corners;
}

}  // namespace

SeenPoints::SeenPoints(const Simulation& simulation) {
  const Chain& chain = simulation.chain;
  const auto add = [&](int body, const Vector3d& place) {
    const auto same = [&](const Point& one) { return one.body == body && one.place == place; };
    if (std::none_of(points_.begin(), points_.end(), same)) points_.push_back({body, place});
  };
  const auto add_frame = [&](int index) {
    const Frame& frame = chain.frames[std::size_t(index)];
    add(frame.body, frame.X_BF.translation());
  };
  const int bodies = int(chain.bodies.size());
  for (int b = 1; b < bodies; ++b) add(b, Vector3d::Zero());
  for (const int frame : chain.leaf_frames) add_frame(frame);
  if (chain.end_effector >= 0) add_frame(chain.end_effector);
  for (int b = 1; b < bodies; ++b) {
    const Inertia& inertia = chain.bodies[std::size_t(b)].inertia;
    if (inertia.mass > 0) add(b, inertia.com);
  }
  bars_ = points_.size();
  for (int b = 1; b < bodies; ++b) {
    const auto& outlines = simulation.outline.points;
    const std::vector<Vector3d> outline = outlines.empty() ? std::vector<Vector3d>{} : outlines[std::size_t(b)];
    for (const Vector3d& place : outline) add(b, place);
    if (spans_space(outline)) continue;
    for (const Vector3d& place : corners_of_equal_box(chain.bodies[std::size_t(b)].inertia)) add(b, place);
  }
}

void SeenPoints::read(const Workspace& ws, std::vector<Vector3d>& places) const {
  places.clear();
  for (const Point& point : points_)
    places.push_back(point.body == 0 ? point.place : Vector3d(ws.X_WB[std::size_t(point.body)] * point.place));
}

std::vector<std::string> unseen_freedoms(const Simulation& simulation, const Trajectory& run) {
  const Chain& chain = simulation.chain;
  const SeenPoints points(simulation);
  Workspace ws(chain);
  std::vector<Vector3d> places, moved;
  std::vector<double> rate(std::size_t(chain.nv)), q;
  std::vector<bool> seen(rate.size(), false);
  const int last = run.size() - 1;
  for (const int k : {0, last / 2, last}) {
    if (last < 0) break;
    std::fill(rate.begin(), rate.end(), 0);
    compute_kinematics(chain, ws, run.q_at(k), rate);
    points.read(ws, places);
    Eigen::AlignedBox3d box;
    for (const Vector3d& place : places) box.extend(place);
    const double least = kUnmoved * (1 + box.diagonal().norm() + box.center().norm());
    for (std::size_t i = 0; i < rate.size(); ++i) {
      if (seen[i]) continue;
      std::fill(rate.begin(), rate.end(), 0);
      q.assign(run.q_at(k).begin(), run.q_at(k).end());
      rate[i] = 1;
      advance(chain, q, rate, kTurn);
      compute_kinematics(chain, ws, q, rate);
      points.read(ws, moved);
      for (std::size_t p = 0; p < places.size(); ++p) seen[i] = seen[i] || !((moved[p] - places[p]).norm() <= least);
    }
  }
  std::vector<std::string> names;
  for (std::size_t i = 0; i < rate.size(); ++i)
    if (!seen[i]) names.push_back(chain.coordinate_names[i]);
  return names;
}

}  // namespace chainreel
