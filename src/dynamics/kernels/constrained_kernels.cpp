#include "dynamics/kernels/constrained_planar_text.hpp"
#include "dynamics/kernels/constrained_spatial_text.hpp"

namespace chainreel {

ConstrainedKernel::Run constrained_run(const PlanarKernel& kernel, int rows) {
  return constrained_kernel_for(kernel.joints, rows);
}

ConstrainedKernel::Run constrained_run(const SpatialKernel& kernel, int rows) {
  return constrained_spatial_for(kernel, rows);
}

}  // namespace chainreel
