// What ties a mechanism beyond its joints: plain structs, one a kind. Points, directions and normals are
// world numbers; frames go by their names in Chain::frames. In a chain that moves in one plane only what lies
// in that plane counts: a line is one condition there, a point two; in space they are two and three.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace chainreel {

// The frame's origin stays on the line through `point`.
struct LineConstraint {
  std::string frame;
  Eigen::Vector3d point = Eigen::Vector3d::Zero();
  Eigen::Vector3d direction = Eigen::Vector3d::UnitX();  // of any length but zero
};

// ... on the plane through `point`.
struct PlaneConstraint {
  std::string frame;
  Eigen::Vector3d point = Eigen::Vector3d::Zero();
  Eigen::Vector3d normal = Eigen::Vector3d::UnitY();  // of any length but zero
};

// ... at the place `at`.
struct PointConstraint {
  std::string frame;
  Eigen::Vector3d at = Eigen::Vector3d::Zero();
  const char* word = "point";  // what messages call it: "close" of one that closes a loop
};

// A massless rod with ball joints at both ends.
struct DistanceConstraint {
  std::string a, b;
  double length = 1;                    // m, above zero
  std::optional<Eigen::Vector3d> at{};  // the second end's place in the world; then b is empty
};

// Two frames' origins coincide: a joint that closes a loop.
enum class Closure {
  point,  // nothing more
  axis,   // ... and turn against each other about one axis alone, as on a hinge (in the plane: as `point`)
  weld,   // ... and are parallel
};
struct CloseConstraint {
  std::string a, b;
  Closure kind = Closure::point;
  Eigen::Vector3d axis = Eigen::Vector3d::UnitZ();  // of Closure::axis: the same numbers in both frames
};

// A curve in the plane of motion, in its basis (ex, ey), twice differentiable, and never at rest: |c'| > 0.
class PlaneCurve {
 public:
  struct Place {
    Eigen::Vector2d c, c1, c2;  // m; first and second derivative by s
  };
  virtual ~PlaneCurve() = default;
  virtual Place at(double s) const = 0;
};

// The frame's origin stays on the curve, wherever along it.
struct CurveConstraint {
  std::string frame;
  std::shared_ptr<const PlaneCurve> curve;
  double s = 0;  // near the start
};

// One coordinate keeps a value (rad or m).
struct JointConstraint {
  std::string coordinate;  // of Chain::coordinate_names
  double value = 0;
};

// sum of coefficient * coordinate = value
struct LinearConstraint {
  struct Term {
    std::string coordinate;
    double coefficient = 1;
  };
  std::vector<Term> terms;
  double value = 0;
};

using Constraint = std::variant<LineConstraint, PlaneConstraint, PointConstraint, DistanceConstraint,
                                CloseConstraint, CurveConstraint, JointConstraint, LinearConstraint>;

// "m" where all of them keep places alone, "m or rad" where some keep angles or coordinates.
const char* unit_of_misses(const std::vector<Constraint>& constraints);

// "line gripper", "close a b": for messages and as the stem of its rows' names.
std::string name_of(const Constraint& constraint);

}  // namespace chainreel
