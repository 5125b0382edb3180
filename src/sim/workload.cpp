#include "sim/workload.hpp"

#include <algorithm>

#include "core/error.hpp"
#include "core/format.hpp"
#include "core/scalar.hpp"
#include "sim/cost_table.hpp"

namespace chainreel {
namespace {

std::string duration_text(double ns) {
  const double hours = ns / 3.6e12;
  return hours < 48 ? format_significant(hours, 2) + " hours"
                    : hours < 17520 ? format_significant(hours / 24, 2) + " days"
                                    : format_significant(hours / 8760, 2) + " years";
}

}  // namespace

double steps_of(const Simulation& simulation) {
  return simulation.step > 0 ? simulation.duration / simulation.step : 0;
}

double least_work(const Simulation& simulation) {
  const double steps = steps_of(simulation);
  return run_cost(simulation.chain, *simulation.method, simulation.options, steps,
                  steps * std::max(1, simulation.method->evaluations_per_step));
}

void require_possible(const Simulation& simulation, double runs) {
  const double steps = steps_of(simulation);
  if (steps > kMostSteps)
    throw Error(ExitCode::limit, "a run of " + format_shortest(simulation.duration) + " s in steps of " +
                                     format_shortest(simulation.step) + " s takes " + format_significant(steps, 3) +
                                     " steps, some " + duration_text(least_work(simulation)) +
                                     "; the most is " + format_shortest(kMostSteps) + " steps: take longer ones");
  require_possible(runs * least_work(simulation), runs);
}

void require_possible(double work, double runs) {
  if (work <= kMostWork) return;
  throw Error(ExitCode::limit, (runs > 1 ? format_significant(runs, 6) + " runs take" : std::string("this run takes")) +
                                   " some " + duration_text(work) +
                                   " by the count of their steps: take fewer, shorter ones or longer steps");
}

namespace {

// Five are exact where a spring pulls on a quintic: its power is of degree 9. Long steps show less.
constexpr int kFewestNodes = 5, kMostNodes = 16;
constexpr double kPi = 3.14159265358979323846;

// Gauss's rule with n points, exact for polynomials of degree 2 n - 1: the roots of the Legendre polynomial
// P_n by Newton's iteration (M. Abramowitz, I. Stegun, Handbook of Mathematical Functions, 25.4.30).
void gauss_rule(int n, std::vector<double>& nodes, std::vector<double>& weights) {
  for (int i = 0; i < n; ++i) {
    double x = cosine(kPi * (i + 0.75) / (n + 0.5)), slope = 1;
    for (int pass = 0; pass < 8; ++pass) {
      double P = 1, P_before = 0;
      for (int k = 1; k <= n; ++k) {
        const double P_next = ((2 * k - 1) * x * P - (k - 1) * P_before) / k;
        P_before = P;
        P = P_next;
      }
      slope = n * (x * P - P_before) / (x * x - 1);
      x -= P / slope;
    }
    nodes.push_back(0.5 * (1 - x));
    weights.push_back(1 / ((1 - x * x) * slope * slope));
  }
}

}  // namespace

WorkIntegral::WorkIntegral(const Simulation& simulation, ChainSystem& system, int path_order)
    : q0_(simulation.q0), tau_(std::size_t(simulation.chain.nv)), q_(simulation.q0), qd_(simulation.qd0) {
  gauss_rule(std::clamp((path_order + 2) / 2, kFewestNodes, kMostNodes), nodes_, weights_);
  const Chain& chain = simulation.chain;
  if (!simulation.torque->is_constant() || chain.has_dissipation) return;
  if (!simulation.constraints.contact_forces.empty()) return;
  const ConstVec tau = system.torque(0, simulation.q0, simulation.qd0);
  std::copy(tau.begin(), tau.end(), tau_.begin());
  // With a floating base qd is no derivative of q: the short form holds there only where nothing pushes.
  constant_ = chain.nq == chain.nv || std::all_of(tau_.begin(), tau_.end(), [](double x) { return x == 0; });
}

double WorkIntegral::work_of_constant(ConstVec q) const {
  double sum = 0;
  for (std::size_t i = 0; i < tau_.size(); ++i) sum += tau_[i] == 0 ? 0 : tau_[i] * (q[i] - q0_[i]);
  return sum;
}

double WorkIntegral::integral(ChainSystem& system, Integrator& integrator, double end) {
  const double begin = integrator.begin_time();
  double sum = 0;
  for (std::size_t k = 0; k < nodes_.size(); ++k) {
    const double t = begin + nodes_[k] * (end - begin);
    integrator.path(t, q_, qd_);
    sum += weights_[k] * system.power(t, q_, qd_);
  }
  return sum * (end - begin);
}

void WorkIntegral::add_step(ChainSystem& system, Integrator& integrator, ConstVec q) {
  before_ = total_;
  total_ = constant_ ? work_of_constant(q)
                     : before_ + integral(system, integrator, integrator.time());
}

double WorkIntegral::at(ChainSystem& system, Integrator& integrator, double t, ConstVec q) {
  return constant_ ? work_of_constant(q) : before_ + integral(system, integrator, t);
}

}  // namespace chainreel
