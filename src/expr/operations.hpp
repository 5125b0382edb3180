// What each operation of a program does with the values of a scalar.
#pragma once

#include <quadmath.h>

#include <cassert>
#include <type_traits>

#include "core/scalar.hpp"
#include "expr/program.hpp"

namespace chainreel {

template <class T>
T pi() {
  if constexpr (std::is_constructible_v<T, Quad>)
    return T(M_PIq);
  else
    return T(double(M_PIq));
}

template <class T>
T result_of(Operation operation, const T& x) {
  switch (operation) {
    case Operation::sine:
      return sine(x);
    case Operation::cosine:
      return cosine(x);
    case Operation::tangent:
      return tangent(x);
    case Operation::square_root:
      return square_root(x);
    case Operation::exponential:
      return exponential(x);
    case Operation::logarithm:
      return logarithm(x);
    case Operation::absolute:
      return absolute(x);
    default:
      assert(operation == Operation::negate);
      return -x;
  }
}

template <class T>
T truth(bool value) {
  return T(value ? 1.0 : 0.0);
}

template <class T>
T result_of(Operation operation, const T& a, const T& b) {
  switch (operation) {
    case Operation::add:
      return a + b;
    case Operation::subtract:
      return a - b;
    case Operation::multiply:
      return a * b;
    case Operation::divide:
      return a / b;
    case Operation::power:
      return power(a, b);
    case Operation::less:
      return truth<T>(a < b);
    case Operation::less_equal:
      return truth<T>(a <= b);
    case Operation::greater:
      return truth<T>(a > b);
    case Operation::greater_equal:
      return truth<T>(a >= b);
    case Operation::equal:
      return truth<T>(a == b);
    case Operation::not_equal:
      return truth<T>(a != b);
    case Operation::minimum:
      return minimum(a, b);
    case Operation::maximum:
      return maximum(a, b);
    default:
      assert(operation == Operation::arc_tangent2);
      return arc_tangent2(a, b);
  }
}

}  // namespace chainreel
