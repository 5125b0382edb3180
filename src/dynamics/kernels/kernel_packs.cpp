#include "dynamics/kernels/kernel_packs.hpp"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <iterator>

#include "core/scalar.hpp"

namespace chainreel {

namespace {

constexpr SinCosTable make_sin_cos_table() {
  using namespace detail;
  SinCosTable t{};
  const auto fill = [](SinCosTable::Lanes& lanes, double x) {
    std::fill(std::begin(lanes), std::end(lanes), x);
  };
  fill(t.two_over_pi, kTwoOverPi);
  fill(t.round_to_integer, kRoundToInteger);
  fill(t.half_pi[0], kHalfPi1);
  fill(t.half_pi[1], kHalfPi2 + kHalfPi3);  // 33 bits and the next 20
  fill(t.rare, 0x1p-19);
  fill(t.one, 1);
  fill(t.half, 0.5);
  for (std::size_t k = 0; k < 6; ++k) {
    fill(t.sin[k], kSin[k]);
    fill(t.cos[k], kCos[k]);
  }
  fill(t.no_sign, std::bit_cast<double>(~std::uint64_t(0) >> 1));
  fill(t.bit_two, std::bit_cast<double>(std::uint64_t(2)));
  return t;
}

}  // namespace

constinit const SinCosTable kSinCosTable = make_sin_cos_table();

void sin_cos_of_each(const double* x, int n, double* s, double* c) {
  for (int i = 0; i < n; ++i) {
    const auto [sin, cos] = sin_cos(x[i]);
    s[i] = sin;
    c[i] = cos;
  }
}

}  // namespace chainreel
