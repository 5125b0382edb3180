// Lets Eigen's dense matrices and decompositions hold Dual<T> and Quad. A matrix of double joins in by
// .cast<T>(). For Quad there are sums, products, norms, inverses, LU and LDLT; not LLT and QR, which look for
// std::sqrt.
#pragma once

#include <quadmath.h>

#include <Eigen/Core>

#include "core/scalar.hpp"

namespace chainreel {

// The names under which Eigen looks for them.
template <class T>
Dual<T> sqrt(const Dual<T>& x) {
  return square_root(x);
}
template <class T>
Dual<T> abs(const Dual<T>& x) {
  return absolute(x);
}
template <class T>
Dual<T> abs2(const Dual<T>& x) {
  return x * x;
}

}  // namespace chainreel

namespace Eigen {

// g++ 12 leaves std::numeric_limits of this type at zero.
template <>
struct NumTraits<chainreel::Quad> : GenericNumTraits<chainreel::Quad> {
  static chainreel::Quad epsilon() { return FLT128_EPSILON; }
  static chainreel::Quad dummy_precision() { return 0x1p-100; }
  static chainreel::Quad highest() { return FLT128_MAX; }
  static chainreel::Quad lowest() { return -FLT128_MAX; }
  static int digits10() { return FLT128_DIG; }
};

template <class T>
struct NumTraits<chainreel::Dual<T>> : NumTraits<T> {
  using Real = chainreel::Dual<T>;
  using NonInteger = chainreel::Dual<T>;
  using Nested = chainreel::Dual<T>;
  using Literal = chainreel::Dual<T>;
  enum {
    IsComplex = 0,
    IsInteger = 0,
    IsSigned = 1,
    RequireInitialization = 1,
    ReadCost = 2 * int(NumTraits<T>::ReadCost),
    AddCost = 2 * int(NumTraits<T>::AddCost),
    MulCost = 3 * int(NumTraits<T>::MulCost) + int(NumTraits<T>::AddCost),
  };
  static Real epsilon() { return NumTraits<T>::epsilon(); }
  static Real dummy_precision() { return NumTraits<T>::dummy_precision(); }
  static Real highest() { return NumTraits<T>::highest(); }
  static Real lowest() { return NumTraits<T>::lowest(); }
};

namespace internal {

// std::sqrt has no overload for it.
template <>
struct sqrt_impl<chainreel::Quad> {
  static chainreel::Quad run(const chainreel::Quad& x) { return chainreel::square_root(x); }
};

}  // namespace internal
}  // namespace Eigen
