// What methods in coordinates and momenta share: their state, carried with the part that rounding cuts off
// each sum (E. Hairer, C. Lubich, G. Wanner, Geometric Numerical Integration, 2006, VIII.5: compensated
// summation), and dense output in (q, v).
#pragma once

#include <vector>

#include "integrate/hermite_span.hpp"
#include "integrate/integrator.hpp"

namespace chainreel {

class MomentaIntegrator : public Integrator {
 public:
  explicit MomentaIntegrator(const Forms& forms);

  void start(double t, std::span<const double> q, std::span<const double> v) final;
  void correct(std::span<const double> q, std::span<const double> v) final;
  StepResult step(double end, double h) final;
  void interpolate(double t, std::span<double> q, std::span<double> v) final;
  int dense_order() const final { return is_crude() ? 3 : span_.order(); }
  void path(double t, std::span<double> q, std::span<double> v) final { span_.interpolate(second_order_, t, q, v); }
  int path_order() const final { return span_.order(); }

 protected:
  virtual void forget() = 0;  // the steps before
  // Whether it moves q by a velocity that is none of its ends'.
  virtual bool is_crude() const { return false; }
  // Moves q_ and p_; v_ is the velocity at their beginning.
  virtual bool move(double t, double h) = 0;

  // x += dx; what the sum loses is kept in the carry.
  static void add(std::span<const double> dx, std::span<double> x, std::span<double> carry);
  // y = x + (carry + dx)
  static void stage(std::span<const double> x, std::span<const double> carry, std::span<const double> dx,
                    std::span<double> y);

  const std::size_t n_;
  Momenta& system_;
  std::vector<double> p_, q_carry_, p_carry_;
  // One over the size of coordinates and momenta, for what is small beside them.
  std::vector<double> q_weight_, p_weight_;

 private:
  void measure(double h);
  void find_masses();

  SecondOrder& second_order_;
  HermiteSpan span_;
  bool is_first_ = true;
  std::vector<double> p_largest_, force_, mass_;
};

// The next increment from those of the last two steps, where these were of equal length.
class Extrapolation {
 public:
  explicit Extrapolation(std::size_t n) : last_(n), before_(n) {}
  void forget() { known_ = 0; }
  // False where nothing is known.
  bool predict(double h, std::span<double> x) const;
  void learn(double h, std::span<const double> x);

 private:
  std::vector<double> last_, before_;
  int known_ = 0;
  double h_ = 0;
};

}  // namespace chainreel
