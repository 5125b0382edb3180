#include "draw/robot/skeleton.hpp"

#include <algorithm>
#include <cmath>

namespace chainreel {
namespace {

using Eigen::Vector3d;

// Shorter pieces than this fraction of the whole are offsets inside a joint, not links.
constexpr double kOffset = 1e-3;
// Among the links, those shorter than this fraction of the longest do not decide how thick all are drawn.
constexpr double kStub = 0.2;

// The place of a leaf that is farthest from its joint: a named frame, else the centre of mass.
Vector3d farthest_place(const Chain& chain, int body) {
  Vector3d farthest = Vector3d::Zero();
  for (const Frame& frame : chain.frames) {
    if (frame.body == body && frame.X_BF.translation().norm() > farthest.norm())
      farthest = frame.X_BF.translation();
  }
  if (farthest.norm() > 0) return farthest;
  return chain.bodies[std::size_t(body)].inertia.com;
}

bool is_new(const std::vector<LinkSegment>& links, int body, const Vector3d& to) {
  return std::none_of(links.begin(), links.end(), [&](const LinkSegment& link) {
    return link.body == body && (link.to - to).norm() <= 1e-9 * (1 + to.norm());
  });
}

std::vector<LinkSegment> segments_of(const Chain& chain) {
  const int bodies = int(chain.bodies.size());
  std::vector<std::vector<Vector3d>> ends(std::size_t(bodies), std::vector<Vector3d>{});
  for (int b = 1; b < bodies; ++b) {
    const Body& body = chain.bodies[std::size_t(b)];
    if (body.parent > 0) ends[std::size_t(body.parent)].push_back(body.joint.X_PJ.translation());
  }
  const Frame* tip = chain.end_effector < 0 ? nullptr : &chain.frames[std::size_t(chain.end_effector)];
  std::vector<LinkSegment> links;
  for (int b = 1; b < bodies; ++b) {
    std::vector<Vector3d>& to = ends[std::size_t(b)];
    const bool leaf = to.empty(), holds_tip = tip != nullptr && tip->body == b;
    if (holds_tip) to.push_back(tip->X_BF.translation());
    // A leaf whose end effector sits in its joint has an extent all the same.
    if (leaf && (!holds_tip || to.back().norm() == 0)) to.push_back(farthest_place(chain, b));
    for (const Vector3d& end : to) {
      if (is_new(links, b, end)) links.push_back({b, Vector3d::Zero(), end});
    }
  }
  return links;
}

std::vector<Rail> rails_of(const Chain& chain) {
  const auto slides = [&](const Body& body) { return body.joint.kind == JointKind::prismatic; };
  std::vector<bool> carrier(chain.bodies.size(), false);
  for (std::size_t b = 1; b < chain.bodies.size(); ++b) {
    if (slides(chain.bodies[b])) carrier[std::size_t(chain.bodies[b].parent)] = true;
  }
  std::vector<Rail> rails;
  for (std::size_t b = 1; b < chain.bodies.size(); ++b) {
    // A rail that is carried is fixed to its body where the joint's value is 0: it always reaches from there.
    if (slides(chain.bodies[b])) rails.push_back({int(b), carrier[b], chain.bodies[b].parent != 0});
  }
  return rails;
}

double length_of(const LinkSegment& link) {
  return (link.to - link.from).norm();
}

void color_bodies(Skeleton& skeleton, const Chain& chain) {
  skeleton.color.assign(chain.bodies.size(), -1);
  for (const LinkSegment& link : skeleton.links) skeleton.color[std::size_t(link.body)] = 0;
  for (const Rail& rail : skeleton.rails) skeleton.color[std::size_t(rail.body)] = 0;
  int next = 0;
  for (int& color : skeleton.color) {
    if (color == 0) color = next++;
  }
}

}  // namespace

Skeleton skeleton_of(const Chain& chain) {
  Skeleton skeleton;
  skeleton.links = segments_of(chain);
  double total = 0, longest = 0;
  for (const LinkSegment& link : skeleton.links) {
    total += length_of(link);
    longest = std::max(longest, length_of(link));
  }
  std::erase_if(skeleton.links,
                [&](const LinkSegment& link) { return length_of(link) <= kOffset * longest; });
  skeleton.shortest_link = longest;
  for (const LinkSegment& link : skeleton.links) {
    if (length_of(link) >= kStub * longest)
      skeleton.shortest_link = std::min(skeleton.shortest_link, length_of(link));
  }
  if (total > 0) skeleton.reach = total;
  skeleton.rails = rails_of(chain);
  color_bodies(skeleton, chain);
  return skeleton;
}

void widen_rails(Skeleton& skeleton, const Chain& chain, ConstVec q, double limit) {
  for (Rail& rail : skeleton.rails) {
    const Joint& joint = chain.bodies[std::size_t(rail.body)].joint;
    const double value = joint.ratio * q[std::size_t(joint.q_index)] + joint.offset;
    if (!(std::abs(value) <= limit)) continue;
    rail.lower = rail.used ? std::min(rail.lower, value) : value;
    rail.upper = rail.used ? std::max(rail.upper, value) : value;
    rail.used = true;
  }
}

Eigen::Isometry3d pose_of(const Workspace& ws, int body) {
  return body == 0 ? Eigen::Isometry3d::Identity() : ws.X_WB[std::size_t(body)];
}

Eigen::Vector3d rail_point(const Chain& chain, const Workspace& ws, int body, double value) {
  const Body& slider = chain.bodies[std::size_t(body)];
  return pose_of(ws, slider.parent) * (slider.joint.X_PJ * Vector3d(value * slider.joint.axis));
}

}  // namespace chainreel
