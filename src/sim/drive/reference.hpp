// The motion that a controller is to follow: q, qd, qdd at each instant.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/csv.hpp"
#include "core/error.hpp"
#include "core/scalar.hpp"
#include "model/chain.hpp"
#include "sim/drive/probe.hpp"

namespace chainreel {

// A number or an expression of the scene, with the place where it stands.
struct Entry {
  std::string text = "0";
  Place place;
};

// Coefficients of t^0, t^1, .. of each freedom.
struct ReferencePolynomials {
  std::vector<std::vector<Quad>> q, qd;
};

class Reference {
 public:
  virtual ~Reference() = default;
  // n numbers each; without room for it, `qdd` is not worked out, for less. Allocates nothing.
  virtual void evaluate(double t, Vec q, Vec qd, Vec qdd) const = 0;
  // What that costs, ns: with or without qdd.
  virtual double price(bool with_acceleration) const = 0;
  // Where it bends or jumps, and the piece between two such instants: see TorqueLaw.
  virtual std::vector<double> breaks(double) const { return {}; }
  virtual void enter_piece(double) {}
  virtual void leave_pieces() {}
  // Coordinates and rates, where each is a polynomial in t.
  virtual std::optional<ReferencePolynomials> polynomials() const { return {}; }
};

// From expressions in t and the parameters, one a freedom. Empty `qd` and `qdd` are the derivatives of q,
// exact by automatic differentiation. Throws Error with every problem of the entries.
std::unique_ptr<Reference> make_expression_reference(const std::vector<Entry>& q,
                                                     const std::vector<Entry>& qd,
                                                     const std::vector<Entry>& qdd,
                                                     const Parameters& parameters);

// From a CSV with t,q1.. and maybe qd1.., qdd1.., or q.NAME of each freedom: cubic splines; what is absent is the spline's
// derivative. Beyond the rows it stands still at the nearest one. Throws Error (bad input) for a unit of another kind, too.
std::unique_ptr<Reference> make_table_reference(const std::string& path, const Chain& chain);
// The same of a table with the quantities q, qd, qdd, in the file `path`.
std::unique_ptr<Reference> make_table_reference(const TimeTable& table, const std::string& path);

// Cubic spline through samples, second derivative continuous, not-a-knot ends (C. de Boor, A Practical Guide
// to Splines, ch. IV): exact for cubics. Two samples give a line, three a parabola, one a constant. Outside
// the samples the motion stands still at the end's value.

class Spline {
 public:
  Spline() = default;
  Spline(std::vector<double> t, std::vector<double> y);  // t rising, same length
  // Of instants that many share.
  static Spline over(std::shared_ptr<const std::vector<double>> t, std::vector<double> y);

  struct Value {
    double y = 0, yd = 0, ydd = 0;
  };
  Value at(double t) const;  // at a sample its very number

 private:
  std::shared_ptr<const std::vector<double>> t_;
  std::vector<double> y_, curvature_;  // second derivatives at the samples
};

}  // namespace chainreel
