#include "dynamics/constrained_kernel_text.hpp"
#include "dynamics/constrained_spatial_text.hpp"

namespace chainreel {

ConstrainedKernel::Run constrained_kernel_for_any_processor(int joints, int rows) {
  return constrained_kernel_for(joints, rows);
}

ConstrainedKernel::Run constrained_spatial_for_any_processor(const SpatialKernel& kernel, int rows) {
  return constrained_spatial_for(kernel, rows);
}

}  // namespace chainreel
