#include "draw/chart_samples.hpp"

#include <cmath>

namespace chainreel::test {
namespace {

struct Method {
  const char* name;
  int order;
  double constant;    // error at the crudest rung
  double first_cost;  // evaluations there
  double per_call;    // s per evaluation
  double ratio;       // of evaluations from rung to rung
  int rungs, failed;  // the first `failed` rungs did not hold
};

constexpr double kFloor = 3e-14;

ChartCurve curve_of(const Method& m) {
  ChartCurve curve{m.name, m.order, {}, -1};
  double cost = m.first_cost, error = m.constant;
  for (int i = 0; i < m.rungs; ++i) {
    const double scatter = 1 + 0.06 * std::sin(12.9 * i + m.order);
    // Round-off grows with the square root of the number of steps.
    const double seen = error + kFloor * (2 + 0.004 * std::sqrt(cost));
    curve.points.push_back({seen, m.per_call * cost * scatter, cost, i < m.failed, ""});
    cost *= m.ratio;
    error *= std::pow(m.ratio, -m.order);
  }
  return curve;
}

}  // namespace

WorkPrecision sample_work_precision() {
  WorkPrecision data;
  data.title = "What accuracy costs: RR from rest, 10 s";
  data.subtitle = "error of the final joint angles; time of one run on one core, median of 15";
  data.error_title = "final error [rad]";
  data.floor = kFloor;
  data.reference_uncertainty = 2e-24;
  const Method methods[] = {{"explicit_euler", 1, 2.0, 1e3, 2.6e-8, 3.2, 7, 3},
                            {"semi_implicit_euler", 1, 0.3, 1e3, 2.6e-8, 3.2, 8, 0},
                            {"symplectic_euler", 1, 0.1, 1e3, 6e-8, 3.2, 8, 0},
                            {"verlet", 2, 0.08, 1e3, 4.1e-8, 2.6, 9, 0},
                            {"rk4", 4, 0.05, 2e3, 2.6e-8, 1.9, 11, 1},
                            {"dop853", 8, 0.02, 3e3, 3.1e-8, 1.35, 12, 0},
                            {"taylor", 24, 0.01, 1.9e3, 4.5e-8, 1.08, 16, 0},
                            {"rattle4", 4, 0.02, 3e3, 6e-8, 1.9, 10, 0},
                            {"rattle8", 8, 0.04, 6e3, 6e-8, 1.4, 11, 0},
                            {"gauss4", 4, 0.006, 6e3, 8e-8, 1.9, 9, 0},
                            {"gauss6", 6, 0.01, 8e3, 9e-8, 1.5, 11, 0},
                            {"radau5", 5, 0.1, 9e3, 1.2e-7, 1.6, 11, 0}};
  for (const Method& method : methods) data.curves.push_back(curve_of(method));
  data.choice = ChartChoice{"taylor", 5};
  data.machine = "Intel Xeon 3.1 GHz, g++ 12.2 -O2, revision 1a2b3c4";
  return data;
}

EnergyChart sample_energy() {
  EnergyChart data;
  data.title = "Where the energy goes";
  data.subtitle = "RR from rest, h = 1 ms, scale of the energy 29 J";
  struct Law {
    const char* method;
    double at_one, power, wiggle;
    const char* trouble;
  };
  const Law laws[] = {{"explicit_euler", 0.5, 1.6, 0.1, "diverged"},
                      {"semi_implicit_euler", 0.02, 0.5, 0.6, ""},
                      {"verlet", 3e-5, 0.02, 0.9, ""},
                      {"rk4", 2e-9, 1.0, 0.3, ""},
                      {"rattle8", 1e-13, 0.05, 0.9, ""},
                      {"gauss6", 2e-13, 0.1, 0.9, ""},
                      {"taylor", 1.5e-14, 0.5, 0.5, ""}};
  for (const Law& law : laws) {
    EnergyCurve curve{law.method, {}, {}, law.trouble, -1};
    const double end = *law.trouble == 0 ? 1000 : 60;
    for (double t = 0; t <= end; t += 0.05) {
      const double swing = 1 - law.wiggle * std::abs(std::cos(3 * t));
      curve.t.push_back(t);
      curve.error.push_back(law.at_one * std::pow(t, law.power) * swing);
    }
    data.curves.push_back(std::move(curve));
  }
  data.footer = "Intel Xeon 3.1 GHz, g++ 12.2 -O2, revision 1a2b3c4";
  return data;
}

StabilityMap sample_map(int nx, int ny) {
  StabilityMap data;
  data.title = "Semi-implicit Euler fails beyond the theory's line";
  data.subtitle = "damped oscillator, 1000 steps from rest";
  data.x = {Scale::log, 0.05, 20, "step times natural frequency [rad]"};
  data.y = {Scale::linear, 0, 1.5, "damping ratio"};
  data.nx = nx;
  data.ny = ny;
  data.error_title = "error [m]";
  const auto limit = [](double z) { return 2 * (std::sqrt(1 + z * z) - z); };
  for (int j = 0; j < ny; ++j)
    for (int i = 0; i < nx; ++i) {
      const double x = 0.05 * std::pow(400.0, (i + 0.5) / nx), z = 1.5 * (j + 0.5) / ny;
      data.cells.push_back({x > limit(z), 3e-3 * x * x * std::exp(-3 * z) * (1.1 + std::sin(9 * x) * 0.5)});
    }
  MapBoundary boundary{{}, "omega h = 2 ((1 + zeta^2)^{1/2} - zeta)"};
  for (int j = 0; j <= 60; ++j) boundary.points.push_back({limit(1.5 * j / 60), 1.5 * j / 60});
  data.boundaries.push_back(boundary);
  return data;
}

}  // namespace chainreel::test
