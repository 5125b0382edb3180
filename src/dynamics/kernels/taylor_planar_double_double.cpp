#include <cstdint>

#include "core/double_double.hpp"
#include "dynamics/kernels/taylor_planar_state.hpp"

namespace chainreel {
namespace {

using Pair = double __attribute__((vector_size(16)));
using Bits = std::uint64_t __attribute__((vector_size(16)));

constexpr Bits kSign{std::uint64_t(1) << 63, std::uint64_t(1) << 63};

// Two DoubleDoubles as they lie in a row: (hi, lo) of each. They are worked on as both hi and both lo.
struct Pack {
  Pair first{}, second{};

  Pack() = default;
  Pack(const detail::HiLo<Pair>& x)
      : first(__builtin_shufflevector(x.hi, x.lo, 0, 2)), second(__builtin_shufflevector(x.hi, x.lo, 1, 3)) {}
  detail::HiLo<Pair> parts() const {
    return {__builtin_shufflevector(first, second, 0, 2), __builtin_shufflevector(first, second, 1, 3)};
  }

  friend Pack operator+(const Pack& x, const Pack& y) { return detail::sum_of(x.parts(), y.parts()); }
  friend Pack operator-(const Pack& x, const Pack& y) {
    const detail::HiLo<Pair> b = y.parts();
    return detail::sum_of(x.parts(), {Pair(Bits(b.hi) ^ kSign), Pair(Bits(b.lo) ^ kSign)});
  }
  friend Pack operator*(const Pack& x, const Pack& y) { return detail::product_of(x.parts(), y.parts()); }
  friend Pack operator*(const Pack& x, const DoubleDouble& k) {
    return detail::product_of(x.parts(), {Pair{k.hi, k.hi}, Pair{k.lo, k.lo}});
  }
  Pack& operator+=(const Pack& y) { return *this = *this + y; }
};

template <class>
inline constexpr std::size_t kLinks = 1;

inline Pack turned(const Pack& x) {
  Pack turned;
  turned.first = x.second;
  turned.second = Pair(Bits(x.first) ^ kSign);
  return turned;
}
inline Pack pair_sums(const Pack& x) {
  Pack other;
  other.first = x.second;
  other.second = x.first;
  return x + other;
}
inline Pack spread(const Pack* row, std::size_t j) {
  return row[j];
}

}  // namespace
}  // namespace chainreel

#include "dynamics/kernels/taylor_planar_text.hpp"

namespace chainreel {

ExpandPlanar<DoubleDouble> expand_double_doubles(int n) {
  return expand_planar_for<Pack, DoubleDouble>(n);
}

}  // namespace chainreel
