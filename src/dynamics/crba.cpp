// The composite-rigid-body algorithm. R. Featherstone, Rigid Body Dynamics Algorithms (2008), table 6.2,
// after M. Walker, D. Orin (1982). Ic_i is the inertia of all that body i carries, as one rigid body.
//
//   Ic_p += X^T Ic_i X                               back, from the tips
//   M_ii = S_i^T Ic_i S_i,   M_ij = S_j^T X^T .. X^T Ic_i S_i   for each j on the way from i to the base
//
// The parts are added for each pair of bodies, so that bodies which share a coordinate (mimic) come out
// right: a pair of different bodies with the same coordinate adds to its diagonal twice, as (i, j) and as (j,
// i).
#include <algorithm>

#include "dynamics/equation_of_motion.hpp"
#include "dynamics/recursions.hpp"
#include "dynamics/scratch.hpp"

namespace chainreel {

namespace {

// Row k of body i's freedoms against its own and those of every body below it.
template <class A>
void add_row(const Links<A>& links, std::size_t i, std::size_t k, std::size_t n, typename A::Scalar* M) {
  const std::size_t row = links.joint[i].v + k;
  auto F = links.Ic[i] * A::unit_motion(links.body[i], links.S[i], int(k));
  for (std::size_t j = i; j > 0; j = links.joint[j].parent) {
    const auto& joint = links.joint[j];
    for (std::size_t l = 0; l < joint.freedoms; ++l) {
      const std::size_t column = joint.v + l;
      const auto part = A::power(A::unit_motion(links.body[j], links.S[j], int(l)), F);
      M[row * n + column] = M[row * n + column] + part;
      if (j != i) M[column * n + row] = M[column * n + row] + part;
    }
    F = A::to_parent(links.X[j], F);
  }
}

}  // namespace

template <class A>
void crba(Links<A>& links, std::size_t n, typename A::Scalar* M) {
  auto& Ic = links.Ic;
  std::copy(links.I.begin(), links.I.end(), Ic.begin());
  std::fill(M, M + n * n, typename A::Scalar(0));
  for (std::size_t i = links.size(); --i > 0;) {
    const std::size_t parent = links.joint[i].parent;
    if (parent > 0) A::add(Ic[parent], A::to_parent(links.X[i], Ic[i]));
    for (std::size_t k = 0; k < links.joint[i].freedoms; ++k) add_row(links, i, k, n, M);
  }
}

#define INSTANTIATE(A) template void crba<A>(Links<A>&, std::size_t, A::Scalar*);
CHAINREEL_FOR_EACH_ALGEBRA(INSTANTIATE)
#undef INSTANTIATE

void compute_mass_matrix(const Chain& chain, Workspace& ws, ConstVec q) {
  ws.require_sizes(chain, q);
  ws.M.resize(chain.nv, chain.nv);  // symmetric: its order in memory does not matter
  with_links(ws, [&](auto& links) {
    place(links, q);
    crba(links, std::size_t(chain.nv), ws.M.data());
  });
}

}  // namespace chainreel
