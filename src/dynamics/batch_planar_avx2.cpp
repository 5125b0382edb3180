// What these headers define stays for every processor: it is read before the choice.
#include "core/scalar.hpp"
#include "dynamics/batch_planar.hpp"
#include "dynamics/kernel_sin_cos.hpp"

#pragma GCC target("avx2")

namespace chainreel {
namespace {

using Lanes = double __attribute__((vector_size(32)));
using Bits = std::uint64_t __attribute__((vector_size(32)));

// A bit for each lane with a >= b; not for NaN.
inline unsigned lanes_not_below(const Lanes& a, const Lanes& b) {
  return unsigned(__builtin_ia32_movmskpd256(Lanes(a >= b)));
}

// a in lanes with an odd k, else b.
inline Lanes odd_of(const Bits& k, const Lanes& a, const Lanes& b) {
  return __builtin_ia32_blendvpd256(b, a, Lanes(k << 63));
}

}  // namespace
}  // namespace chainreel

#include "dynamics/batch_planar_text.hpp"

namespace chainreel {

StepPlanarBlocks planar_batch_for_avx2(const PlanarKernel& kernel) {
  return planar_batch_of(kernel);
}

}  // namespace chainreel
