#include "draw/layers/reactions.hpp"

#include <algorithm>
#include <cmath>

#include "draw/robot/chain.hpp"
#include "dynamics/kinematics.hpp"

namespace chainreel {
namespace {

using Eigen::Vector3d;

constexpr double kAlongPushed = 0.1;    // cosine of the largest angle from a force to the link that it pushes
constexpr double kSameSize = 1e-6;      // of the multipliers' sizes: rounding of directions is far below, other directions far above
constexpr std::size_t kMostInName = 3;  // rows: of more a name is longer than arrows
constexpr double kSamePlace = 1e-6;     // of the reach: rounding
constexpr double kBetweenShares = 0.02;  // units of H at usual marks, between arrows that stand beside one another: heads are 0.018 wide

// What acts at one place is one force.
std::vector<Reaction> joined_at_frames(const std::vector<Reaction>& reactions) {
  std::vector<Reaction> joined;
  for (const Reaction& one : reactions) {
    const auto same = std::ranges::find(joined, one.frame, &Reaction::frame);
    if (same == joined.end()) {
      joined.push_back(one);
      continue;
    }
    same->force += one.force;
    // Of what has no multipliers of its own nobody could name the sum by the others' ones.
    if (one.rows.empty() || same->rows.empty()) same->rows.clear();
    else same->rows.insert(same->rows.end(), one.rows.begin(), one.rows.end());
  }
  return joined;
}

// "lambda_1 + lambda_2": what stands between the multipliers of a force.
std::string multipliers(const std::vector<int>& rows, int all_rows, const char* between) {
  if (all_rows == 1) return "lambda";
  std::string names;
  for (const int row : rows) names += (names.empty() ? "" : between) + ("lambda_{" + std::to_string(row + 1) + "}");
  return names;
}

// Of a force's multipliers: their sum, that of their sizes, and the length of the vector that has them as components, N.
struct Sums {
  double sum = 0, sizes = 0, length = 0;
};
template <class Multipliers>
Sums sums_of(const std::vector<int>& rows, const Multipliers& lambda) {
  Sums sums;
  for (const int row : rows) {
    const double one = lambda[std::size_t(row)];
    sums.sum += one;
    sums.sizes += std::abs(one);
    sums.length = std::hypot(sums.length, one);
  }
  return sums;
}

}  // namespace

ReactionRun::ReactionRun(const StagedRun& motion) : motion_(&motion), each_(reactions_along(*motion.simulation(), motion.trajectory())) {
  const Chain& chain = motion.chain();
  for (const std::vector<Reaction>& instant : each_) at_.push_back(joined_at_frames(instant));
  if (rounding_of(chain, at_)) at_.clear();
  double largest = 0;
  for (const std::vector<Reaction>& instant : at_)
    for (const Reaction& one : instant) largest = std::max(largest, one.force.norm());
  for (int k = 0; k < std::min(motion.samples(), int(at_.size())); ++k) {
    const Workspace& ws = motion.pose_at(k);
    for (const Reaction& one : at_[std::size_t(k)]) {
      Place& place = places_[one.frame];
      const Vector3d to_joint = ws.X_WB[std::size_t(chain.frames[std::size_t(one.frame)].body)].translation() - frame_position(chain, ws, one.frame);
      const bool along = one.rows.size() == 1 && one.force.dot(to_joint) > kAlongPushed * one.force.norm() * to_joint.norm();
      place.is_pushed &= along || one.force.isZero();
      const Sums sums = sums_of(one.rows, motion.trajectory().lambda_at(k));
      const double size = one.force.norm(), close = kSameSize * (sums.sizes + largest);
      place.is_sum &= std::abs(size - std::abs(sums.sum)) <= close;
      place.is_vector &= std::abs(size - sums.length) <= close;
    }
  }
  if (at_.empty()) return;
  for (const Reaction& one : each_.front()) places_.at(one.frame).of_single_rows &= one.rows.size() == 1;
  for (int k = 0; k < std::min(motion.samples(), int(each_.size())); ++k)
    for (auto& [frame, place] : places_)
      if (place.of_single_rows && place.is_line) look_at_directions(frame, k, kSameSize * largest, place);
  for (const Reaction& one : at_.front()) find_extremes(one);
}

// Whether the shares lie along one line at this sample, with what their multipliers are as sizes; which of them press against the first one.
void ReactionRun::look_at_directions(int frame, int k, double close, Place& place) const {
  const auto lambda = motion_->trajectory().lambda_at(k);
  std::vector<const Reaction*> shares;
  for (const Reaction& share : each_[std::size_t(k)])
    if (share.frame == frame && std::abs(lambda[std::size_t(share.rows.front())]) > close) shares.push_back(&share);
  if (shares.empty()) return;
  const auto size = [&](const Reaction* share) { return std::abs(lambda[std::size_t(share->rows.front())]); };
  const auto way = [&](const Reaction* share) { return Vector3d(share->force / lambda[std::size_t(share->rows.front())]); };
  const Vector3d along = way(*std::ranges::max_element(shares, {}, size));
  for (const Reaction* share : shares) {
    const double sizes = size(share);
    place.is_line &= std::abs(share->force.norm() - sizes) <= kSameSize * sizes + close && share->force.cross(along).norm() <= kSameSize * sizes + close;
    if (place.first_row < 0) place.first_row = share->rows.front();
    if (shares.front()->rows.front() == place.first_row && way(share).dot(way(shares.front())) < 0) place.turned.insert(share->rows.front());
  }
}

std::vector<double> ReactionRun::extremes_of(const std::vector<int>& rows, bool as_length) const {
  const auto along = [&](const Trajectory& run) {
    std::vector<double> numbers;
    for (int k = 0; k < run.size(); ++k) {
      const Sums sums = sums_of(rows, run.lambda_at(k));
      numbers.push_back(as_length ? sums.length : sums.sum);
    }
    return numbers;
  };
  const Trajectory &run = motion_->trajectory(), &curve = motion_->curve_run();
  return extremes_near(along(run), run.t, along(curve), curve.t);
}

void ReactionRun::find_extremes(const Reaction& one) {
  Place& place = places_.at(one.frame);
  if (one.rows.empty()) return;
  if (place.is_sum || place.is_vector) place.extremes = extremes_of(one.rows, one.rows.size() > 1 && place.is_vector);
  if (!place.has_shares(one)) return;
  for (const int row : one.rows) place.share_extremes[row] = extremes_of({row}, false);
}

WorldVector ReactionRun::vector_of(const Reaction& one, const Workspace& ws, int k) const {
  const Trajectory& run = motion_->trajectory();
  WorldVector vector{VectorKind::constraint, frame_position(motion_->chain(), ws, one.frame), one.force, Vector3d::Zero(), Vector3d::Zero(), "f_c"};
  const Place& place = places_.at(one.frame);
  vector.pushes = place.is_pushed;
  const Chain& chain = motion_->chain();
  vector.at_tip = chain.end_effector >= 0 && (vector.place - tip_position(chain, ws)).norm() < kSamePlace * motion_->skeleton().reach;
  const std::size_t rows = one.rows.size();
  if (rows == 0 || rows > kMostInName) return vector;
  if (!place.extremes.empty()) vector.extreme = place.extremes[std::size_t(k)];
  if (rows > 1 && place.is_vector) {
    vector.label = "-(" + multipliers(one.rows, run.rows, ", ") + ")";
  } else if (place.is_sum) {
    const std::string sum = multipliers(one.rows, run.rows, " + ");
    vector.label = rows > 1 ? "-(" + sum + ")" : "-" + sum;
    vector.amount = Amount{sum, sums_of(one.rows, run.lambda_at(k)).sum};
  }
  return vector;
}

// Side by side, in the order of the rows: the first farthest to the left of the way that all would press if their multipliers were positive.
void ReactionRun::add_shares(const Reaction& one, const Workspace& ws, int k, std::vector<WorldVector>& vectors) const {
  const Trajectory& run = motion_->trajectory();
  const Place& place = places_.at(one.frame);
  double lane = 0.5 * double(one.rows.size() - 1) * kBetweenShares;
  for (const Reaction& share : each_[std::size_t(k)]) {
    if (share.frame != one.frame) continue;
    const int row = share.rows.front();
    const double lambda = run.lambda_at(k)[std::size_t(row)];
    const std::string name = multipliers({row}, run.rows, "");
    WorldVector vector{VectorKind::constraint, frame_position(motion_->chain(), ws, one.frame), share.force, Vector3d::Zero(), Vector3d::Zero(), "-" + name};
    // The left of an arrow changes sides where it turns round.
    vector.lane = (lambda > 0) != place.turned.contains(row) ? -lane : lane;
    vector.amount = Amount{name, lambda};
    vector.extreme = place.share_extremes.at(row)[std::size_t(k)];
    vectors.push_back(std::move(vector));
    lane -= kBetweenShares;
  }
}

std::vector<WorldVector> ReactionRun::vectors_at(const Workspace& ws, int k) const {
  std::vector<WorldVector> vectors;
  if (at_.empty()) return vectors;
  for (const Reaction& one : at_[std::size_t(k)]) {
    if (places_.at(one.frame).has_shares(one)) add_shares(one, ws, k, vectors);
    else vectors.push_back(vector_of(one, ws, k));
  }
  return vectors;
}

}  // namespace chainreel
