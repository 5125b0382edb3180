#include "sim/deviation.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/scalar.hpp"
#include "dynamics/kinematics.hpp"

namespace chainreel {
namespace {

constexpr double kPixels = 1080;      // a page's height
constexpr double kFitMargin = 0.06;   // of the box, on every side
constexpr double kPage = 16.0 / 9.0;  // width over height
constexpr double kLeastSize = 1e-6;   // m: what stands still has no size; pictures show it a metre high

// In the plane of a planar chain, else in the world.
void axes_of(const Chain& chain, Eigen::Vector3d& x, Eigen::Vector3d& y) {
  x = chain.planar ? chain.planar->plane.ex : Eigen::Vector3d::UnitX();
  y = chain.planar ? chain.planar->plane.ey : Eigen::Vector3d::UnitY();
}

}  // namespace

void drawn_places(const Chain& chain, const Workspace& ws, std::vector<Eigen::Vector3d>& places) {
  places.clear();
  for (std::size_t i = 1; i < chain.bodies.size(); ++i) places.push_back(ws.X_WB[i].translation());
  for (const int frame : chain.leaf_frames) places.push_back(frame_position(chain, ws, frame));
  if (chain.end_effector >= 0) places.push_back(frame_position(chain, ws, chain.end_effector));
}

MotionSize motion_size(const Chain& chain, const Trajectory& trajectory) {
  Workspace ws(chain);
  std::vector<Eigen::Vector3d> places;
  const std::vector<double> zeros(std::size_t(chain.nv));
  Eigen::AlignedBox3d box;
  Eigen::Vector3d x, y;
  axes_of(chain, x, y);
  const Eigen::Vector3d z = x.cross(y);
  for (int k = 0; k < trajectory.size(); ++k) {
    compute_kinematics(chain, ws, trajectory.q_at(k), zeros);
    drawn_places(chain, ws, places);
    for (const Eigen::Vector3d& p : places) box.extend(Eigen::Vector3d(x.dot(p), y.dot(p), z.dot(p)));
  }
  MotionSize size;
  if (box.isEmpty() || !(box.diagonal().norm() > kLeastSize)) return {1 / kPixels, 1};
  size.diagonal = box.diagonal().norm();
  // A mechanism in space is seen from anywhere: its box is as high as it is long.
  const double height = chain.planar ? std::max(box.sizes().y(), box.sizes().x() / kPage) : size.diagonal;
  size.metres_per_px = height * (1 + 2 * kFitMargin) / kPixels;
  return size;
}

Deviation::Deviation(const Chain& chain, const Accuracy& accuracy, const MotionSize& size)
    : chain_(chain), ws_(chain), zeros_(std::size_t(chain.nv)), zero_(std::size_t(chain.nq)) {
  if (accuracy.unit == "px") unit_ = size.metres_per_px;
  if (accuracy.unit == "m") unit_ = 1;
  if (accuracy.unit == "relative") unit_ = size.diagonal;
  if (accuracy.unit == "rad") unit_ = 0;
}

double Deviation::angle_apart(ConstVec a, ConstVec b) const {
  double largest = 0;
  for (std::size_t i = 1; i < chain_.bodies.size(); ++i) {
    const Joint& joint = chain_.bodies[i].joint;
    if (joint.kind != JointKind::revolute) continue;
    const auto at = std::size_t(joint.q_index);
    const double apart = std::abs(joint.ratio * (a[at] - b[at]));
    largest = std::isfinite(apart) ? std::max(largest, apart) : kInfinity;
  }
  return largest;
}

double Deviation::metres_apart(ConstVec a, ConstVec b) {
  compute_kinematics(chain_, ws_, a, zeros_);
  drawn_places(chain_, ws_, places_);
  compute_kinematics(chain_, ws_, b, zeros_);
  drawn_places(chain_, ws_, other_);
  double largest = 0;
  for (std::size_t i = 0; i < places_.size(); ++i) {
    const double apart = (places_[i] - other_[i]).norm();
    largest = std::isfinite(apart) ? std::max(largest, apart) : kInfinity;
  }
  return largest;
}

double Deviation::at(const Trajectory& a, const Trajectory& b, int k) {
  return unit_ == 0 ? angle_apart(a.q_at(k), b.q_at(k)) : metres_apart(a.q_at(k), b.q_at(k)) / unit_;
}

double Deviation::largest_number(const Trajectory& run) {
  double largest = 0;
  for (int k = 0; k < run.size(); ++k) {
    if (unit_ == 0) {
      largest = std::max(largest, angle_apart(run.q_at(k), zero_));
      continue;
    }
    compute_kinematics(chain_, ws_, run.q_at(k), zeros_);
    drawn_places(chain_, ws_, places_);
    for (const Eigen::Vector3d& place : places_) largest = std::max(largest, place.lpNorm<Eigen::Infinity>() / unit_);
  }
  return largest;
}

double Deviation::largest(const Trajectory& a, const Trajectory& b, int samples) {
  if (a.size() < samples || b.size() < samples) return kInfinity;
  double largest = 0;
  for (int k = 0; k < samples; ++k) largest = std::max(largest, at(a, b, k));
  return largest;
}

}  // namespace chainreel
