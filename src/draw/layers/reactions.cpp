#include "draw/layers/reactions.hpp"

#include <algorithm>
#include <cmath>

#include "dynamics/kinematics.hpp"

namespace chainreel {
namespace {

using Eigen::Vector3d;

constexpr double kAlongPushed = 0.1;    // cosine of the largest angle from a force to the link that it pushes
constexpr double kSameSize = 1e-6;      // of the multipliers' sizes: rounding of directions is far below, other directions far above
constexpr std::size_t kMostInName = 3;  // rows: of more a name is longer than arrows

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

ReactionRun::ReactionRun(const StagedRun& motion) : motion_(&motion) {
  const Chain& chain = motion.chain();
  for (const std::vector<Reaction>& instant : reactions_along(*motion.simulation(), motion.trajectory())) at_.push_back(joined_at_frames(instant));
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
  if (!at_.empty())
    for (const Reaction& one : at_.front()) find_extremes(one.frame, one.rows);
}

void ReactionRun::find_extremes(int frame, const std::vector<int>& rows) {
  Place& place = places_[frame];
  if (rows.empty() || !(place.is_sum || place.is_vector)) return;
  const auto along = [&](const Trajectory& run) {
    std::vector<double> numbers;
    for (int k = 0; k < run.size(); ++k) {
      const Sums sums = sums_of(rows, run.lambda_at(k));
      numbers.push_back(rows.size() > 1 && place.is_vector ? sums.length : sums.sum);
    }
    return numbers;
  };
  const Trajectory &run = motion_->trajectory(), &curve = motion_->curve_run();
  place.extremes = extremes_near(along(run), run.t, along(curve), curve.t);
}

WorldVector ReactionRun::vector_of(const Reaction& one, const Workspace& ws, int k) const {
  const Trajectory& run = motion_->trajectory();
  WorldVector vector{VectorKind::constraint, frame_position(motion_->chain(), ws, one.frame), one.force, Vector3d::Zero(), Vector3d::Zero(), "f_c"};
  const Place& place = places_.at(one.frame);
  vector.pushes = place.is_pushed;
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

std::vector<WorldVector> ReactionRun::vectors_at(const Workspace& ws, int k) const {
  std::vector<WorldVector> vectors;
  if (at_.empty()) return vectors;
  for (const Reaction& one : at_[std::size_t(k)]) vectors.push_back(vector_of(one, ws, k));
  return vectors;
}

}  // namespace chainreel
