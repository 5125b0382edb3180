// The equation of motion of a chain in symbols,
//
//   tau = M(q) qdd + C(q, qd) qd + g(q) + tau_f(qd),
//
// with the Jacobian J of its end effector's position and Lambda = J^-T M J^-1: M from the kinetic energy, C by Christoffel's
// symbols, g from the potential energy (R. Murray, Z. Li, S. Sastry, A Mathematical Introduction to Robotic Manipulation,
// ch. 4.2). Lengths, masses and inertias are symbols, directions of axes are numbers.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "model/chain.hpp"
#include "symbols/formula.hpp"

namespace chainreel {

// More joints have matrices that nobody reads.
inline constexpr int kMostSymbolicFreedoms = 4;

// numerator / root^2: Lambda of a square J, whose determinant is the root, without the factors that both have.
struct SymbolicLambda {
  FormulaMatrix numerator;
  Formula root;
};

struct SymbolicEquation {
  std::string model;
  std::vector<Symbol> symbols;         // those that occur; the positions of sliders and all rates among them
  std::vector<std::string> coordinates;  // names of the nv joints
  std::vector<bool> turns;             // one a coordinate: an angle, or a displacement
  FormulaMatrix M, C;               // nv x nv
  std::vector<Formula> g;           // nv
  std::vector<Formula> damping;     // nv: the part of tau_f that is linear in qd
  std::vector<Formula> friction;    // nv: what tanh(qd / v0) is multiplied by in the rest of tau_f
  std::string end_effector;            // "" where the chain has none
  std::vector<std::string> axes;       // of the rows of J: x, y, z, or what they are of the world
  FormulaMatrix J;
  std::optional<SymbolicLambda> Lambda;  // absent where J is not square, has no inverse anywhere, or one that nobody reads
  std::vector<std::string> notes;      // what was taken for what, one sentence each
};

// Throws Error (bad input) where the chain has more freedoms than kMostSymbolicFreedoms, a floating base, joints that
// follow others by a ratio that is not whole, or moves in space with axes at other angles than right ones.
SymbolicEquation symbolic_equation_of(const Chain& chain);

// Its numbers in one state; q and qd: nv each.
struct SymbolicValues {
  std::vector<double> symbols, angles;
};
SymbolicValues values_at(const SymbolicEquation& equation, std::span<const double> q, std::span<const double> qd);

}  // namespace chainreel
