// What these headers define stays for every processor: it is read before the choice.
#include <cstdint>

#include "core/scalar.hpp"
#include "dynamics/taylor_planar_state.hpp"

#pragma GCC target("avx2")

namespace chainreel {
namespace {

using Four = double __attribute__((vector_size(32)));
using Bits = std::uint64_t __attribute__((vector_size(32)));

template <class Pack>
inline constexpr std::size_t kLinks = 2;

inline Four turned(const Four& x) {
  constexpr std::uint64_t kSign = std::uint64_t(1) << 63;
  return Four(Bits(__builtin_shufflevector(x, x, 1, 0, 3, 2)) ^ Bits{0, kSign, 0, kSign});
}
inline Four pair_sums(const Four& x) {
  return x + __builtin_shufflevector(x, x, 1, 0, 3, 2);
}
inline Four spread(const Four* row, std::size_t j) {
  const Four& x = row[j / 2];
  return j % 2 == 0 ? __builtin_shufflevector(x, x, 0, 1, 0, 1) : __builtin_shufflevector(x, x, 2, 3, 2, 3);
}

}  // namespace
}  // namespace chainreel

#include "dynamics/taylor_planar_text.hpp"

namespace chainreel {

ExpandPlanar<double> expand_planar_for_avx2(int n) {
  return expand_planar_for<Four, double>(n);
}

}  // namespace chainreel
