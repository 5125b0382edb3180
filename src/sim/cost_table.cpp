// Measured once by work-precision runs on a 2.8 GHz Cascade Lake (`chainreel chart`, CSV: seconds, steps and
// evaluations) and rounded: what matters is the order of the candidates. Times of other processors differ by
// a common factor.
#include "sim/cost_table.hpp"

#include <algorithm>
#include <array>

#include "dynamics/equation_of_motion.hpp"
#include "dynamics/kernels/constrained_kernel.hpp"

namespace chainreel {

double forward_dynamics_cost(const Chain& chain) {
  constexpr std::array<double, 5> kPlanarKernel = {0, 14, 21, 35, 50};
  const double n = chain.nv;
  switch (algorithm_of(chain)) {
    case Algorithm::planar_kernel:
      return kPlanarKernel[std::size_t(std::min(chain.nv, 4))];
    case Algorithm::spatial_kernel:
      return 50 * n + 20;
    case Algorithm::mass_matrix:
      return 130 * n + 4 * n * n;
    case Algorithm::articulated_body:
      break;
  }
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
  return method.price.of(steps, evaluations, chain.nv, options.order > 0 ? options.order : method.order,
                         forward_dynamics_cost(chain));
}

}  // namespace chainreel
