// With z = |r|^2 and s = sin |r| / |r| = 1 - B z, D turns a vector square to r as s - i A |r| would, so that
//
//   D^-1 = 1 + 1/2 [r]x + G [r]x^2,   G = (1 - s / (2 A)) / z = (B - 2 C) / (2 A),   C = (1/2 - A) / z.
//
// Derivatives: with r' = u and z' = 2 r.u,
//   D' y = -A_z z' r x y - A u x y + B_z z' r x (r x y) + B (u x (r x y) + r x (u x y)),
// and D'^T y the same with the signs of A and A_z turned.
#include "dynamics/local_coordinates.hpp"

#include <algorithm>
#include <array>

#include "core/scalar.hpp"
#include "dynamics/floating.hpp"

namespace chainreel {
namespace {

using Vector = Vec3<double>;

// sum_k (-1)^k z^k / (2 k + from)! for z <= 1: the last of ten terms is below 2^-60 of the first.
template <int from>
struct FactorialSeries {
  static constexpr std::size_t kTerms = 10;
  static constexpr std::array<double, kTerms> kTerm = [] {
    std::array<double, kTerms> terms{};
    double factorial = 1;
    for (int i = 2; i <= from; ++i) factorial *= i;
    for (std::size_t k = 0; k < kTerms; ++k) {
      terms[k] = (k % 2 == 0 ? 1 : -1) / factorial;
      factorial *= (2 * int(k) + from + 1) * (2 * int(k) + from + 2);
    }
    return terms;
  }();
  static double value(double z) {
    double sum = 0;
    for (std::size_t k = kTerms; k-- > 0;) sum = kTerm[k] + z * sum;
    return sum;
  }
  static double slope(double z) {
    double sum = 0;
    for (std::size_t k = kTerms; k-- > 1;) sum = double(k) * kTerm[k] + z * sum;
    return sum;
  }
};

// The turn exp(r), its D and what its derivatives need.
struct Turn {
  Vector r;
  double A, B, G, A_z, B_z;
  Quaternion exp;

  explicit Turn(const Vector& of) : r(of) {
    const double z = dot(r, r), angle = square_root(z);
    const auto [half_sine, half_cosine] = sin_cos(angle / 2);
    exp = {r * (angle > 0 ? half_sine / angle : 0.5), half_cosine};
    double C;
    if (z <= 1) {
      A = FactorialSeries<2>::value(z), A_z = FactorialSeries<2>::slope(z);
      B = FactorialSeries<3>::value(z), B_z = FactorialSeries<3>::slope(z);
      C = FactorialSeries<4>::value(z);
    } else {
      const auto [sine, cosine] = sin_cos(angle);
      A = (1 - cosine) / z, B = (angle - sine) / (angle * z);
      A_z = (sine / angle - 2 * A) / (2 * z), B_z = (A - 3 * B) / (2 * z);
      C = (0.5 - A) / z;
    }
    G = (B - 2 * C) / (2 * A);
  }

  Vector D(const Vector& y) const { return y + twisted(-A, y) + twice(B, y); }
  Vector D_transposed(const Vector& y) const { return y + twisted(A, y) + twice(B, y); }
  Vector D_inverse(const Vector& y) const { return y + twisted(0.5, y) + twice(G, y); }
  Vector D_inverse_transposed(const Vector& y) const { return y + twisted(-0.5, y) + twice(G, y); }
  // D' y and D'^T y while r' = u.
  Vector D_rate(const Vector& u, const Vector& y) const { return rate(-1, u, y); }
  Vector D_rate_transposed(const Vector& u, const Vector& y) const { return rate(1, u, y); }

 private:
  Vector twisted(double factor, const Vector& y) const { return cross(r, y) * factor; }
  Vector twice(double factor, const Vector& y) const { return cross(r, cross(r, y)) * factor; }
  Vector rate(double sign, const Vector& u, const Vector& y) const {
    const double z_dot = 2 * dot(r, u);
    const Vector ry = cross(r, y), uy = cross(u, y);
    return ry * (sign * A_z * z_dot) + uy * (sign * A) + cross(r, ry) * (B_z * z_dot) +
           (cross(u, ry) + cross(r, uy)) * B;
  }
};

Vector vector_at(ConstVec x, std::size_t i) {
  return {x[i], x[i + 1], x[i + 2]};
}

void write(const Vector& v, Vec x, std::size_t i) {
  x[i] = v.x, x[i + 1] = v.y, x[i + 2] = v.z;
}

Vector turned_back(const Quaternion& a, const Vector& v) {
  return turned({a.u * -1.0, a.w}, v);
}

// Copies what belongs to single coordinates; calls f(first freedom, the turn from the base, the whole turn R) for
// each floating joint.
template <class F>
void for_each_floating(const Chain& chain, const std::vector<double>& base, ConstVec x, ConstVec from, Vec to, F&& f) {
  for_each_coordinate(
      chain, [&](std::size_t, std::size_t v) { to[v] = from[v]; },
      [&](std::size_t i, std::size_t v) {
        const Turn turn(vector_at(x, v + 3));
        f(v, turn, Floating::turn(&base[i]) * turn.exp);
      });
}

}  // namespace

void LocalCoordinates::move_to(ConstVec q, Vec x) {
  std::copy(q.begin(), q.end(), base_.begin());
  for_each_coordinate(
      *chain_, [&](std::size_t i, std::size_t v) { x[v] = q[i]; },
      [&](std::size_t i, std::size_t v) {
        const Vector p = Floating::position(&q[i]);
        Floating::write(p, unit_of(Floating::turn(&q[i])), &base_[i]);
        write(p, x, v);
        write({0, 0, 0}, x, v + 3);
      });
}

void LocalCoordinates::place(ConstVec x, Vec q) const {
  for_each_coordinate(
      *chain_, [&](std::size_t i, std::size_t v) { q[i] = x[v]; },
      [&](std::size_t i, std::size_t v) {
        const Turn turn(vector_at(x, v + 3));
        Floating::write(vector_at(x, v), unit_of(Floating::turn(&base_[i]) * turn.exp), &q[i]);
      });
}

void LocalCoordinates::to_velocity(ConstVec x, ConstVec x_dot, Vec v) const {
  for_each_floating(*chain_, base_, x, x_dot, v, [&](std::size_t i, const Turn& turn, const Quaternion& R) {
    write(turned_back(R, vector_at(x_dot, i)), v, i);
    write(turn.D(vector_at(x_dot, i + 3)), v, i + 3);
  });
}

void LocalCoordinates::to_rate(ConstVec x, ConstVec v, Vec x_dot) const {
  for_each_floating(*chain_, base_, x, v, x_dot, [&](std::size_t i, const Turn& turn, const Quaternion& R) {
    write(turned(R, vector_at(v, i)), x_dot, i);
    write(turn.D_inverse(vector_at(v, i + 3)), x_dot, i + 3);
  });
}

// (R^T p')' = R^T p'' - w x R^T p'
void LocalCoordinates::to_second_rate(ConstVec x, ConstVec x_dot, ConstVec v_dot, Vec x_ddot) const {
  for_each_floating(*chain_, base_, x, v_dot, x_ddot, [&](std::size_t i, const Turn& turn, const Quaternion& R) {
    const Vector u = vector_at(x_dot, i + 3);
    const Vector v = turned_back(R, vector_at(x_dot, i)), w = turn.D(u);
    write(turned(R, vector_at(v_dot, i) + cross(w, v)), x_ddot, i);
    write(turn.D_inverse(vector_at(v_dot, i + 3) - turn.D_rate(u, u)), x_ddot, i + 3);
  });
}

void LocalCoordinates::to_momentum(ConstVec x, ConstVec p, Vec p_x) const {
  for_each_floating(*chain_, base_, x, p, p_x, [&](std::size_t i, const Turn& turn, const Quaternion& R) {
    write(turned(R, vector_at(p, i)), p_x, i);
    write(turn.D_transposed(vector_at(p, i + 3)), p_x, i + 3);
  });
}

void LocalCoordinates::from_momentum(ConstVec x, ConstVec p_x, Vec p) const {
  for_each_floating(*chain_, base_, x, p_x, p, [&](std::size_t i, const Turn& turn, const Quaternion& R) {
    write(turned_back(R, vector_at(p_x, i)), p, i);
    write(turn.D_inverse_transposed(vector_at(p_x, i + 3)), p, i + 3);
  });
}

// (R p)' = R (p' + w x p),  (D^T p)' = D^T p' + D'^T p
void LocalCoordinates::to_force(ConstVec x, ConstVec x_dot, ConstVec p, ConstVec p_dot, Vec p_x_dot) const {
  for_each_floating(*chain_, base_, x, p_dot, p_x_dot, [&](std::size_t i, const Turn& turn, const Quaternion& R) {
    const Vector u = vector_at(x_dot, i + 3), angular = vector_at(p, i + 3);
    write(turned(R, vector_at(p_dot, i) + cross(turn.D(u), vector_at(p, i))), p_x_dot, i);
    write(turn.D_transposed(vector_at(p_dot, i + 3)) + turn.D_rate_transposed(u, angular), p_x_dot, i + 3);
  });
}

}  // namespace chainreel
