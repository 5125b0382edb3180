#include "dynamics/kernel_planar_text.hpp"
#include "dynamics/kernel_spatial_text.hpp"
#include "dynamics/kernels.hpp"

namespace chainreel {

ForwardDynamics planar_kernel_for_any_processor(const PlanarKernel& kernel) {
  return planar_kernel_for(kernel);
}

ForwardDynamics spatial_kernel_for_any_processor(const SpatialKernel& kernel) {
  return spatial_kernel_for(kernel);
}

}  // namespace chainreel
