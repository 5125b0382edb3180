#include "dynamics/workspace.hpp"

#include <string>

#include "core/error.hpp"
#include "dynamics/equation_of_motion.hpp"
#include "dynamics/scratch.hpp"

namespace chainreel {

namespace {

std::variant<Links<Planar<double>>, Links<Spatial<double>>> links_of(const Chain& chain) {
  if (chain.planar) return Links<Planar<double>>(chain);
  return Links<Spatial<double>>(chain);
}

}  // namespace

Workspace::Scratch::Scratch(const Chain& chain)
    : links(links_of(chain)),
      planar_kernel(planar_kernel_of(chain)),
      spatial_kernel(spatial_kernel_of(chain)) {
  const auto nv = std::size_t(chain.nv);
  zeros.resize(nv);
  if (chain.has_dissipation) tau_net.resize(nv);
  if (algorithm_of(chain) == Algorithm::mass_matrix) M.resize(nv * nv);
  choose_forward_dynamics(chain, *this);
}

Workspace::Workspace(const Chain& chain) : scratch(std::make_unique<Scratch>(chain)) {
  const auto nv = std::size_t(chain.nv);
  for (auto* vector : {&qdd, &tau, &nle, &tau_g, &tau_f}) vector->resize(nv);
  X_WB.resize(chain.bodies.size(), Eigen::Isometry3d::Identity());
  v_WB.resize(chain.bodies.size(), Eigen::Vector3d::Zero());
  w_WB.resize(chain.bodies.size(), Eigen::Vector3d::Zero());
}

void Workspace::refuse_sizes(const Chain& chain) const {
  if (qdd.size() != std::size_t(chain.nv)) throw Error(ExitCode::bad_input, "the workspace is one of another chain: make one of this, Workspace ws(chain)");
  throw Error(ExitCode::bad_input, "a vector is of another size than the chain's: q has nq = " + std::to_string(chain.nq) +
                                       " numbers, qd, qdd and tau have nv = " + std::to_string(chain.nv) + " each");
}

Workspace::~Workspace() = default;
Workspace::Workspace(Workspace&&) noexcept = default;
Workspace& Workspace::operator=(Workspace&&) noexcept = default;

}  // namespace chainreel
