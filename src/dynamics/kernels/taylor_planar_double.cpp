#include <cstdint>

#include "dynamics/kernels/taylor_planar_state.hpp"

namespace chainreel {
namespace {

using Pair = double __attribute__((vector_size(16)));
using Bits = std::uint64_t __attribute__((vector_size(16)));

template <class Pack>
inline constexpr std::size_t kLinks = 1;

inline Pair turned(const Pair& x) {
  return Pair(Bits(__builtin_shufflevector(x, x, 1, 0)) ^ Bits{0, std::uint64_t(1) << 63});
}
inline Pair pair_sums(const Pair& x) {
  return x + __builtin_shufflevector(x, x, 1, 0);
}
inline Pair spread(const Pair* row, std::size_t j) {
  return row[j];
}

}  // namespace
}  // namespace chainreel

#include "dynamics/kernels/taylor_planar_text.hpp"

namespace chainreel {

ExpandPlanar<double> expand_doubles(int n) {
  return expand_planar_for<Pair, double>(n);
}

}  // namespace chainreel
