// What stands behind Workspace: the arrays of the recursions in the algebra that the chain takes.
#pragma once

#include <utility>
#include <variant>
#include <vector>

#include "dynamics/kernels/kernel_planar.hpp"
#include "dynamics/kernels/kernel_spatial.hpp"
#include "dynamics/links.hpp"
#include "dynamics/workspace.hpp"

namespace chainreel {


// Writes nv numbers at qdd. Chosen once, when the workspace is made: a run then costs one indirect call.
using ForwardDynamics = void (*)(const Chain& chain, Workspace& ws, ConstVec q, ConstVec qd, ConstVec tau,
                                 double* qdd);

struct Workspace::Scratch {
  explicit Scratch(const Chain& chain);

  std::variant<Links<Planar<double>>, Links<Spatial<double>>> links;
  PlanarKernel planar_kernel;
  SpatialKernel spatial_kernel;
  ForwardDynamics forward_dynamics = nullptr;  // all of it
  ForwardDynamics smooth_dynamics = nullptr;   // without friction
  std::vector<double> zeros;                   // nv: the velocity or acceleration of what rests
  std::vector<double> tau_net;                 // nv: tau - tau_f, for chains with friction
  std::vector<double> M;                       // nv x nv, then its factor, for Algorithm::mass_matrix
};

void choose_forward_dynamics(const Chain& chain, Workspace::Scratch& scratch);

// Calls `run` with the arrays of the chain's algebra.
template <class Run>
decltype(auto) with_links(Workspace& ws, Run&& run) {
  return std::visit(std::forward<Run>(run), ws.scratch->links);
}

}  // namespace chainreel
