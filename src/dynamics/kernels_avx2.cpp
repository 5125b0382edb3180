// What these headers define stays for every processor: it is read before the choice.
#include <bit>
#include <cmath>

#include "core/scalar.hpp"
#include "dynamics/kernel_sin_cos.hpp"
#include "dynamics/kernels.hpp"

#pragma GCC target("avx2")
#define CHAINREEL_WIDE_VECTORS

#include "dynamics/kernel_planar_text.hpp"
#include "dynamics/kernel_spatial_text.hpp"

namespace chainreel {

ForwardDynamics planar_kernel_for_avx2(const PlanarKernel& kernel) {
  return planar_kernel_for(kernel);
}

ForwardDynamics spatial_kernel_for_avx2(const SpatialKernel& kernel) {
  return spatial_kernel_for(kernel);
}

}  // namespace chainreel
