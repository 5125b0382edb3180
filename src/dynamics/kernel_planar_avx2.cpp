// What these headers define stays for every processor: it is read before the choice.
#include <array>
#include <bit>
#include <cmath>

#include "core/scalar.hpp"
#include "dynamics/kernel_planar.hpp"

#pragma GCC target("avx2")
#define CHAINREEL_WIDE_VECTORS

#include "dynamics/kernel_planar_text.hpp"

namespace chainreel {

PlanarKernel::Run planar_kernel_for_avx2(int joints, bool along_x, bool turned) {
  return planar_kernel_for(joints, along_x, turned);
}

}  // namespace chainreel
