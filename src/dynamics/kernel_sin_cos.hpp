// What the packed sine and cosine of kernel_packs.hpp need from outside their file.
#pragma once

namespace chainreel {

// The constants of core/scalar.hpp's sin_cos, in each of four lanes: operands in memory, which the compiler
// must not see through, or it would load each by an instruction of its own.
struct alignas(32) SinCosTable {
  using Lanes = double[4];
  Lanes two_over_pi, round_to_integer, half_pi[2], rare, one, half, sin[6], cos[6], no_sign, bit_two;
};
extern const SinCosTable kSinCosTable;

// Of n angles, one by one: the way for lanes with rare angles.
void sin_cos_of_each(const double* x, int n, double* s, double* c);

}  // namespace chainreel
