// Coordinates and their rates. They differ for floating joints alone, whose pose is a point of SE(3):
//
//   p' = R v,  quat' = 1/2 quat (w, 0)
//   q (+) h v = q exp(h v),  exp(v, w) = (V v, exp w),
//   V = 1 + (1 - cos |w|)/|w|^2 [w]x + (|w| - sin |w|)/|w|^3 [w]x^2
//
// (K. Lynch, F. Park, Modern Robotics, 2017, eq. 3.88).
#include <cmath>

#include "core/scalar.hpp"
#include "dynamics/floating.hpp"
#include "dynamics/kinematics.hpp"

namespace chainreel {

namespace {

using Vector = Vec3<double>;

// (x - sin x) / x^3
double cubic_rest_of_sine(double x) {
  const double z = x * x;
  if (x > 0.5) return (x - sine(x)) / (z * x);
  // The difference cancels: its Taylor series, to z^6 / 15! < 2^-53 of the first term.
  return 1.0 / 6 -
         z * (1.0 / 120 - z * (1.0 / 5040 - z * (1.0 / 362880 - z * (1.0 / 39916800 - z / 6227020800.0))));
}

void advance_floating(double* q, const double* qd, double h) {
  const Vector v = Floating::linear(qd) * h;
  const Vector w = Floating::angular(qd) * h;
  const Quaternion start = unit_of(Floating::turn(q));

  const double angle = square_root(dot(w, w));
  const auto [s, c] = sin_cos(angle / 2);
  const double sinc = angle > 0 ? s / angle : 0.5;  // of the half angle, halved
  const Vector wv = cross(w, v);
  const Vector step = v + wv * (2 * sinc * sinc) + cross(w, wv) * cubic_rest_of_sine(angle);

  Floating::write(Floating::position(q) + turned(start, step), unit_of(start * Quaternion{w * sinc, c}), q);
}

void rate_floating(const double* q, const double* qd, double* q_dot) {
  const Quaternion turn = Floating::turn(q);
  const Quaternion rate = turn * Quaternion{Floating::angular(qd) * 0.5, 0};
  Floating::write(turned(unit_of(turn), Floating::linear(qd)), rate, q_dot);
}

}  // namespace

void q_rate(const Chain& chain, ConstVec q, ConstVec qd, Vec q_dot) {
  for_each_coordinate(
      chain, [&](std::size_t i, std::size_t v) { q_dot[i] = qd[v]; },
      [&](std::size_t i, std::size_t v) { rate_floating(&q[i], &qd[v], &q_dot[i]); });
}

void advance(const Chain& chain, Vec q, ConstVec qd, double h) {
  for_each_coordinate(
      chain, [&](std::size_t i, std::size_t v) { q[i] += h * qd[v]; },
      [&](std::size_t i, std::size_t v) { advance_floating(&q[i], &qd[v], h); });
}

void normalize(const Chain& chain, Vec q) {
  for_each_coordinate(
      chain, [](std::size_t, std::size_t) {},
      [&](std::size_t i, std::size_t) {
        double* p = &q[i];
        Floating::write(Floating::position(p), unit_of(Floating::turn(p)), p);
      });
}

}  // namespace chainreel
