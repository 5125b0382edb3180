#include "integrate/method.hpp"

#include "core/error.hpp"
#include "core/format.hpp"
#include "integrate/in_chart.hpp"
#include "integrate/makers.hpp"

namespace chainreel {
namespace {

// The Taylor method's step: four convolutions a joint and order, and a product with the inverse of M.
double series_step(int n, int order) {
  return 50 + n * order * (0.7 * order + 1.5 * n + 3);
}

}  // namespace

const std::vector<Method>& methods() {
  static const std::vector<Method> rows{
      {.name = "explicit_euler",
       .title = "explicit Euler",
       .order = 1,
       .kind = "explicit",
       .dense_order = 1,
       .evaluations_per_step = 1,
       .price = {10, 2, 1, 30, 0},
       .source = "L. Euler, Institutionum calculi integralis I (1768), ch. 7",
       .make_stepper = make_explicit_euler},
      {.name = "semi_implicit_euler",
       .title = "semi-implicit Euler",
       .order = 1,
       .kind = "semi-implicit in (q, qd)",
       .dense_order = 1,
       .evaluations_per_step = 1,
       .price = {10, 2, 1, 30, 0},
       .source =
           "E. Hairer, C. Lubich, G. Wanner, Geometric Numerical Integration (2006), I.1.2; here in (q, qd)",
       .make_stepper = make_semi_implicit_euler},
      {.name = "rk4",
       .title = "RK4",
       .order = 4,
       .kind = "explicit",
       .evaluations_per_step = 4,
       .price = {20, 6, 1, 15, 0},
       .source = "W. Kutta, Zeitschrift fuer Mathematik und Physik 46 (1901) 435-453",
       .make_stepper = make_rk4},
      {.name = "dop853",
       .title = "DOP853",
       .order = 8,
       .kind = "explicit, adaptive",
       .adaptive = true,
       .dense_order = 7,
       .evaluations_per_step = 12,
       .price = {60, 40, 1, 20, 0},
       .source = "J. Dormand, P. Prince; E. Hairer, S. Norsett, G. Wanner, Solving Ordinary Differential "
                 "Equations I (1993), II.5, II.10",
       .make = make_dop853},
      {.name = "taylor",
       .title = "Taylor series",
       .order = 20,
       .kind = "series, adaptive",
       .form = Form::series,
       .adaptive = true,
       .lowest_order = 12,
       .highest_order = 30,
       .dense_order = 20,
       .evaluations_per_step = 1,
       .price = Price(series_step),
       .source = "A. Jorba, M. Zou, Experimental Mathematics 14 (2005) 99-117",
       .make = make_taylor},
      {.name = "radau5",
       .title = "Radau 5",
       .order = 5,
       .kind = "implicit, adaptive, L-stable",
       .adaptive = true,
       .plain_coordinates = true,
       .evaluations_per_step = 0,
       .price = {400, 170, 1, 30, 0},
       .source = "E. Hairer, G. Wanner, Solving Ordinary Differential Equations II (1996), IV.5, IV.8",
       .make = make_radau5},
      {.name = "symplectic_euler",
       .title = "symplectic Euler",
       .order = 1,
       .kind = "symplectic, in (q, p)",
       .form = Form::momenta,
       .symplectic = true,
       .dense_order = 3,
       .evaluations_per_step = 0,
       .price = {20, 10, 5, 10, 0},
       .source = "E. Hairer, C. Lubich, G. Wanner, Geometric Numerical Integration (2006), VI.3",
       .make = make_symplectic_euler},
      {.name = "verlet",
       .title = "Verlet",
       .order = 2,
       .kind = "symplectic, in (q, p)",
       .form = Form::momenta,
       .symplectic = true,
       .reversible = true,
       .dense_order = 3,
       .evaluations_per_step = 0,
       .price = {20, 10, 8, 0, 0},
       .source = "E. Hairer, C. Lubich, G. Wanner, Geometric Numerical Integration (2006), VI.3",
       .make = make_verlet},
      {.name = "implicit_midpoint",
       .title = "implicit midpoint",
       .order = 2,
       .kind = "implicit, symplectic, A-stable, in (q, p)",
       .form = Form::momenta,
       .symplectic = true,
       .reversible = true,
       .evaluations_per_step = 0,
       .price = {40, 20, 5, 40, 0},
       .source = "E. Hairer, C. Lubich, G. Wanner, Geometric Numerical Integration (2006), II.1.3",
       .make = make_implicit_midpoint},
      {.name = "gauss4",
       .title = "Gauss 4",
       .order = 4,
       .kind = "implicit, symplectic, A-stable, in (q, p)",
       .form = Form::momenta,
       .symplectic = true,
       .reversible = true,
       .evaluations_per_step = 0,
       .price = {60, 30, 5, 35, 0},
       .source = "E. Hairer, C. Lubich, G. Wanner, Geometric Numerical Integration (2006), II.1.3",
       .make = make_gauss4},
      {.name = "gauss6",
       .title = "Gauss 6",
       .order = 6,
       .kind = "implicit, symplectic, A-stable, in (q, p)",
       .form = Form::momenta,
       .symplectic = true,
       .reversible = true,
       .evaluations_per_step = 0,
       .price = {60, 30, 5, 35, 0},
       .source = "E. Hairer, C. Lubich, G. Wanner, Geometric Numerical Integration (2006), II.1.3",
       .make = make_gauss6},
      {.name = "rattle2",
       .title = "RATTLE 2",
       .order = 2,
       .kind = "symplectic, in Cartesian coordinates",
       .form = Form::linked_points,
       .symplectic = true,
       .reversible = true,
       .evaluations_per_step = 0,
       .price = {20, 20, 0, 0, 55},
       .source = "H. Andersen, Journal of Computational Physics 52 (1983) 24-34; E. Hairer, C. Lubich, G. "
                 "Wanner, Geometric Numerical Integration (2006), VII.1.4",
       .make = make_rattle2},
      {.name = "rattle4",
       .title = "RATTLE 4",
       .order = 4,
       .kind = "symplectic, in Cartesian coordinates",
       .form = Form::linked_points,
       .symplectic = true,
       .reversible = true,
       .evaluations_per_step = 0,
       .price = {20, 20, 0, 0, 55},
       .source = "M. Suzuki, Physics Letters A 146 (1990) 319-323; E. Hairer, C. Lubich, G. Wanner, "
                 "Geometric Numerical Integration (2006), II.4, VII.1.4",
       .make = make_rattle4},
      {.name = "rattle6",
       .title = "RATTLE 6",
       .order = 6,
       .kind = "symplectic, in Cartesian coordinates",
       .form = Form::linked_points,
       .symplectic = true,
       .reversible = true,
       .evaluations_per_step = 0,
       .price = {20, 20, 0, 0, 55},
       .source = "W. Kahan, R.-C. Li, Mathematics of Computation 66 (1997) 1089-1099; E. Hairer, C. Lubich, "
                 "G. Wanner, Geometric Numerical Integration (2006), V.3.2, VII.1.4",
       .make = make_rattle6},
      {.name = "rattle8",
       .title = "RATTLE 8",
       .order = 8,
       .kind = "symplectic, in Cartesian coordinates",
       .form = Form::linked_points,
       .symplectic = true,
       .reversible = true,
       .evaluations_per_step = 0,
       .price = {20, 20, 0, 0, 55},
       .source = "W. Kahan, R.-C. Li, Mathematics of Computation 66 (1997) 1089-1099; E. Hairer, C. Lubich, "
                 "G. Wanner, Geometric Numerical Integration (2006), V.3.2, VII.1.4",
       .make = make_rattle8},
  };
  return rows;
}

std::string method_title(const std::string& name) {
  for (const Method& method : methods())
    if (method.name == name) return method.title;
  return name;
}

const Method& find_method(const std::string& name) {
  std::vector<std::string> names;
  for (const Method& method : methods()) {
    if (method.name == name) return method;
    names.push_back(method.name);
  }
  const std::string near = did_you_mean(name, names);
  throw Error(ExitCode::bad_input, "unknown method '" + name + "':" +
                                       (near.empty() ? " they are " + joined(names) + "." : near + " `chainreel methods` lists all."));
}

std::unique_ptr<Integrator> make_integrator(const Method& method, const Forms& forms,
                                            const MethodOptions& options) {
  if (forms.chart) return make_in_chart(*forms.chart, method.make(forms, options));
  if (method.make) return method.make(forms, options);
  return make_stepped(*forms.second_order,
                      method.make_stepper(forms.second_order->nq(), forms.second_order->nv()), method.dense_order);
}

}  // namespace chainreel
