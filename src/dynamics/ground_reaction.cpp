// The forces f of the recursive Newton-Euler algorithm (rnea.cpp) across the joints on the world, moved to
// its origin. Gravity is in them, since the world of the recursion rises at -g.
#include "dynamics/ground_reaction.hpp"

#include "dynamics/recursions.hpp"
#include "dynamics/scratch.hpp"

namespace chainreel {
namespace {

using Eigen::Vector3d;

void add(Wrench& sum, const Chain& chain, const Planar<double>::Force& f) {
  const Plane& plane = chain.planar->plane;
  sum.force += f.x * plane.ex + f.y * plane.ey;
  sum.moment += f.n * plane.normal;
}

void add(Wrench& sum, const Chain&, const Spatial<double>::Force& f) {
  sum.force += Vector3d(f.f.x, f.f.y, f.f.z);
  sum.moment += Vector3d(f.n.x, f.n.y, f.n.z);
}

}  // namespace

Wrench compute_ground_reaction(const Chain& chain, Workspace& ws, ConstVec q, ConstVec qd, ConstVec qdd) {
  Wrench sum;
  const Inertia& fixed = chain.bodies[0].inertia;
  Vector3d support = -fixed.mass * chain.gravity;
  if (chain.planar) support -= support.dot(chain.planar->plane.normal) * chain.planar->plane.normal;
  sum.force = support;
  sum.moment = fixed.com.cross(support);
  if (chain.planar) sum.moment = sum.moment.dot(chain.planar->plane.normal) * chain.planar->plane.normal;
  with_links(ws, [&](auto& links) {
    using A = typename std::remove_reference_t<decltype(links)>::Algebra;
    place(links, q);
    rnea(links, links.base_acceleration, qd, qdd, Vec(ws.tau));
    for (std::size_t i = 1; i < links.size(); ++i)
      if (links.joint[i].parent == 0) add(sum, chain, A::to_parent(links.X[i], links.f[i]));
  });
  return sum;
}

}  // namespace chainreel
