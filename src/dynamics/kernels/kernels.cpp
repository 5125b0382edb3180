#include "dynamics/kernels/kernels.hpp"

#include "dynamics/kernels/kernel_planar_text.hpp"
#include "dynamics/kernels/kernel_spatial_text.hpp"

namespace chainreel {

ForwardDynamics dynamics_of(const PlanarKernel& kernel) {
  return planar_kernel_for(kernel);
}

ForwardDynamics dynamics_of(const SpatialKernel& kernel) {
  return spatial_kernel_for(kernel);
}

}  // namespace chainreel
