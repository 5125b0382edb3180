// The makers behind the registry's rows; one method, one file.
#pragma once

#include <memory>

#include "integrate/method.hpp"

namespace chainreel {

std::unique_ptr<Stepper> make_explicit_euler(int nq, int nv);
std::unique_ptr<Stepper> make_semi_implicit_euler(int nq, int nv);
std::unique_ptr<Stepper> make_rk4(int nq, int nv);

std::unique_ptr<Integrator> make_dop853(const Forms& forms, const MethodOptions& options);
std::unique_ptr<Integrator> make_radau5(const Forms& forms, const MethodOptions& options);

}  // namespace chainreel
