// The motion that a controller is to follow: q, qd, qdd at each instant.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "core/error.hpp"
#include "sim/probe.hpp"

namespace chainreel {

// A number or an expression of the scene, with the place where it stands.
struct Entry {
  std::string text = "0";
  Place place;
};

class Reference {
 public:
  virtual ~Reference() = default;
  virtual void evaluate(double t, Vec q, Vec qd, Vec qdd) const = 0;  // n numbers each; allocates nothing
  // Where it bends or jumps, and the piece between two such instants: see TorqueLaw.
  virtual std::vector<double> breaks(double) const { return {}; }
  virtual void enter_piece(double) {}
  virtual void leave_pieces() {}
};

// From expressions in t and the parameters, one a freedom. Empty `qd` and `qdd` are the derivatives of q,
// exact by automatic differentiation. Throws Error with every problem of the entries.
std::unique_ptr<Reference> make_expression_reference(const std::vector<Entry>& q,
                                                     const std::vector<Entry>& qd,
                                                     const std::vector<Entry>& qdd,
                                                     const Parameters& parameters);

// From a CSV with t,q1.. and maybe qd1.., qdd1..: cubic splines; what is absent is the spline's derivative.
std::unique_ptr<Reference> make_table_reference(const std::string& path, int n);

}  // namespace chainreel
