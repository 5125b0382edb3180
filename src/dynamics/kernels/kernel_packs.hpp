// Vectors of 2 and 4 doubles, and the sine and cosine of each lane, for vectors of 128 bits, which every x86-64
// processor has. Each lane does what a scalar would, and no operation is fused or re-ordered. Wider vectors gained no
// command a quarter of its time.
#pragma once

#include "core/scalar.hpp"

namespace chainreel {

// What the packed sine and cosine of kernel_packs.hpp need from outside their file.

// The constants of core/scalar.hpp's sin_cos, in each of four lanes: operands in memory, which the compiler
// must not see through, or it would load each by an instruction of its own.
struct alignas(32) SinCosTable {
  using Lanes = double[4];
  Lanes two_over_pi, round_to_integer, half_pi[2], rare, one, half, sin[6], cos[6], no_sign, bit_two;
};
extern const SinCosTable kSinCosTable;

// Takes n angles one by one: the way for lanes with rare angles.
void sin_cos_of_each(const double* x, int n, double* s, double* c);

namespace {

using Pack2 = double __attribute__((vector_size(16)));
using Bits2 = std::uint64_t __attribute__((vector_size(16)));

// Two halves; left to itself the compiler would take every lane one by one.
struct Pack4 {
  Pack2 lo{}, hi{};
  Pack4() = default;
  Pack4(const Pack2& lower, const Pack2& higher) : lo(lower), hi(higher) {}
  Pack4(double x, double y, double z, double w) : lo{x, y}, hi{z, w} {}
  double operator[](int i) const { return i < 2 ? lo[i] : hi[i - 2]; }
  Pack4& operator+=(const Pack4& b) { return *this = *this + b; }
  Pack4& operator-=(const Pack4& b) { return *this = *this - b; }
  friend Pack4 operator+(const Pack4& a, const Pack4& b) { return {a.lo + b.lo, a.hi + b.hi}; }
  friend Pack4 operator-(const Pack4& a, const Pack4& b) { return {a.lo - b.lo, a.hi - b.hi}; }
  friend Pack4 operator*(const Pack4& a, const Pack4& b) { return {a.lo * b.lo, a.hi * b.hi}; }
  friend Pack4 operator*(const Pack4& a, double k) { return {a.lo * k, a.hi * k}; }
};

template <class Pack>
using BitsOf = Bits2;

inline bool all_signs(const Pack2& x) {
  return __builtin_ia32_movmskpd(x) == 3;
}

inline Pack2 choose(const Bits2& mask, const Pack2& a, const Pack2& b) {
  const Bits2 all = -(mask >> 63);
  return Pack2((Bits2(a) & all) | (Bits2(b) & ~all));
}

template <int k>
inline Pack4 lane(const Pack4& x) {
  const Pack2& half = k < 2 ? x.lo : x.hi;
  const Pack2 both = __builtin_shufflevector(half, half, k % 2, k % 2);
  return {both, both};
}

inline Pack4 turned_lanes(const Pack4& x) {
  return {__builtin_shufflevector(x.lo, x.hi, 1, 2), __builtin_shufflevector(x.lo, x.hi, 0, 3)};
}

inline Pack2 sums_of(const Pack4& a, const Pack4& b) {
  const Pack2 lower = __builtin_shufflevector(a.lo, b.lo, 0, 2) + __builtin_shufflevector(a.lo, b.lo, 1, 3);
  const Pack2 higher = __builtin_shufflevector(a.hi, b.hi, 0, 2) + __builtin_shufflevector(a.hi, b.hi, 1, 3);
  return lower + higher;
}
inline Pack4 sums_of(const Pack4& a, const Pack4& b, const Pack4& c, const Pack4& d) {
  return {sums_of(a, b), sums_of(c, d)};
}

inline Pack4 masked(const Pack4& x, const std::uint64_t* lanes) {
  const auto* const mask = reinterpret_cast<const Bits2*>(lanes);
  return {Pack2(Bits2(x.lo) & mask[0]), Pack2(Bits2(x.hi) & mask[1])};
}

enum class Angles { common, any };  // whether rare ones are looked for

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
[[gnu::always_inline]] inline bool sin_cos_of_common(const Pack& x, Pack& s, Pack& c) {
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
  s = Pack(Bits(choose(swapped, cosine, sine)) ^ sign_s);
  c = Pack(Bits(choose(swapped, sine, cosine)) ^ (sign_s ^ swapped));
  return true;
}
[[gnu::always_inline]] inline bool sin_cos_of_common(const Pack4& x, Pack4& s, Pack4& c) {
  return sin_cos_of_common(x.lo, s.lo, c.lo) && sin_cos_of_common(x.hi, s.hi, c.hi);
}

// Takes any angles, by the scalar function.
inline void sin_cos_of_any(const Pack2& x, Pack2& s, Pack2& c) {
  double angles[2] = {x[0], x[1]}, sines[2], cosines[2];
  sin_cos_of_each(angles, 2, sines, cosines);
  s = Pack2{sines[0], sines[1]};
  c = Pack2{cosines[0], cosines[1]};
}
inline void sin_cos_of_any(const Pack4& x, Pack4& s, Pack4& c) {
  double angles[4] = {x[0], x[1], x[2], x[3]}, sines[4], cosines[4];
  sin_cos_of_each(angles, 4, sines, cosines);
  s = Pack4{sines[0], sines[1], sines[2], sines[3]};
  c = Pack4{cosines[0], cosines[1], cosines[2], cosines[3]};
}

}  // namespace
}  // namespace chainreel
