// Measured once by work-precision runs on a 2.8 GHz Cascade Lake (`chainreel chart`, CSV: seconds, steps and
// evaluations) and rounded: what matters is the order of the candidates. Times of other processors differ by
// a common factor.
#include "sim/choice/cost_table.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <string_view>

#include "dynamics/forward_dynamics.hpp"
#include "dynamics/kernels/constrained_kernel.hpp"

namespace chainreel {
namespace {

// ns = steps (per_step + per_step_and_freedom n)
//      + evaluations (evaluations_worth F + per_evaluation + per_evaluation_and_freedom n), F a forward
//      dynamics.
struct Row {
  std::string_view method;
  double per_step, per_step_and_freedom;
  double evaluations_worth, per_evaluation, per_evaluation_and_freedom;
};

constexpr std::array kRows = {
    Row{"explicit_euler", 10, 2, 1, 30, 0},
    Row{"semi_implicit_euler", 10, 2, 1, 30, 0},
    Row{"rk4", 20, 6, 1, 15, 0},
    Row{"dop853", 60, 40, 1, 20, 0},
    Row{"radau5", 400, 170, 1, 30, 0},
    Row{"symplectic_euler", 20, 10, 5, 10, 0},
    Row{"verlet", 20, 10, 8, 0, 0},
    Row{"implicit_midpoint", 40, 20, 5, 40, 0},
    Row{"gauss4", 60, 30, 5, 35, 0},
    Row{"gauss6", 60, 30, 5, 35, 0},
    Row{"rattle2", 20, 20, 0, 0, 55},
    Row{"rattle4", 20, 20, 0, 0, 55},
    Row{"rattle6", 20, 20, 0, 0, 55},
    Row{"rattle8", 20, 20, 0, 0, 55},
};

// The Taylor method's step: four convolutions a joint and order, and a product with the inverse of M.
double series_cost(int freedoms, int order) {
  return 50 + freedoms * order * (0.7 * order + 1.5 * freedoms + 3);
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

ConstraintCost constraint_cost(const Chain& chain, const ConstraintPlan& plan) {
  const ConstraintSet set(chain, plan.list);
  const bool by_kernel = plan.stabilize != Stabilization::baumgarte && constrained_kernel_of(chain, set).run;
  const double n = chain.nv, m = set.rows(), plane = chain.planar ? 1 : 1.6;
  const double general = plane * (450 * n + 400 * m);
  const double kernel = chain.planar ? 10 * n + 25 * m : 60 * n + 130 * m;
  return {by_kernel ? kernel : general, plan.stabilize == Stabilization::project ? 2.3 * general : 0};
}

double run_cost(const Chain& chain, const Method& method, const MethodOptions& options, double steps,
                double evaluations) {
  if (method.form == Form::series)
    return steps * series_cost(chain.nv, options.order > 0 ? options.order : method.order);
  const auto row =
      std::find_if(kRows.begin(), kRows.end(), [&](const Row& one) { return one.method == method.name; });
  assert(row != kRows.end());
  return steps * (row->per_step + row->per_step_and_freedom * chain.nv) +
         evaluations * (row->evaluations_worth * forward_dynamics_cost(chain) + row->per_evaluation +
                        row->per_evaluation_and_freedom * chain.nv);
}

}  // namespace chainreel
