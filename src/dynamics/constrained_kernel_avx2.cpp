// What these headers define stays for every processor: it is read before the choice.
#include <bit>
#include <cmath>

#include "core/scalar.hpp"
#include "dynamics/constrained_workspace.hpp"
#include "dynamics/kernel_sin_cos.hpp"
#include "dynamics/scratch.hpp"

#pragma GCC target("avx2")
#define CHAINREEL_WIDE_VECTORS

#include "dynamics/constrained_kernel_text.hpp"
#include "dynamics/constrained_spatial_text.hpp"

namespace chainreel {

ConstrainedKernel::Run constrained_kernel_for_avx2(int joints, int rows) {
  return constrained_kernel_for(joints, rows);
}

ConstrainedKernel::Run constrained_spatial_for_avx2(const SpatialKernel& kernel, int rows) {
  return constrained_spatial_for(kernel, rows);
}

}  // namespace chainreel
