// Where a run really goes: its states in quadruple precision, by two methods that share no text, and what no
// method in double precision can know of them.
#pragma once

#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/double_double.hpp"
#include "dynamics/kernels/taylor_planar.hpp"
#include "sim/simulate.hpp"

namespace chainreel {

struct QuadReference {
  std::vector<double> t, q, qd;  // n numbers a time
  // At each time, of the coordinates: by how much the two methods differ. The doubles themselves are rounded.
  std::vector<double> uncertainty;
  std::string how;
};

// The states at `times` (rising, not negative) of the simulation's chain and torques, whatever its method.
// Nothing where they cannot be had in quadruple precision (see make_quad_system), where the motion ends
// before the last of the times, where that takes more steps than anybody waits for, as at a pole of a torque, and where `stop` says so.
std::optional<QuadReference> quad_reference(const Simulation& simulation, std::span<const double> times, const StopRequest& stop = {});

// How much an error of the start has grown at `end`: the largest over small errors of single coordinates and
// rates, of the coordinates; at least 1. Times 2^-53 it is what no run in double precision gets below.
// Nothing where there is no reference.
std::optional<double> quad_amplification(const Simulation& simulation, double end, const StopRequest& stop = {});

// Extrapolation of the midpoint rule in quadruple precision: W. Gragg, SIAM Journal on Numerical Analysis 2
// (1965) 384-403; R. Bulirsch, J. Stoer, Numerische Mathematik 8 (1966) 1-13; E. Hairer, S. Norsett, G.
// Wanner, Solving Ordinary Differential Equations I (1993), II.9.
//
// The rule with n_j = 2 j substeps has an error in even powers of the substep alone. Its results T_j1 for
// j = 1 .. columns are extrapolated to none,
//   T_j,k+1 = T_jk + (T_jk - T_j-1,k) / ((n_j / n_j-k)^2 - 1),
// which gives order 2 columns; the last two entries of the last row differ by the error of the worse one.

// A chain under a torque law in quadruple precision, through the general recursions: what references are
// computed with. It shares no text with the Taylor series.

class QuadSystem {
 public:
  virtual ~QuadSystem() = default;
  int n() const { return n_; }
  // v' at this state; allocates.
  virtual void acceleration(Quad t, std::span<const Quad> q, std::span<const Quad> v, std::span<Quad> vd) = 0;

 protected:
  explicit QuadSystem(int n) : n_(n) {}
  int n_;
};

// Nothing where the torques cannot be had with the digits of Quad (controls, the end effector in an
// expression, torques that are cut), and for floating joints and joints that follow others. `simulation` must
// outlive it.
std::unique_ptr<QuadSystem> make_quad_system(const Simulation& simulation);

class QuadExtrapolation {
 public:
  QuadExtrapolation(QuadSystem& system, int columns, double tolerance);

  void start(Quad t, std::vector<Quad> q, std::vector<Quad> v);
  // Ends run_to where it says so, or behind so many attempts at steps of all its calls.
  void set_limits(const StopRequest& stop, long most) { stop_ = stop, most_ = most; }
  // Moves to `end`; false where no step is small enough.
  bool run_to(Quad end);

  const std::vector<Quad>& q() const { return q_; }
  const std::vector<Quad>& v() const { return v_; }

 private:
  // y = (q, v) after a step, by the midpoint rule in `substeps` parts.
  void midpoint(Quad h, int substeps, std::vector<Quad>& y);
  void rate(Quad t, const std::vector<Quad>& y, std::vector<Quad>& f);
  // The step's error in units of the tolerance; the result is the last entry of the table.
  double attempt(Quad h);

  QuadSystem& system_;
  std::size_t n_;
  double tolerance_;
  Quad t_ = 0, h_ = 0;
  std::vector<Quad> q_, v_;
  std::vector<std::vector<Quad>> table_;  // the last row so far
  std::vector<Quad> y_, before_, f_;
  StopRequest stop_;
  long most_ = std::numeric_limits<long>::max(), attempts_ = 0;
};

// The Taylor method with more digits than doubles have, for references: a step goes as far as the last four terms allow. For
// Quad, and for DoubleDouble, which has half of its spare digits at a tenth of its price.
template <class T>
class LongSeries {
 public:
  LongSeries(const Chain& chain, const AffineTorque& torque, int order, double tolerance);

  void start(T t, std::vector<T> q, std::vector<T> v);
  // Ends run_to where it says so, or behind so many expansions of all its calls.
  void set_limits(const StopRequest& stop, long most) { stop_ = stop, most_ = most; }
  long expansions() const { return expansions_; }
  // Moves to `end`; false where no step is small enough, or the expansions are spent.
  bool run_to(T end);

  const std::vector<T>& q() const { return q_; }
  const std::vector<T>& v() const { return v_; }

 private:
  double longest_step() const;

  PlanarSeries<T> series_;
  std::size_t n_;
  int order_;
  double tolerance_;
  StopRequest stop_;
  long most_ = std::numeric_limits<long>::max(), expansions_ = 0;
  T t_ = 0;
  std::vector<T> q_, v_, c_;
};

}  // namespace chainreel
