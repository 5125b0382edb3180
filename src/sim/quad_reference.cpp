#include "sim/quad_reference.hpp"

#include <algorithm>
#include <cmath>

#include "sim/chain_series.hpp"
#include "sim/quad_extrapolation.hpp"
#include "sim/quad_series.hpp"

namespace chainreel {
namespace {

// Errors of a step; a motion that amplifies them 1e8 times still has all digits of a double.
constexpr double kTolerance = 1e-25;
constexpr int kOrder = 40;
constexpr int kColumns = 12, kOtherColumns = 10;
// Large against these errors, small against all that bends the motion.
constexpr double kPerturbation = 1e-10;
constexpr double kPerturbedTolerance = 1e-16;
constexpr int kPerturbedOrder = 22;

struct States {
  std::vector<Quad> q, v;  // n numbers a time
};

template <class Method>
std::optional<States> states_at(Method& method, const std::vector<Quad>& q0, const std::vector<Quad>& v0,
                                std::span<const double> times) {
  method.start(0, q0, v0);
  States states;
  for (const double t : times) {
    if (!method.run_to(t)) return {};
    states.q.insert(states.q.end(), method.q().begin(), method.q().end());
    states.v.insert(states.v.end(), method.v().begin(), method.v().end());
  }
  return states;
}

double apart(std::span<const Quad> a, std::span<const Quad> b) {
  double largest = 0;
  for (std::size_t i = 0; i < a.size(); ++i) largest = std::max(largest, std::abs(double(a[i] - b[i])));
  return largest;
}

bool has_series(const Simulation& simulation) {
  return !why_no_series(simulation.chain, *simulation.torque, simulation.limit);
}

std::vector<Quad> in_quad(const std::vector<double>& x) {
  return {x.begin(), x.end()};
}

}  // namespace

std::optional<QuadReference> quad_reference(const Simulation& simulation, std::span<const double> times) {
  const std::unique_ptr<QuadSystem> system = make_quad_system(simulation);
  if (!system) return {};
  const std::vector<Quad> q0 = in_quad(simulation.q0), v0 = in_quad(simulation.qd0);
  QuadExtrapolation extrapolation(*system, kColumns, kTolerance);
  QuadReference reference;
  std::optional<States> first, second;
  if (has_series(simulation)) {
    QuadSeries series(simulation.chain, *simulation.torque->affine(), kOrder, kTolerance);
    first = states_at(series, q0, v0, times);
    second = states_at(extrapolation, q0, v0, times);
    reference.how = "Taylor series beside extrapolation of the midpoint rule, in quadruple precision";
  } else {
    QuadExtrapolation other(*system, kOtherColumns, kTolerance * 1e-2);
    first = states_at(extrapolation, q0, v0, times);
    second = states_at(other, q0, v0, times);
    reference.how = "extrapolation of the midpoint rule at two orders, in quadruple precision";
  }
  if (!first || !second) return {};
  const auto n = std::size_t(system->n());
  for (std::size_t k = 0; k < times.size(); ++k) {
    reference.t.push_back(times[k]);
    const auto row = [&](const std::vector<Quad>& x) { return std::span(x).subspan(k * n, n); };
    for (const Quad& q : row(first->q)) reference.q.push_back(double(q));
    for (const Quad& v : row(first->v)) reference.qd.push_back(double(v));
    reference.uncertainty.push_back(apart(row(first->q), row(second->q)));
  }
  return reference;
}

std::optional<double> quad_amplification(const Simulation& simulation, double end) {
  const std::unique_ptr<QuadSystem> system = make_quad_system(simulation);
  if (!system) return {};
  const bool by_series = has_series(simulation);
  const AffineTorque torque = by_series ? *simulation.torque->affine() : AffineTorque{};
  const auto end_of = [&](const std::vector<Quad>& q0, const std::vector<Quad>& v0) {
    const double times[] = {end};
    if (by_series) {
      QuadSeries series(simulation.chain, torque, kPerturbedOrder, kPerturbedTolerance);
      return states_at(series, q0, v0, times);
    }
    QuadExtrapolation extrapolation(*system, kOtherColumns, kPerturbedTolerance);
    return states_at(extrapolation, q0, v0, times);
  };
  std::vector<Quad> q0 = in_quad(simulation.q0), v0 = in_quad(simulation.qd0);
  const std::optional<States> unperturbed = end_of(q0, v0);
  if (!unperturbed) return {};
  double largest = 1;
  for (std::vector<Quad>* start : {&q0, &v0}) {
    for (Quad& x : *start) {
      const Quad exact = x;
      x += kPerturbation;
      const std::optional<States> perturbed = end_of(q0, v0);
      x = exact;
      if (!perturbed) return {};
      largest = std::max(largest, apart(perturbed->q, unperturbed->q) / kPerturbation);
    }
  }
  return largest;
}

}  // namespace chainreel
