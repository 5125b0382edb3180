// The registry of methods: one row each, walked by the command line, the chart, the tests and the documents.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "integrate/integrator.hpp"
#include "integrate/system.hpp"

namespace chainreel {

// The bare step of a method of fixed step in (q, v); allocates nothing after it is made.
class Stepper {
 public:
  virtual ~Stepper() = default;
  // Moves (q, v) from t to t + h.
  virtual void step(SecondOrder& system, double t, double h, std::span<double> q, std::span<double> v) = 0;
  // Moves (q, v), where the last step began, by a shorter one of the same rates: what the method itself says of the motion
  // within its step. False where it says nothing, and the motion is interpolated.
  virtual bool step_shorter(SecondOrder&, double /*h*/, std::span<double> /*q*/, std::span<double> /*v*/) { return false; }
};

// Below it an adaptive method would chase the rounding of doubles.
inline constexpr double kLeastTolerance = 1e-15;

struct MethodOptions {
  double tolerance = 0;  // of an adaptive method; 0: every step goes where it is told
  int order = 0;         // of a method that offers several; 0: its row's
};

// What a run by a method costs, ns, of n freedoms: a sum over steps and evaluations, an evaluation being worth so many
// accelerations of the system besides. Measured once (`chainreel chart`, CSV: seconds, steps and evaluations; 2.8 GHz
// Cascade Lake) and rounded: what matters is the order of methods, and a program that counts chooses alike everywhere.
class Price {
 public:
  constexpr Price(double step, double step_and_freedom, double accelerations, double evaluation,
                  double evaluation_and_freedom)
      : step_(step), step_and_freedom_(step_and_freedom), accelerations_(accelerations), evaluation_(evaluation),
        evaluation_and_freedom_(evaluation_and_freedom) {}
  // For methods whose step depends on its order, and whose evaluations are part of it.
  constexpr explicit Price(double (*step)(int n, int order)) : step_of_order_(step) {}

  double of(double steps, double evaluations, int n, int order, double acceleration) const {
    if (step_of_order_) return steps * step_of_order_(n, order);
    return steps * (step_ + step_and_freedom_ * n) +
           evaluations * (accelerations_ * acceleration + evaluation_ + evaluation_and_freedom_ * n);
  }

 private:
  double (*step_of_order_)(int, int) = nullptr;
  double step_ = 0, step_and_freedom_ = 0, accelerations_ = 0, evaluation_ = 0, evaluation_and_freedom_ = 0;
};

struct Method {
  std::string name;
  std::string title;  // in words, for pictures: "semi-implicit Euler"
  int order = 1;
  std::string kind;  // a word or two for `chainreel methods`
  Form form = Form::second_order;
  bool symplectic = false;                  // not in a Chart; see the source's note where M depends on q
  bool reversible = false;                  // a step back undoes a step; not in a Chart
  bool adaptive = false;                    // takes a tolerance
  bool plain_coordinates = false;           // of the second-order form: needs q' = v; floating joints: in a Chart
  int lowest_order = 0, highest_order = 0;  // that MethodOptions::order may ask for; 0, 0: none
  int dense_order = 5;                      // of the dense output where q' = v
  int evaluations_per_step = 1;             // 0: not always the same
  Price price;                              // no default: a row without it does not compile
  std::string source;

  // Fixed-step methods in (q, v) have the first, all others the second.
  std::unique_ptr<Stepper> (*make_stepper)(int nq, int nv) = nullptr;
  std::unique_ptr<Integrator> (*make)(const Forms& forms, const MethodOptions& options) = nullptr;
};

const std::vector<Method>& methods();

// What pictures call a method; `name` itself where there is none of that name.
std::string method_title(const std::string& name);

// Throws Error (bad input) naming the nearest known method.
const Method& find_method(const std::string& name);

// The forms must hold the one that the method's row names, and outlive the integrator.
std::unique_ptr<Integrator> make_integrator(const Method& method, const Forms& forms,
                                            const MethodOptions& options = {});

}  // namespace chainreel
