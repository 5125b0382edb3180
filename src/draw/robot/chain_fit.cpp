#include "draw/robot/chain_fit.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "draw/robot/chain.hpp"
#include "draw/robot/joints.hpp"
#include "dynamics/kinematics.hpp"
#include "picture/point.hpp"

namespace chainreel {

using Eigen::Vector3d;

ChainFit::ChainFit(const Chain& chain, const Skeleton& skeleton, const Camera& camera, double marks,
                   const BodyShapes* shapes)
    : chain_(chain), skeleton_(skeleton), camera_(camera), marks_(marks), shapes_(shapes) {
  const double outline = size::kLinkOutline / 2;
  link_ = room_around(size::kLinkWidth / 2 + outline);
  link_.metres = kLinkWidthOfShortest * skeleton.shortest_link / 2;
  link_.beyond = outline;
  point_ = room_around(std::min(marks * kPointMass, kPointOfLink * size::kLinkWidth) + outline);
  point_.metres = kPointOfLink * kLinkWidthOfShortest * skeleton.shortest_link;
  point_.beyond = outline;
  joint_ = room_around((marks * size::kJointDisc + size::kJointOutline) / 2);
  tip_ = room_around(marks * size::kEndEffector / 2);
  for (const Rail& rail : skeleton.rails) {
    // It may run any way: its end's farthest corner, below which there may be ground.
    const bool fixed = chain.bodies[std::size_t(rail.body)].parent == 0;
    const double across = fixed ? rail_ground_depth() : (size::kRailGap + size::kRailLine) / 2;
    rail_.push_back(room_around(marks * std::hypot(rail_overhang(rail.carrier), across)));
  }
  corner_ = room_around(outline);
  add_base();
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
    add(pose_of(ws, link.body) * link.from, link_);
    add(pose_of(ws, link.body) * link.to, link_);
  }
  for (int b = 1; b < bodies; ++b) {
    if (chain_.bodies[std::size_t(b)].joint.kind == JointKind::revolute)
      add(pose_of(ws, b).translation(), joint_);
  }
  for (const PointMass& point : chain_.point_masses)
    if (point.is_payload || !shapes_) add(pose_of(ws, point.body) * point.at, point_);
  for (std::size_t i = 0; i < skeleton_.rails.size(); ++i) {
    const Rail& rail = skeleton_.rails[i];
    add(rail_point(chain_, ws, rail.body, rail.lower), rail_[i]);
    add(rail_point(chain_, ws, rail.body, rail.upper), rail_[i]);
  }
  if (chain_.end_effector >= 0) add(tip_position(chain_, ws), tip_);
  if (shapes_) for_each_corner(*shapes_, ws, [&](const Vector3d& corner) { add(corner, corner_); });
  return true;
}

bool covers(const Chain& chain, const Skeleton& skeleton, const BodyShapes* shapes, const Workspace& ws,
            const Camera& camera, const Rect& part) {
  const auto near = [&](const Vector3d& from, const Vector3d& to, double radius) {
    Point a = camera.project(from), b = camera.project(to);
    return cut_segment(widened(part, radius), a, b);
  };
  for (const LinkSegment& link : skeleton.links) {
    const Eigen::Isometry3d X_WB = pose_of(ws, link.body);
    if (near(X_WB * link.from, X_WB * link.to, size::kLinkWidth / 2)) return true;
  }
  if (shapes)
    for (const BodyShape& shape : shapes->shapes)
      if (overlap(part, extent_of(shape, ws, camera))) return true;
  for (const Rail& rail : skeleton.rails)
    if (near(rail_point(chain, ws, rail.body, rail.lower), rail_point(chain, ws, rail.body, rail.upper),
             rail_overhang(rail.carrier)))
      return true;
  const Vector3d root = root_place(chain);
  if (near(root, root, size::kGroundLength / 2)) return true;
  if (chain.end_effector < 0) return false;
  const Vector3d tip = tip_position(chain, ws);
  return near(tip, tip, kLargestMark);
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
