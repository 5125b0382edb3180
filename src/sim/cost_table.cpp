// Measured once by work-precision runs on a 2.8 GHz Cascade Lake (`chainreel chart`, CSV: seconds, steps and
// evaluations) and rounded: what matters is the order of the candidates. Times of other processors differ by
// a common factor.
#include "sim/cost_table.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <string_view>

#include "dynamics/forward_dynamics.hpp"

namespace chainreel {
namespace {

struct Row {
  std::string_view method;
  double per_step;              // ns
  double per_step_and_freedom;  // ns
  double evaluations_worth;     // forward dynamics that one evaluation costs
  double per_evaluation;        // ns, beside
};

constexpr std::array kRows = {
    Row{"explicit_euler", 10, 2, 1, 8},
    Row{"semi_implicit_euler", 10, 2, 1, 15},
    Row{"rk4", 20, 4, 1, 20},
    Row{"dop853", 60, 30, 1, 25},
    Row{"symplectic_euler", 30, 10, 2, 30},
    Row{"verlet", 40, 10, 2, 30},
    Row{"implicit_midpoint", 60, 20, 2, 30},
    Row{"gauss4", 80, 40, 2, 30},
    Row{"gauss6", 100, 60, 2, 30},
    Row{"radau5", 300, 150, 1, 25},
    Row{"rattle2", 20, 20, 0, 10},
    Row{"rattle4", 20, 20, 0, 10},
    Row{"rattle6", 20, 20, 0, 10},
    Row{"rattle8", 20, 20, 0, 10},
};

// The Taylor method's step: four convolutions a joint and order, and a product with the inverse of M.
double series_cost(int freedoms, int order) {
  return 100 + freedoms * order * (1.2 * order + 2.0 * freedoms + 8);
}

}  // namespace

double forward_dynamics_cost(const Chain& chain) {
  constexpr std::array<double, 5> kPlanarKernel = {0, 14, 21, 35, 50};
  const double n = chain.nv;
  const std::string algorithm = forward_dynamics_algorithm(chain);
  if (algorithm.starts_with("planar, unrolled")) return kPlanarKernel[std::size_t(std::min(chain.nv, 4))];
  if (algorithm.starts_with("spatial, CRBA")) return 50 * n + 20;
  if (algorithm.ends_with("CRBA and LDL^T")) return 130 * n + 4 * n * n;
  return (chain.planar ? 70 : 160) * n;
}

double run_cost(const Chain& chain, const Method& method, const MethodOptions& options, double steps,
                double evaluations) {
  if (method.form == Form::series)
    return steps * series_cost(chain.nv, options.order > 0 ? options.order : method.order);
  const auto row =
      std::find_if(kRows.begin(), kRows.end(), [&](const Row& one) { return one.method == method.name; });
  assert(row != kRows.end());
  return steps * (row->per_step + row->per_step_and_freedom * chain.nv) +
         evaluations * (row->evaluations_worth * forward_dynamics_cost(chain) + row->per_evaluation);
}

}  // namespace chainreel
