// How far two runs of one chain lie apart, as a viewer sees it: at every point that can be seen, in every frame.
#pragma once

#include <string>
#include <vector>

#include "dynamics/workspace.hpp"
#include "sim/accuracy.hpp"
#include "sim/simulate.hpp"
#include "sim/system/trajectory.hpp"

namespace chainreel {

// The points of a chain by which a viewer tells one run from another.

// What can be seen of every moving body: its joint, its centre of mass, and corners around what can be seen
// of it. The displacement of a rigid body is largest at a corner of any hull around it, so that nothing
// within moves further. A body without an outline counts as the uniform box of its mass and inertia; one that
// has none of either shows its joint alone. Besides the ends of links and the end effector.
class SeenPoints {
 public:
  explicit SeenPoints(const Simulation& simulation);

  // After compute_kinematics: in W, m; the first bars() of them are those of the bars as which chains are drawn.
  void read(const Workspace& ws, std::vector<Eigen::Vector3d>& places) const;
  std::size_t bars() const { return bars_; }

 private:
  struct Point {
    int body;
    Eigen::Vector3d place;  // in the body's frame
  };

  std::vector<Point> points_;
  std::size_t bars_ = 0;
};

// The freedoms that move no point at any of some states of a run: nothing can be said of their errors, nor seen.
std::vector<std::string> unseen_freedoms(const Simulation& simulation, const Trajectory& run);

// How large a motion is in a picture that fits it.
struct PictureSize {
  double metres_per_px =
      1;                // 1/1080 of the height of a page of 16:9 that the motion fills but for 6 % a side
  double diagonal = 1;  // m, of the box around it
};

// Chains in a plane, and those without shapes, are drawn as bars, which pictures fit; a picture of the bodies themselves
// is the larger one.
struct MotionSize {
  PictureSize bars, bodies;
};

// From a run that shows about where it goes.
MotionSize motion_size(const Simulation& simulation, const Trajectory& trajectory);

// Throws Error (bad input) where the unit judges nothing of this chain.
void check_accuracy(const Chain& chain, const Accuracy& accuracy);

class Deviation {
 public:
  Deviation(const Simulation& simulation, const Accuracy& accuracy, const MotionSize& size);

  // Between the k-th samples, in the accuracy's unit. NaN and infinity count as infinitely far.
  double at(const Trajectory& a, const Trajectory& b, int k);
  // The largest coordinate of a place, or the largest angle, that doubles hold over a run, in the same unit.
  double largest_number(const Trajectory& run);
  // The largest over the first `samples` samples; infinite where one of the runs has fewer.
  double largest(const Trajectory& a, const Trajectory& b, int samples);

 private:
  double angle_apart(ConstVec a, ConstVec b) const;
  double points_apart(ConstVec a, ConstVec b);
  // m in one unit at the i-th point.
  double unit_at(std::size_t i) const { return i < points_.bars() ? unit_of_bars_ : unit_of_bodies_; }

  const Chain& chain_;
  SeenPoints points_;
  bool is_angle_ = false;
  double unit_of_bars_ = 1, unit_of_bodies_ = 1;  // m
  double diagonal_ = 1;                           // m
  Workspace ws_;
  std::vector<double> zeros_, zero_;  // rates, coordinates
  std::vector<Eigen::Vector3d> places_, other_;
};

}  // namespace chainreel
