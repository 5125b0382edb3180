// A foot on the ground and what the ground answers: an arrow from the centre of pressure, as long as the
// force. Beyond the foot, where no ground could push, it is dashed; where the ground had to pull, there is
// none.
#pragma once

#include <vector>

#include "draw/page/scales.hpp"
#include "draw/robot/joints.hpp"
#include "picture/picture.hpp"
#include "sim/simulate.hpp"

namespace chainreel {

class FootMark {
 public:
  // The simulation has a foot. Forces are computed here, for the first `samples` samples; it is not kept.
  FootMark(const Simulation& simulation, const Trajectory& trajectory, int samples);

  // What the arrow's length means, for the page's foot.
  ScaleEntry scale_entry(const Theme& theme) const;
  void draw_foot(Picture& picture, const Camera& camera, const ChainLook& look, int clip) const;
  void draw_pressure(Picture& picture, const Camera& camera, const ChainLook& look, int k, int clip) const;

 private:
  struct Push {
    double place = 0;                                 // centre of pressure, m along the ground
    Eigen::Vector3d force = Eigen::Vector3d::Zero();  // in weights
  };
  Eigen::Vector3d on_ground(double place) const;

  double weight_ = 0;  // N
  Foot foot_;
  GroundAxes ground_;
  std::vector<Eigen::Vector3d> ankles_;  // joints on the world
  std::vector<Push> pushes_;             // a sample
};

}  // namespace chainreel
