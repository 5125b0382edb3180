#include "draw/robot/chain_fit.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "draw/robot/chain.hpp"
#include "draw/robot/joints.hpp"
#include "dynamics/kinematics.hpp"

namespace chainreel {

using Eigen::Vector3d;

ChainFit::ChainFit(const Chain& chain, const Skeleton& skeleton, const Camera& camera, double marks,
                   const BodyShapes* shapes)
    : chain_(chain), skeleton_(skeleton), camera_(camera), marks_(marks), shapes_(shapes) {
  const double outline = size::kLinkOutline / 2;
  Room link = room_around(size::kLinkWidth / 2 + outline);
  link.metres = kLinkWidthOfShortest * skeleton.shortest_link / 2;
  link.beyond = outline;
  link_ = box_.add_kind(link);
  joint_ = box_.add_kind(room_around((marks * size::kJointDisc + size::kJointOutline) / 2));
  tip_ = box_.add_kind(room_around(marks * size::kEndEffector / 2));
  for (const Rail& rail : skeleton.rails) {
    // It may run any way: its end's farthest corner, below which there may be ground.
    const bool fixed = chain.bodies[std::size_t(rail.body)].parent == 0;
    const double across = fixed ? rail_ground_depth() : (size::kRailGap + size::kRailLine) / 2;
    rail_.push_back(box_.add_kind(room_around(marks * std::hypot(rail_overhang(rail.carrier), across))));
  }
  corner_ = box_.add_kind(room_around(outline));
  add_base();
}

void ChainFit::add_to(int kind, const Vector3d& place) {
  box_.add(kind, camera_.flat(place));
}

void ChainFit::add(const Vector3d& place, const Room& room) {
  add_to(box_.add_kind(room), place);
}

void ChainFit::add_base() {
  const double half = (marks_ * size::kGroundLength + size::kGroundLine) / 2;  // its ends are round
  const Room ground{half, half, marks_ * pin_depth(), 0};
  for (std::size_t b = 1; b < chain_.bodies.size(); ++b) {
    const Body& body = chain_.bodies[b];
    if (body.parent != 0 || body.joint.kind == JointKind::floating) continue;
    const bool on_root = hangs_on_root(chain_, skeleton_, body);
    if (on_root && body.joint.kind == JointKind::prismatic) continue;
    add(on_root ? Vector3d(body.joint.X_PJ.translation()) : root_place(chain_), ground);
  }
}

bool ChainFit::add_pose(const Workspace& ws, double limit) {
  const int bodies = int(chain_.bodies.size());
  for (int b = 1; b < bodies; ++b) {
    if (!(pose_of(ws, b).translation().norm() <= limit)) return false;  // NaN, too
  }
  for (const LinkSegment& link : skeleton_.links) {
    add_to(link_, pose_of(ws, link.body) * link.from);
    add_to(link_, pose_of(ws, link.body) * link.to);
  }
  for (int b = 1; b < bodies; ++b) {
    if (chain_.bodies[std::size_t(b)].joint.kind == JointKind::revolute)
      add_to(joint_, pose_of(ws, b).translation());
  }
  for (std::size_t i = 0; i < skeleton_.rails.size(); ++i) {
    const Rail& rail = skeleton_.rails[i];
    add_to(rail_[i], rail_point(chain_, ws, rail.body, rail.lower));
    add_to(rail_[i], rail_point(chain_, ws, rail.body, rail.upper));
  }
  if (chain_.end_effector >= 0) add_to(tip_, tip_position(chain_, ws));
  if (shapes_) for_each_corner(*shapes_, ws, [&](const Vector3d& corner) { add_to(corner_, corner); });
  return true;
}

void extend(MotionBox& box, const Chain& chain, const Skeleton& skeleton, const BodyShapes* shapes,
            const Workspace& ws, double limit) {
  const auto add = [&](const Vector3d& place) {
    if (place.norm() <= limit) box.add(place);
  };
  for (const LinkSegment& link : skeleton.links) {
    add(pose_of(ws, link.body) * link.from);
    add(pose_of(ws, link.body) * link.to);
  }
  if (chain.end_effector >= 0) add(tip_position(chain, ws));
  if (shapes) for_each_corner(*shapes, ws, add);
}

MotionBox box_around(const Chain& chain, const Skeleton& skeleton, const BodyShapes* shapes, Workspace& ws,
                     const std::vector<std::vector<double>>& configurations) {
  const std::vector<double> at_rest(std::size_t(chain.nv), 0.0);
  MotionBox box(up_of(chain));
  for (const std::vector<double>& q : configurations) {
    compute_kinematics(chain, ws, q, at_rest);
    extend(box, chain, skeleton, shapes, ws, std::numeric_limits<double>::max());
  }
  return box;
}

}  // namespace chainreel
