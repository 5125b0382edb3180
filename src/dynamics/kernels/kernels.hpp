// Forward dynamics unrolled for small chains.
#pragma once

#include "dynamics/kernels/kernel_planar.hpp"
#include "dynamics/scratch.hpp"

namespace chainreel {

ForwardDynamics dynamics_of(const PlanarKernel& kernel);
ForwardDynamics dynamics_of(const SpatialKernel& kernel);

}  // namespace chainreel
