// Marks that say where something is: axes of frames and the centre of mass.
#pragma once

#include "draw/page/mark_labels.hpp"
#include "draw/robot/chain.hpp"
#include "picture/text.hpp"

namespace chainreel {

// Axes of the frame of every moving link, and of the end effector where that is elsewhere: x solid, y with
// one cross tick, z with two, letters at the tips. An axis that points at the viewer is a ring with a dot,
// one that points away a ring with a cross.
class FrameAxes {
 public:
  FrameAxes(const Chain& chain, const Theme& theme, const Fonts& fonts, double text_scale, double marks);

  // After compute_kinematics. The letters go to `labels`.
  void draw(Picture& picture, const Camera& camera, const Workspace& ws, int clip, MarkLabels& labels) const;
  // The frames that are drawn: their poses in W.
  std::vector<Eigen::Isometry3d> poses(const Workspace& ws) const;
  // How far from a frame's origin its axes and letters reach, units of H.
  double reach() const;

 private:
  void draw_axis(Picture& picture, Point origin, Point v, double away, int axis, int clip, MarkLabels& labels) const;

  const Chain* chain_;
  const Theme* theme_;
  double marks_;
  std::array<TextLine, 3> letters_;
  bool at_tip_ = false;  // the end effector has axes of its own
};

// The centre of mass of the whole chain after compute_kinematics; the origin where nothing has mass.
Eigen::Vector3d center_of_mass(const Chain& chain, const Workspace& ws);

}  // namespace chainreel
