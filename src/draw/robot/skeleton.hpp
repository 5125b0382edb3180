// What of a chain can be seen: straight links between joints, and rails under sliding joints. Plain data in
// body frames, made once; poses come later from the kinematics.
#pragma once

#include <limits>
#include <span>
#include <vector>

#include "dynamics/workspace.hpp"
#include "model/chain.hpp"

namespace chainreel {

// A straight piece of a body, drawn as one capsule.
struct LinkSegment {
  int body = 0;
  Eigen::Vector3d from = Eigen::Vector3d::Zero();  // in B, m
  Eigen::Vector3d to = Eigen::Vector3d::Zero();
};

// The way that a sliding joint covers, in values of the joint (m along its axis).
struct Rail {
  int body = 0;          // the body that slides on it; the rail itself belongs to the body's parent
  bool carrier = false;  // that body carries a rail itself
  bool used = false;     // lower and upper are set
  double lower = 0;
  double upper = 0;
};

struct Skeleton {
  std::vector<LinkSegment> links;  // in the order of the bodies
  std::vector<Rail> rails;
  std::vector<int> color;    // per body: 0, 1, 2, .. along the bodies that show, -1 for those that do not
  double shortest_link = 0;  // m; 0 where there is none
  double reach = 1;          // m: length of all links together, 1 where nothing has a length
};

Skeleton skeleton_of(const Chain& chain);

inline constexpr double kNoLimit = std::numeric_limits<double>::max();  // m, of poses that somebody named

// Lets every rail reach this configuration. Values beyond +-limit or not finite are passed over (runs that
// diverged).
void widen_rails(Skeleton& skeleton, const Chain& chain, ConstVec q, double limit);

// World pose of a body after compute_kinematics; the world's own is the identity.
Eigen::Isometry3d pose_of(const Workspace& ws, int body);

// World position of the point of body's sliding joint at `value`, as its parent stands.
Eigen::Vector3d rail_point(const Chain& chain, const Workspace& ws, int body, double value);

}  // namespace chainreel
