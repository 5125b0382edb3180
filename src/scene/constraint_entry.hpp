// Constraints as a scene writes them: a struct a kind, its members by the names of their keys. Which numbers
// mean what depends on the chain: two are along the plane in which it moves, three are world x y z.
#pragma once

#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "core/error.hpp"
#include "model/constraint.hpp"

namespace chainreel {

class ConstraintKind;  // its keys and what they mean: scene/keys/constraints/kind.hpp

struct LineEntry {
  static const ConstraintKind& kind();
  std::string frame;
  std::vector<double> point, direction;
};

struct PlaneEntry {
  static const ConstraintKind& kind();
  std::string frame;
  std::vector<double> point, normal;
};

struct PointEntry {
  static const ConstraintKind& kind();
  std::string frame;
  std::vector<double> at;
};

// `b` names a frame, or `at` a place in its stead.
struct DistanceEntry {
  static const ConstraintKind& kind();
  std::string a, b;
  std::vector<double> at;
  double length = 0;  // m
};

struct CloseEntry {
  static const ConstraintKind& kind();
  std::string a, b;
  std::vector<double> at;
  Closure closure = Closure::point;
  std::vector<double> axis;  // of Closure::axis; empty: z
};

struct CurveEntry {
  static const ConstraintKind& kind();
  std::string frame;
  std::string x, y;  // expressions in s
  double s = 0;      // where along the curve its foot point is sought first
};

struct JointEntry {
  static const ConstraintKind& kind();
  std::string name;
  double value = 0;  // rad or m
};

struct LinearEntry {
  static const ConstraintKind& kind();
  std::vector<std::pair<std::string, double>> coefficients;
  double value = 0;
};

// A kind more: its struct here, and a file of its own in scene/keys/constraints.
using ConstraintForm = std::variant<LineEntry, PlaneEntry, PointEntry, DistanceEntry, CloseEntry, CurveEntry,
                                    JointEntry, LinearEntry>;

struct ConstraintEntry {
  ConstraintForm form;
  Place place;
};

struct ContactEntry {
  int constraint = 1;         // in the list, from 1
  std::vector<double> force;  // N
  Place place;
};

}  // namespace chainreel
