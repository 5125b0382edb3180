// Forward dynamics unrolled for small chains. The same text is compiled for every processor and for those
// with 256-bit vectors; both give the same bits.
#pragma once

#include "dynamics/kernel_planar.hpp"
#include "dynamics/scratch.hpp"

namespace chainreel {

ForwardDynamics planar_kernel_for_any_processor(const PlanarKernel& kernel);
ForwardDynamics planar_kernel_for_avx2(const PlanarKernel& kernel);
ForwardDynamics spatial_kernel_for_any_processor(const SpatialKernel& kernel);
ForwardDynamics spatial_kernel_for_avx2(const SpatialKernel& kernel);

}  // namespace chainreel
