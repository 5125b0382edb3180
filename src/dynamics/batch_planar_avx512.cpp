// What these headers define stays for every processor: it is read before the choice.
#include "core/scalar.hpp"
#include "dynamics/batch_planar.hpp"
#include "dynamics/kernel_sin_cos.hpp"

#pragma GCC target("avx512f,avx512dq,prefer-vector-width=512")

namespace chainreel {
namespace {

using Lanes = double __attribute__((vector_size(64)));
using Bits = std::uint64_t __attribute__((vector_size(64)));

// A bit for each lane with a >= b; not for NaN.
inline unsigned lanes_not_below(const Lanes& a, const Lanes& b) {
  return unsigned(
      __builtin_ia32_cmppd512_mask(a, b, 13 /* >=, false for NaN */, 255, 4 /* no rounding named */));
}

// a in lanes with an odd k, else b.
inline Lanes odd_of(const Bits& k, const Lanes& a, const Lanes& b) {
  return (k & 1) != 0 ? a : b;
}

}  // namespace
}  // namespace chainreel

#include "dynamics/batch_planar_text.hpp"

namespace chainreel {

StepPlanarBlocks planar_batch_for_avx512(const PlanarKernel& kernel) {
  return planar_batch_of(kernel);
}

}  // namespace chainreel
