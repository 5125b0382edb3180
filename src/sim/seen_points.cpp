#include "sim/seen_points.hpp"

#include <algorithm>
#include <cmath>

#include "core/dense.hpp"
#include "dynamics/kinematics.hpp"

namespace chainreel {
namespace {

using Eigen::Vector3d;

constexpr double kTurn = 0.5;       // rad or m, that a freedom is moved by
constexpr double kUnmoved = 1e-12;  // of the mechanism's extent

bool spans_space(const std::vector<Vector3d>& points) {
  Eigen::AlignedBox3d box;
  for (const Vector3d& p : points) box.extend(p);
  return !box.isEmpty() && box.sizes().minCoeff() > 0;
}

// Of the uniform box with this mass and inertia: along a principal axis i half as long as
// sqrt(3 (I_j + I_k - I_i) / (2 m)). Files that give moments about one axis only make it flat.
std::vector<Vector3d> corners_of_equal_box(const Inertia& inertia) {
  if (!(inertia.mass > 0)) return {};
  const SymmetricEigen principal = eigen_of_symmetric(inertia.about_com);
  const Vector3d moments = principal.values;
  Eigen::Matrix3d half = principal.vectors;
  for (int i = 0; i < 3; ++i)
    half.col(i) *= std::sqrt(std::max(0.0, 3 * (moments.sum() - 2 * moments[i]) / (2 * inertia.mass)));
  if (!half.allFinite() || half.isZero(0)) return {};
  std::vector<Vector3d> corners;
  for (int i = 0; i < 8; ++i)
    corners.push_back(inertia.com + half * Vector3d(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1));
  return corners;
}

}  // namespace

SeenPoints::SeenPoints(const Simulation& simulation) {
  const Chain& chain = simulation.chain;
  const auto add = [&](int body, const Vector3d& place) {
    const auto same = [&](const Point& one) { return one.body == body && one.place == place; };
    if (std::none_of(points_.begin(), points_.end(), same)) points_.push_back({body, place});
  };
  const auto add_frame = [&](int index) {
    const Frame& frame = chain.frames[std::size_t(index)];
    add(frame.body, frame.X_BF.translation());
  };
  const int bodies = int(chain.bodies.size());
  for (int b = 1; b < bodies; ++b) add(b, Vector3d::Zero());
  for (const int frame : chain.leaf_frames) add_frame(frame);
  if (chain.end_effector >= 0) add_frame(chain.end_effector);
  for (int b = 1; b < bodies; ++b) {
    const Inertia& inertia = chain.bodies[std::size_t(b)].inertia;
    if (inertia.mass > 0) add(b, inertia.com);
  }
  bars_ = points_.size();
  for (int b = 1; b < bodies; ++b) {
    const auto& outlines = simulation.outline.points;
    const std::vector<Vector3d> outline = outlines.empty() ? std::vector<Vector3d>{} : outlines[std::size_t(b)];
    for (const Vector3d& place : outline) add(b, place);
    if (spans_space(outline)) continue;
    for (const Vector3d& place : corners_of_equal_box(chain.bodies[std::size_t(b)].inertia)) add(b, place);
  }
}

void SeenPoints::read(const Workspace& ws, std::vector<Vector3d>& places) const {
  places.clear();
  for (const Point& point : points_)
    places.push_back(point.body == 0 ? point.place : Vector3d(ws.X_WB[std::size_t(point.body)] * point.place));
}

std::vector<std::string> unseen_freedoms(const Simulation& simulation, const Trajectory& run) {
  const Chain& chain = simulation.chain;
  const SeenPoints points(simulation);
  Workspace ws(chain);
  std::vector<Vector3d> places, moved;
  std::vector<double> rate(std::size_t(chain.nv)), q;
  std::vector<bool> seen(rate.size(), false);
  const int last = run.size() - 1;
  for (const int k : {0, last / 2, last}) {
    if (last < 0) break;
    std::fill(rate.begin(), rate.end(), 0);
    compute_kinematics(chain, ws, run.q_at(k), rate);
    points.read(ws, places);
    Eigen::AlignedBox3d box;
    for (const Vector3d& place : places) box.extend(place);
    const double least = kUnmoved * (1 + box.diagonal().norm() + box.center().norm());
    for (std::size_t i = 0; i < rate.size(); ++i) {
      if (seen[i]) continue;
      std::fill(rate.begin(), rate.end(), 0);
      q.assign(run.q_at(k).begin(), run.q_at(k).end());
      rate[i] = 1;
      advance(chain, q, rate, kTurn);
      compute_kinematics(chain, ws, q, rate);
      points.read(ws, moved);
      for (std::size_t p = 0; p < places.size(); ++p) seen[i] = seen[i] || !((moved[p] - places[p]).norm() <= least);
    }
  }
  std::vector<std::string> names;
  for (std::size_t i = 0; i < rate.size(); ++i)
    if (!seen[i]) names.push_back(chain.coordinate_names[i]);
  return names;
}

}  // namespace chainreel
