// Test problems with closed forms, each a few lines.
#pragma once

#include <algorithm>
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

// A system with unit masses in every form that it has: momenta are rates.
class AllForms {
 public:
  explicit AllForms(SecondOrder& system) : momenta_(system) {
    forms_.second_order = &system;
    forms_.momenta = &momenta_;
  }
  const Forms& forms() const { return forms_; }
  static bool has(Form form) { return form == Form::second_order || form == Form::momenta; }

 private:
  struct UnitMasses final : Momenta {
    explicit UnitMasses(SecondOrder& given) : system(given) {}
    int n() const override { return system.nq(); }
    void momentum(std::span<const double>, std::span<const double> v, std::span<double> p) override {
      std::copy(v.begin(), v.end(), p.begin());
    }
    void velocity(std::span<const double>, std::span<const double> p, std::span<double> v) override {
      std::copy(p.begin(), p.end(), v.begin());
    }
    void force(double t, std::span<const double> q, std::span<const double> v,
               std::span<double> p_dot) override {
      system.acceleration(t, q, v, p_dot);
    }
    SecondOrder& system;
  };

  UnitMasses momenta_;
  Forms forms_;
};

}  // namespace chainreel
