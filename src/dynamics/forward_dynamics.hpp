// qdd of a chain under given torques, by the cheapest algorithm that fits it.
#pragma once

#include "dynamics/workspace.hpp"

namespace chainreel {

// ws.qdd = M(q)^-1 (tau - nle(q, qd) - tau_f(qd)).
void compute_forward_dynamics(const Chain& chain, Workspace& ws, ConstVec q, ConstVec qd, ConstVec tau);

// The same into qdd (nv) instead of ws.qdd: a step that depends on the last one waits for every copy.
void compute_forward_dynamics(const Chain& chain, Workspace& ws, ConstVec q, ConstVec qd, ConstVec tau,
                              Vec qdd);

// Ways to forward dynamics; which one a chain takes depends on the chain alone.
enum class Algorithm {
  planar_kernel,     // kernels/kernel_planar.hpp: up to four joints that turn in one plane
  spatial_kernel,    // kernels/kernel_spatial.hpp: up to 15 joints, turning or sliding
  articulated_body,  // O(n)
  mass_matrix,       // CRBA, RNEA and L D L^T: chains whose bodies share coordinates
};
Algorithm algorithm_of(const Chain& chain);

// Its name for `check`: e.g. "planar, unrolled for 2 joints", "spatial ABA".
std::string forward_dynamics_algorithm(const Chain& chain);

}  // namespace chainreel
