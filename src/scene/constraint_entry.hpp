// Constraints as a scene writes them. Which numbers mean what depends on the chain: two are along the plane
// in which it moves, three are world x y z.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "core/error.hpp"
#include "core/names.hpp"
#include "model/constraint.hpp"

namespace chainreel {

// In the order of the alternatives of Constraint.
enum class ConstraintKind { line, plane, point, distance, close, curve, joint, linear };
std::span<const Name> names_of(ConstraintKind);

struct ConstraintEntry {
  ConstraintKind kind = ConstraintKind::point;
  std::string a;                  // the frame, the first of two frames, or the joint
  std::string b;                  // the second frame; empty: `at` says the place
  std::vector<double> at;         // a point of the line or plane; where the frame or the rod's end is to be
  std::vector<double> direction;  // of a line; a plane's normal; a closure's axis, empty: z
  double value = 0;               // of a joint, a sum; a rod's length, m
  Closure closure = Closure::point;
  std::string x, y;               // of a curve: expressions in s
  double s = 0;                   // where along the curve its foot point is sought first
  std::vector<std::pair<std::string, double>> coefficients;
  Place place;
};

struct ContactEntry {
  int constraint = 1;         // in the list, from 1
  std::vector<double> force;  // N
  Place place;
};

}  // namespace chainreel
