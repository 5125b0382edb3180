// What these headers define stays for every processor: it is read before the choice.
#include <cstdint>

#include "core/scalar.hpp"
#include "dynamics/taylor_planar_state.hpp"

#pragma GCC target("avx512f,avx512dq,prefer-vector-width=512")

namespace chainreel {
namespace {

using Eight = double __attribute__((vector_size(64)));
using Bits = std::uint64_t __attribute__((vector_size(64)));

template <class Pack>
inline constexpr std::size_t kLinks = 4;

inline Eight swapped(const Eight& x) {
  return __builtin_shufflevector(x, x, 1, 0, 3, 2, 5, 4, 7, 6);
}
inline Eight turned(const Eight& x) {
  constexpr std::uint64_t kSign = std::uint64_t(1) << 63;
  return Eight(Bits(swapped(x)) ^ Bits{0, kSign, 0, kSign, 0, kSign, 0, kSign});
}
inline Eight pair_sums(const Eight& x) {
  return x + swapped(x);
}
inline Eight spread(const Eight* row, std::size_t j) {
  const Eight& x = row[j / 4];
  switch (j % 4) {
    case 0:
      return __builtin_shufflevector(x, x, 0, 1, 0, 1, 0, 1, 0, 1);
    case 1:
      return __builtin_shufflevector(x, x, 2, 3, 2, 3, 2, 3, 2, 3);
    case 2:
      return __builtin_shufflevector(x, x, 4, 5, 4, 5, 4, 5, 4, 5);
    default:
      return __builtin_shufflevector(x, x, 6, 7, 6, 7, 6, 7, 6, 7);
  }
}

}  // namespace
}  // namespace chainreel

#include "dynamics/taylor_planar_text.hpp"

namespace chainreel {

ExpandPlanar<double> expand_planar_for_avx512(int n) {
  return expand_planar_for<Eight, double>(n);
}

}  // namespace chainreel
