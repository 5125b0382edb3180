// How far two runs of one chain lie apart, as a viewer sees it: at every place that is drawn, in every frame.
#pragma once

#include <vector>

#include "dynamics/workspace.hpp"
#include "sim/accuracy.hpp"
#include "sim/trajectory.hpp"

namespace chainreel {

// The size of a motion, from a run that shows about where it goes.
struct MotionSize {
  double metres_per_px =
      1;                // 1/1080 of the height of a page of 16:9 that the motion fills but for 6 % a side
  double diagonal = 1;  // m, of the box of all drawn places
};
MotionSize motion_size(const Chain& chain, const Trajectory& trajectory);

class Deviation {
 public:
  Deviation(const Chain& chain, const Accuracy& accuracy, const MotionSize& size);

  // Between the k-th samples, in the accuracy's unit. NaN and infinity count as infinitely far.
  double at(const Trajectory& a, const Trajectory& b, int k);
  // The largest coordinate of a place, or the largest angle, that doubles hold over a run, in the same unit.
  double largest_number(const Trajectory& run);
  // The largest over the first `samples` samples; infinite where one of the runs has fewer.
  double largest(const Trajectory& a, const Trajectory& b, int samples);

 private:
  double angle_apart(ConstVec a, ConstVec b) const;
  double metres_apart(ConstVec a, ConstVec b);

  const Chain& chain_;
  double unit_ = 1;  // m in one unit; 0: angles are compared
  Workspace ws_;
  std::vector<double> zeros_, zero_;  // rates, coordinates
  std::vector<Eigen::Vector3d> places_, other_;
};

// The places of a chain that pictures show, in the world: joints and the ends of links. After
// compute_kinematics.
void drawn_places(const Chain& chain, const Workspace& ws, std::vector<Eigen::Vector3d>& places);

}  // namespace chainreel
