// A stepper with its state and dense output: what turns a bare step into an integrator.
#pragma once

#include <memory>

#include "integrate/hermite_span.hpp"
#include "integrate/method.hpp"

namespace chainreel {

std::unique_ptr<Integrator> make_stepped(SecondOrder& system, std::unique_ptr<Stepper> stepper);

}  // namespace chainreel
