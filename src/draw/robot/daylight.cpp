#include "draw/robot/daylight.hpp"

#include <algorithm>
#include <cmath>

#include "core/machine.hpp"
#include "core/parallel.hpp"
#include "core/scalar.hpp"
#include "mesh/open_sky.hpp"

namespace chainreel {
namespace {

using Eigen::Isometry3d;

PoseRows rows_of(const Isometry3d& X) {
  PoseRows rows{};
  for (int r = 0; r < 3; ++r)
    for (int c = 0; c < 4; ++c) rows[std::size_t(4 * r + c)] = float(X(r, c));
  return rows;
}

// The pose of a body in its parent in the middle of the k-th part of its joint's range.
Isometry3d pose_in_parent(const Joint& joint, std::size_t k) {
  const bool turns = joint.kind == JointKind::revolute;
  double lower = joint.limit.lower, upper = joint.limit.upper;
  if (!std::isfinite(upper - lower)) lower = turns ? -M_PI : 0, upper = turns ? M_PI : 0;
  const double value = lower + (upper - lower) * (double(k) + 0.5) / OpenSky::kPoses;
  Isometry3d X = joint.X_PJ;
  if (!turns) return X * Eigen::Translation3d(value * joint.axis);
  const auto [s, c] = sin_cos(value);
  Eigen::Matrix3d across;  // axis x
  across << 0, -joint.axis[2], joint.axis[1], joint.axis[2], 0, -joint.axis[0], -joint.axis[1], joint.axis[0], 0;
  X.linear() *= Eigen::Matrix3d::Identity() + s * across + (1 - c) * across * across;
  return X;
}

// Bodies that meet, and how the second stands in the first.
struct Meeting {
  std::size_t body = 0, other = 0;
  std::array<Isometry3d, OpenSky::kPoses> X;
};

std::vector<Meeting> meetings_of(const Chain& chain, const std::vector<std::vector<std::size_t>>& shapes_on) {
  std::vector<Meeting> meetings;
  for (std::size_t b = 1; b < chain.bodies.size(); ++b) {
    if (shapes_on[b].empty()) continue;
    Meeting down{0, b, {}};
    down.X.fill(Isometry3d::Identity());
    std::size_t at = b;
    bool is_held = true;
    do {
      const Joint& joint = chain.bodies[at].joint;
      is_held = joint.kind != JointKind::floating;
      for (std::size_t k = 0; k < OpenSky::kPoses; ++k) down.X[k] = pose_in_parent(joint, k) * down.X[k];
      at = std::size_t(chain.bodies[at].parent);
    } while (is_held && at > 0 && shapes_on[at].empty());
    if (!is_held || shapes_on[at].empty()) continue;
    down.body = at;
    Meeting up{b, at, down.X};
    for (Isometry3d& X : up.X) X = X.inverse();
    meetings.push_back(down);
    meetings.push_back(up);
  }
  return meetings;
}

}  // namespace

void put_in_daylight(BodyShapes& shapes, const Chain& chain) {
  std::vector<std::vector<std::size_t>> shapes_on(chain.bodies.size());
  for (std::size_t s = 0; s < shapes.shapes.size(); ++s) shapes_on[std::size_t(shapes.shapes[s].body)].push_back(s);
  const std::vector<Meeting> meetings = meetings_of(chain, shapes_on);
  const auto placed = [&](std::size_t s) { return PlacedTriangles{shapes.shapes[s].mesh.get(), rows_of(shapes.shapes[s].X_BM)}; };

  std::vector<std::size_t> bodies;
  for (std::size_t b = 0; b < shapes_on.size(); ++b)
    if (!shapes_on[b].empty()) bodies.push_back(b);
  const int threads = std::min(usable_cores(), int(bodies.size()));
  std::vector<std::optional<SurfacePoints>> points(chain.bodies.size());
  for_each_index(bodies.size(), threads, [&](std::size_t i) {
    std::vector<PlacedTriangles> own;
    for (const std::size_t s : shapes_on[bodies[i]]) own.push_back(placed(s));
    points[bodies[i]].emplace(own);
  });
  for_each_index(bodies.size(), threads, [&](std::size_t i) {
    std::vector<OpenSky::Neighbor> neighbors;
    for (const Meeting& meeting : meetings) {
      if (meeting.body != bodies[i]) continue;
      OpenSky::Neighbor& neighbor = neighbors.emplace_back();
      neighbor.points = &*points[meeting.other];
      std::transform(meeting.X.begin(), meeting.X.end(), neighbor.poses.begin(), rows_of);
    }
    const OpenSky sky(*points[bodies[i]], neighbors);
    for (const std::size_t s : shapes_on[bodies[i]]) {
      RefinedMesh mesh = refined(placed(s), sky);
      if (mesh.is_refined) shapes.shapes[s].lit = std::make_shared<const TriangleMesh>(std::move(mesh.mesh));
      shapes.shapes[s].openness = std::make_shared<const std::vector<std::uint8_t>>(std::move(mesh.openness));
    }
  });
}

}  // namespace chainreel
