// A method for plain coordinates (q' = v) at work on a system whose own are none (quaternions): each step is taken
// in a chart about the state that it begins at. One-step methods keep their order so. What is symplectic or symmetric
// in one chart is so no longer where the chart moves with the state: energy and angular momentum are kept to the
// method's order, and stray in proportion to the time.
#pragma once

#include <memory>

#include "integrate/hermite_span.hpp"
#include "integrate/integrator.hpp"
#include "integrate/method.hpp"

namespace chainreel {

// `inside` works in the coordinates of `chart`, which must outlive it.
std::unique_ptr<Integrator> make_in_chart(Chart& chart, std::unique_ptr<Integrator> inside);

// A stepper with its state and dense output: what turns a bare step into an integrator. A polynomial through the ends of a crude
// step would move and swing as the method never does (energies of explicit Euler off by ten times their own error): a method
// of order 1 says itself what lies between.
std::unique_ptr<Integrator> make_stepped(SecondOrder& system, std::unique_ptr<Stepper> stepper, int dense_order);

}  // namespace chainreel
