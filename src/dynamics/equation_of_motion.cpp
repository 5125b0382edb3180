// Forward dynamics: qdd = M^-1 (tau - nle - tau_f).
//
// Small chains have kernels of their own: up to four joints that turn in one plane, and up to 15 turning or
// sliding joints in space. Chains whose bodies share a coordinate (mimic) take M from CRBA and nle from RNEA
// and solve with L D L^T; the articulated-body algorithm knows no shared coordinates. All others take the
// articulated-body algorithm. Which one it is depends on the chain alone, never on the processor.
#include "dynamics/equation_of_motion.hpp"

#include "dynamics/algebra.hpp"
#include "dynamics/friction.hpp"
#include "dynamics/kernels/kernels.hpp"
#include "dynamics/recursions.hpp"
#include "dynamics/scratch.hpp"

namespace chainreel {

namespace {

void by_articulated_bodies(const Chain&, Workspace& ws, ConstVec q, ConstVec qd, ConstVec tau, double* qdd) {
  with_links(ws, [&](auto& links) {
    place(links, q);
    aba(links, links.base_acceleration, qd, tau, Vec(qdd, tau.size()));
  });
}

void by_mass_matrix(const Chain&, Workspace& ws, ConstVec q, ConstVec qd, ConstVec tau, double* qdd) {
  Workspace::Scratch& scratch = *ws.scratch;
  const std::size_t n = tau.size();
  with_links(ws, [&](auto& links) {
    place(links, q);
    crba(links, n, scratch.M.data());
    rnea(links, links.base_acceleration, qd, ConstVec(scratch.zeros), Vec(ws.nle));
  });
  for (std::size_t i = 0; i < n; ++i) qdd[i] = tau[i] - ws.nle[i];
  ldlt_factor(int(n), scratch.M.data());
  ldlt_solve(int(n), scratch.M.data(), qdd);
}

void with_friction(const Chain& chain, Workspace& ws, ConstVec q, ConstVec qd, ConstVec tau, double* qdd) {
  Workspace::Scratch& scratch = *ws.scratch;
  compute_friction(chain, ws, qd);
  for (std::size_t i = 0; i < tau.size(); ++i) scratch.tau_net[i] = tau[i] - ws.tau_f[i];
  scratch.smooth_dynamics(chain, ws, q, qd, scratch.tau_net, qdd);
}

ForwardDynamics smooth_dynamics_of(const Chain& chain, const Workspace::Scratch& scratch) {
  switch (algorithm_of(chain)) {
    case Algorithm::planar_kernel:
      return dynamics_of(scratch.planar_kernel);
    case Algorithm::spatial_kernel:
      return dynamics_of(scratch.spatial_kernel);
    case Algorithm::mass_matrix:
      return by_mass_matrix;
    default:
      return by_articulated_bodies;
  }
}

}  // namespace

Algorithm algorithm_of(const Chain& chain) {
  if (planar_kernel_of(chain).joints > 0) return Algorithm::planar_kernel;
  if (!chain.planar && spatial_kernel_of(chain).joints > 0) return Algorithm::spatial_kernel;
  return chain.has_mimic ? Algorithm::mass_matrix : Algorithm::articulated_body;
}

void choose_forward_dynamics(const Chain& chain, Workspace::Scratch& scratch) {
  scratch.smooth_dynamics = smooth_dynamics_of(chain, scratch);
  scratch.forward_dynamics = chain.has_dissipation ? with_friction : scratch.smooth_dynamics;
}

void compute_forward_dynamics(const Chain& chain, Workspace& ws, ConstVec q, ConstVec qd, ConstVec tau) {
  ws.require_sizes(chain, q, qd, tau);
  ws.scratch->forward_dynamics(chain, ws, q, qd, tau, ws.qdd.data());
}

void compute_forward_dynamics(const Chain& chain, Workspace& ws, ConstVec q, ConstVec qd, ConstVec tau,
                              Vec qdd) {
  ws.require_sizes(chain, q, qd, tau, qdd);
  ws.scratch->forward_dynamics(chain, ws, q, qd, tau, qdd.data());
}

std::string forward_dynamics_algorithm(const Chain& chain) {
  const std::string algebra = chain.planar ? "planar " : "spatial ";
  switch (algorithm_of(chain)) {
    case Algorithm::planar_kernel:
      return "planar, unrolled for " + std::to_string(chain.nv) + " joints";
    case Algorithm::spatial_kernel:
      return "spatial, CRBA and LDL^T about one point";
    case Algorithm::articulated_body:
      return algebra + "ABA";
    case Algorithm::mass_matrix:
      return algebra + "CRBA and LDL^T";
  }
  return {};
}

}  // namespace chainreel
