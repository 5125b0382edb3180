// Vectors of 2 and 4 doubles, and the sine and cosine of each lane. Compiled once for every processor and
// once for those with 256-bit vectors: included by kernels_any.cpp and kernels_avx2.cpp alone, behind their
// choice of processor, and private to them.
//
// Bits: each lane does what a scalar would, and no operation is fused or re-ordered, so that the width of the
// vectors does not show. No lambdas here: g++ 12 compiles them for the common processor. Nor does it define
// __AVX2__ behind the choice.
#pragma once

#include "core/scalar.hpp"
#include "dynamics/kernel_sin_cos.hpp"

namespace chainreel {
namespace {

using Pack2 = double __attribute__((vector_size(16)));
using Pack4 = double __attribute__((vector_size(32)));
using Bits2 = std::uint64_t __attribute__((vector_size(16)));
using Bits4 = std::uint64_t __attribute__((vector_size(32)));

template <int n>
using PackOf = std::conditional_t<n <= 2, Pack2, Pack4>;
template <class Pack>
using BitsOf = std::conditional_t<sizeof(Pack) == 16, Bits2, Bits4>;

// These few are all that is not arithmetic. For common processors the compiler splits Pack4 in two by itself.
#ifdef CHAINREEL_WIDE_VECTORS
inline bool all_signs(const Pack2& x) {
  return __builtin_ia32_movmskpd(x) == 3;
}
inline bool all_signs(const Pack4& x) {
  return __builtin_ia32_movmskpd256(x) == 15;
}
// a where the highest bit of the mask is set, else b.
inline void choose(const Bits2& mask, const Pack2& a, const Pack2& b, Pack2& result) {
  result = __builtin_ia32_blendvpd(b, a, Pack2(mask));
}
inline void choose(const Bits4& mask, const Pack4& a, const Pack4& b, Pack4& result) {
  result = __builtin_ia32_blendvpd256(b, a, Pack4(mask));
}
#else
inline bool all_signs(const Pack2& x) {
  return __builtin_ia32_movmskpd(x) == 3;
}
inline bool all_signs(const Pack4& x) {
  return all_signs(__builtin_shufflevector(x, x, 0, 1)) && all_signs(__builtin_shufflevector(x, x, 2, 3));
}
template <class Pack>
inline void choose(const BitsOf<Pack>& mask, const Pack& a, const Pack& b, Pack& result) {
  const BitsOf<Pack> all = -(mask >> 63);
  result = Pack((BitsOf<Pack>(a) & all) | (BitsOf<Pack>(b) & ~all));
}
#endif

template <class Pack>
inline const Pack& load(const double* lanes) {
  return *reinterpret_cast<const Pack*>(lanes);
}

// Sine and cosine of each lane to one and a half units in the last place, by the reduction and the
// polynomials of core/scalar.hpp without the second halves that round them correctly nearly always: those
// cost a tenth of a small chain's whole forward dynamics. The bits differ from the scalar function's, but
// from no processor to another.
//
// k pi/2 is taken off in two parts, the first exact. |r| >= |k| / 2^19 keeps the error of the second below
// 2^-66 of r; it fails for all |k| > 2^19, where the first would end to be exact, and for NaN. Then nothing
// is computed, and the answer is false.
template <class Pack>
inline bool sin_cos_of_common(const Pack& x, Pack& s, Pack& c) {
  using Bits = BitsOf<Pack>;
  const SinCosTable& t = kSinCosTable;
  const Pack shifted = x * load<Pack>(t.two_over_pi) + load<Pack>(t.round_to_integer);
  const Pack k = shifted - load<Pack>(t.round_to_integer);
  const Pack r = (x - k * load<Pack>(t.half_pi[0])) - k * load<Pack>(t.half_pi[1]);
  const Pack size_r = Pack(Bits(r) & Bits(load<Pack>(t.no_sign)));
  const Pack size_k = Pack(Bits(k) & Bits(load<Pack>(t.no_sign)));
  if (!all_signs(Pack(size_r >= size_k * load<Pack>(t.rare)))) [[unlikely]]
    return false;

  const Pack z = r * r;
  const Pack z2 = z * z;
  const Pack z4 = z2 * z2;
  const Pack P = ((load<Pack>(t.sin[0]) + z * load<Pack>(t.sin[1])) +
                  z2 * (load<Pack>(t.sin[2]) + z * load<Pack>(t.sin[3]))) +
                 z4 * (load<Pack>(t.sin[4]) + z * load<Pack>(t.sin[5]));
  const Pack Q = ((load<Pack>(t.cos[0]) + z * load<Pack>(t.cos[1])) +
                  z2 * (load<Pack>(t.cos[2]) + z * load<Pack>(t.cos[3]))) +
                 z4 * (load<Pack>(t.cos[4]) + z * load<Pack>(t.cos[5]));
  const Pack sine = r + r * z * P;
  const Pack cosine = (load<Pack>(t.one) - z * load<Pack>(t.half)) + z2 * Q;

  // After k quarter turns: odd k exchanges the two, bit 1 of k turns the sine's sign, of k + 1 the cosine's.
  const Bits swapped = Bits(shifted) << 63;
  const Bits sign_s = (Bits(shifted) & Bits(load<Pack>(t.bit_two))) << 62;
  choose(swapped, cosine, sine, s);
  choose(swapped, sine, cosine, c);
  s = Pack(Bits(s) ^ sign_s);
  c = Pack(Bits(c) ^ (sign_s ^ swapped));
  return true;
}

// Of any angles, by the scalar function.
template <class Pack>
inline void sin_cos_of_any(const Pack& x, Pack& s, Pack& c) {
  constexpr int kLanes = sizeof(Pack) / sizeof(double);
  double angles[kLanes], sines[kLanes], cosines[kLanes];
  for (int i = 0; i < kLanes; ++i) angles[i] = x[i];
  sin_cos_of_each(angles, kLanes, sines, cosines);
  for (int i = 0; i < kLanes; ++i) s[i] = sines[i], c[i] = cosines[i];
}

}  // namespace
}  // namespace chainreel
