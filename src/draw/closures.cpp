#include "draw/closures.hpp"

#include <variant>

#include "draw/joints.hpp"
#include "dynamics/kinematics.hpp"

namespace chainreel {
namespace {

const Frame& frame_named(const Chain& chain, const std::string& name) {
  return chain.frames[std::size_t(find_frame(chain, name))];
}

bool is_on_ground(const Chain& chain, const std::string& name) {
  return frame_named(chain, name).body == 0;
}

// The frame that marks where the constraint closes a loop; "" where it closes none with a joint.
std::string closing_frame(const Chain& chain, const Constraint& constraint) {
  if (const auto* point = std::get_if<PointConstraint>(&constraint)) return point->frame;
  const auto* close = std::get_if<CloseConstraint>(&constraint);
  if (!close || close->kind == Closure::weld) return {};
  return is_on_ground(chain, close->a) ? close->b : close->a;
}

}  // namespace

std::vector<Eigen::Vector3d> closure_pins(const Chain& chain, const ConstraintPlan& plan) {
  std::vector<Eigen::Vector3d> pins;
  for (const Constraint& constraint : plan.list) {
    if (const auto* point = std::get_if<PointConstraint>(&constraint)) pins.push_back(point->at);
    const auto* close = std::get_if<CloseConstraint>(&constraint);
    if (!close || close->kind == Closure::weld) continue;
    for (const std::string& name : {close->a, close->b})
      if (is_on_ground(chain, name)) pins.push_back(frame_named(chain, name).X_BF.translation());
  }
  return pins;
}

void draw_closure_pins(Picture& picture, const ChainDrawing& drawing, const ConstraintPlan& plan, int clip) {
  for (const Eigen::Vector3d& pin : closure_pins(drawing.chain, plan))
    draw_pin(picture, drawing.camera.project(pin), drawing.look, clip);
}

void draw_closure_joints(Picture& picture, const ChainDrawing& drawing, const Workspace& ws,
                         const ConstraintPlan& plan, int clip) {
  for (const Constraint& constraint : plan.list) {
    const std::string name = closing_frame(drawing.chain, constraint);
    if (name.empty()) continue;
    const Frame& frame = frame_named(drawing.chain, name);
    draw_revolute(picture, drawing.camera.project(pose_of(ws, frame.body) * frame.X_BF.translation()),
                  drawing.look, clip);
  }
}

}  // namespace chainreel
