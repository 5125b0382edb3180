// A chain at one instant as shapes: what stands on the ground, links, joints.
#pragma once

#include "draw/fit.hpp"
#include "draw/look.hpp"

namespace chainreel {

// Everything but the pose; references must outlive it.
struct ChainDrawing {
  const Chain& chain;
  const Skeleton& skeleton;
  const Camera& camera;
  ChainLook look;
};

// Ground, fixed parts and the rails fixed to them: the same at every pose.
void draw_base(Picture& picture, const ChainDrawing& drawing, int clip);
// Links and joints after compute_kinematics; along the chain, in space from far to near. Without the end
// effector's disc, which is to lie above what is drawn later.
void draw_links(Picture& picture, const ChainDrawing& drawing, const Workspace& ws, int clip);

// World position of the end effector after compute_kinematics.
Eigen::Vector3d tip_position(const Chain& chain, const Workspace& ws);

// Gathers the places of a chain for the fit of a camera whose axes are set.
class ChainFit {
 public:
  ChainFit(const Chain& chain, const Skeleton& skeleton, const Camera& camera);
  // Poses with a place farther than `limit` from the base are passed over (runs that diverged).
  void add_pose(const Workspace& ws, double limit);
  // Further places with room of their own.
  void add(const Eigen::Vector3d& place, const Room& room);
  const FitBox& box() const { return box_; }

 private:
  void add_base();
  void add_to(int kind, const Eigen::Vector3d& place);

  const Chain& chain_;
  const Skeleton& skeleton_;
  const Camera& camera_;
  FitBox box_;
  int link_, joint_, rail_, tip_;
};

}  // namespace chainreel
