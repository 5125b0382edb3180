// Test problems with closed forms, each a few lines.
#pragma once

#include <cmath>

#include "integrate/system.hpp"

namespace chainreel {

// q'' = -omega^2 q
struct Oscillator final : SecondOrder {
  double omega = 1;
  explicit Oscillator(double omega_) : omega(omega_) {}
  int nq() const override { return 1; }
  int nv() const override { return 1; }
  void acceleration(double, std::span<const double> q, std::span<const double>,
                    std::span<double> vd) override {
    vd[0] = -omega * omega * q[0];
  }
};

// q'' = -sin t: depends on time alone; q = sin t from q(0) = 0, q'(0) = 1.
struct Driven final : SecondOrder {
  int nq() const override { return 1; }
  int nv() const override { return 1; }
  void acceleration(double t, std::span<const double>, std::span<const double>,
                    std::span<double> vd) override {
    vd[0] = -std::sin(t);
  }
};

// q'' = 6 t: q = t^3 from rest at 0.
struct Cubic final : SecondOrder {
  int nq() const override { return 1; }
  int nv() const override { return 1; }
  void acceleration(double t, std::span<const double>, std::span<const double>,
                    std::span<double> vd) override {
    vd[0] = 6 * t;
  }
};

}  // namespace chainreel
