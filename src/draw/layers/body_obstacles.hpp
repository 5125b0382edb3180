// Where links that have a shape in space stand in the way of words.
#pragma once

#include <vector>

#include "draw/page/word_plan.hpp"
#include "draw/robot/body_shapes.hpp"
#include "draw/robot/skeleton.hpp"
#include "picture/camera.hpp"

namespace chainreel {

// Units of H, radius: what stands for a link that has a shape in space, and the shape about it, on which words stand if need be.
inline constexpr double kBone = 0.010, kFlesh = 0.030;

// After compute_kinematics.
inline void add_bodies(std::vector<Obstacle>& obstacles, const Skeleton& skeleton, const Workspace& ws, const Camera& camera) {
  for (const LinkSegment& link : skeleton.links) {
    const Point from = camera.project(pose_of(ws, link.body) * link.from), to = camera.project(pose_of(ws, link.body) * link.to);
    obstacles.push_back({from, to, kBone, false});
    obstacles.push_back({from, to, kFlesh, true});
  }
}

// All that each shape covers, as the hull of its corners. Still figures have room around the robot: there words may not stand on it.
void add_silhouettes(std::vector<Obstacle>& obstacles, const BodyShapes& shapes, const Workspace& ws, const Camera& camera,
                     bool may_yield = false);

}  // namespace chainreel
