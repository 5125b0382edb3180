// Forward dynamics: qdd = M^-1 (tau - nle - tau_f).
//
// Chains whose bodies share a coordinate (mimic) take M from CRBA and nle from RNEA and solve with L D L^T;
// the articulated-body algorithm knows no shared coordinates. All others take the articulated-body algorithm.
#include "dynamics/forward_dynamics.hpp"

#include "dynamics/friction.hpp"
#include "dynamics/ldlt.hpp"
#include "dynamics/recursions.hpp"
#include "dynamics/scratch.hpp"

namespace chainreel {

namespace {

template <class A>
void solve_mass_matrix(Links<A>& links, Workspace& ws, ConstVec qd, ConstVec tau) {
  Workspace::Scratch& scratch = *ws.scratch;
  const std::size_t n = tau.size();
  crba(links, n, scratch.M.data());
  rnea(links, links.base_acceleration, qd, ConstVec(scratch.zeros), Vec(ws.nle));
  for (std::size_t i = 0; i < n; ++i) ws.qdd[i] = tau[i] - ws.nle[i];
  ldlt_factor(int(n), scratch.M.data());
  ldlt_solve(int(n), scratch.M.data(), ws.qdd.data());
}

}  // namespace

Algorithm algorithm_of(const Chain& chain) {
  if (planar_kernel_of(chain).run) return Algorithm::planar_kernel;
  return chain.has_mimic ? Algorithm::mass_matrix : Algorithm::articulated_body;
}

namespace {

// Apart from the short way, so that it stays free of what a longer one saves and restores.
[[gnu::noinline]] void take_the_long_way(const Chain& chain, Workspace& ws, ConstVec q, ConstVec qd,
                                         ConstVec tau) {
  Workspace::Scratch& scratch = *ws.scratch;
  if (chain.has_dissipation) {
    compute_friction(chain, ws, qd);
    for (std::size_t i = 0; i < tau.size(); ++i) scratch.tau_net[i] = tau[i] - ws.tau_f[i];
    tau = scratch.tau_net;
  }
  if (scratch.algorithm == Algorithm::planar_kernel) {
    scratch.planar_kernel.run(scratch.planar_kernel, q.data(), qd.data(), tau.data(), ws.qdd.data());
    return;
  }
  with_links(ws, [&](auto& links) {
    place(links, q);
    if (scratch.algorithm == Algorithm::mass_matrix) return solve_mass_matrix(links, ws, qd, tau);
    aba(links, links.base_acceleration, qd, tau, Vec(ws.qdd));
  });
}

}  // namespace

void compute_forward_dynamics(const Chain& chain, Workspace& ws, ConstVec q, ConstVec qd, ConstVec tau) {
  const Workspace::Scratch& scratch = *ws.scratch;
  if (!scratch.kernel_alone) return take_the_long_way(chain, ws, q, qd, tau);
  scratch.kernel_alone(scratch.planar_kernel, q.data(), qd.data(), tau.data(), ws.qdd.data());
}

std::string forward_dynamics_algorithm(const Chain& chain) {
  const std::string algebra = chain.planar ? "planar " : "spatial ";
  switch (algorithm_of(chain)) {
    case Algorithm::planar_kernel:
      return "planar, unrolled for " + std::to_string(chain.nv) + " joints";
    case Algorithm::articulated_body:
      return algebra + "ABA";
    case Algorithm::mass_matrix:
      return algebra + "CRBA and LDL^T";
  }
  return {};
}

}  // namespace chainreel
