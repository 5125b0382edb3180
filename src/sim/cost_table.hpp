// What a run costs, by counting: evaluations and steps times a table that is part of the source. Nothing here
// is measured while the program runs, so that choices are the same on every machine.
#pragma once

#include "integrate/method.hpp"
#include "model/chain.hpp"
#include "sim/system/constraint_plan.hpp"
#include "sim/system/trajectory.hpp"

namespace chainreel {

// ns of one forward dynamics on the machine that the table was measured on.
double forward_dynamics_cost(const Chain& chain);

// The price of one evaluation under constraints, and of what is done after a step, ns.
struct ConstraintCost {
  double evaluation, projection;
};
ConstraintCost constraint_cost(const Chain& chain, const ConstraintPlan& plan);

// ns, of steps and evaluations taken by the method with these options.
double run_cost(const Chain& chain, const Method& method, const MethodOptions& options, double steps,
                double evaluations);

}  // namespace chainreel
