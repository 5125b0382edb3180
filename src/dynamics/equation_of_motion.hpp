// The equation of motion tau = M(q) qdd + nle(q, qd), nle = C(q, qd) qd + tau_g(q), either way round: qdd of a chain
// under given torques by the cheapest algorithm that fits it, torques of a motion, and its terms one by one.
#pragma once

#include <Eigen/Core>

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

// The joint-space mass matrix by the composite-rigid-body algorithm.

// Writes ws.M (nv x nv, both halves).
void compute_mass_matrix(const Chain& chain, Workspace& ws, ConstVec q);

// Forward dynamics by the articulated-body algorithm: O(n). Not for chains with mimic joints (their
// coordinates are shared between bodies); compute_forward_dynamics takes the mass matrix there.

// ws.qdd = M(q)^-1 (tau - nle(q, qd)); joint friction is not subtracted here.
void compute_aba(const Chain& chain, Workspace& ws, ConstVec q, ConstVec qd, ConstVec tau);

// Inverse dynamics by the recursive Newton-Euler algorithm. Joint friction is apart (dynamics/friction.hpp).

// ws.tau = M(q) qdd + nle(q, qd), N m or N.
void compute_inverse_dynamics(const Chain& chain, Workspace& ws, ConstVec q, ConstVec qd, ConstVec qdd);
// ws.nle = C(q, qd) qd + tau_g(q)
void compute_nle(const Chain& chain, Workspace& ws, ConstVec q, ConstVec qd);
// ws.tau_g
void compute_gravity_torque(const Chain& chain, Workspace& ws, ConstVec q);

// What the ground exerts on a chain that stands on it: the force and moment behind all joints of the world,
// and the support of the links that are fixed to it.

struct Wrench {
  Eigen::Vector3d force = Eigen::Vector3d::Zero();   // N, in W
  Eigen::Vector3d moment = Eigen::Vector3d::Zero();  // N m, about the world's origin
};

// At this motion, whatever torques make it: by Newton and Euler the rate of all momentum less what gravity
// adds to it. Of planar chains the part in their plane. Writes ws.tau, too.
Wrench compute_ground_reaction(const Chain& chain, Workspace& ws, ConstVec q, ConstVec qd, ConstVec qdd);

// The matrix C of nle = C(q, qd) qd + tau_g, from Christoffel symbols: the one choice of C for which
// Mdot - 2 C is skew for every motion and C is made of derivatives of M alone.

// nv x nv, in O(nv d) for a tree of depth d. For floating joints see coriolis.cpp: the two properties hold there too.
Eigen::MatrixXd coriolis_matrix_of(const Chain& chain, ConstVec q, ConstVec qd);

}  // namespace chainreel
