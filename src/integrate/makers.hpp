// The makers behind the registry's rows; one method, one file.
#pragma once

#include <memory>

#include "integrate/method.hpp"

namespace chainreel {

std::unique_ptr<Stepper> make_explicit_euler(int nq, int nv);
std::unique_ptr<Stepper> make_semi_implicit_euler(int nq, int nv);
std::unique_ptr<Stepper> make_rk4(int nq, int nv);

std::unique_ptr<Integrator> make_dop853(const Forms& forms, const MethodOptions& options);
std::unique_ptr<Integrator> make_taylor(const Forms& forms, const MethodOptions& options);
std::unique_ptr<Integrator> make_radau5(const Forms& forms, const MethodOptions& options);

std::unique_ptr<Integrator> make_symplectic_euler(const Forms& forms, const MethodOptions& options);
std::unique_ptr<Integrator> make_verlet(const Forms& forms, const MethodOptions& options);
std::unique_ptr<Integrator> make_implicit_midpoint(const Forms& forms, const MethodOptions& options);
std::unique_ptr<Integrator> make_gauss4(const Forms& forms, const MethodOptions& options);
std::unique_ptr<Integrator> make_gauss6(const Forms& forms, const MethodOptions& options);

std::unique_ptr<Integrator> make_rattle2(const Forms& forms, const MethodOptions& options);
std::unique_ptr<Integrator> make_rattle4(const Forms& forms, const MethodOptions& options);
std::unique_ptr<Integrator> make_rattle6(const Forms& forms, const MethodOptions& options);
std::unique_ptr<Integrator> make_rattle8(const Forms& forms, const MethodOptions& options);

}  // namespace chainreel
