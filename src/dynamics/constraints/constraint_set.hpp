// The constraints of a mechanism made ready: frames looked up, and each constraint taken apart into rows, one
// scalar condition phi(q) = 0 each. No row is built that a chain in the plane would fulfil by itself.
//
// World numbers of a planar chain are taken along its basis (ex, ey, normal).
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "dynamics/algebra.hpp"
#include "model/chain.hpp"
#include "model/constraint.hpp"

namespace chainreel {

class ConstraintSet {
 public:
  // Throws Error with every problem: unknown frames and coordinates, directions of no length, conditions that
  // no motion of the chain can change.
  ConstraintSet(const Chain& chain, std::vector<Constraint> constraints);

  int rows() const { return int(rows_.size()); }
  const std::vector<Constraint>& constraints() const { return constraints_; }
  const std::vector<std::string>& row_names() const { return row_names_; }  // "line gripper y"
  // The rows of constraint k are first_row(k) .. first_row(k + 1) - 1.
  int first_row(std::size_t k) const { return first_row_[k]; }

  // A point of a body, and where a body's frame is asked for, the axes fixed in it.
  struct Anchor {
    int body = 0;
    Vec3<double> point;  // in the body; planar: in its planar frame, z its height over the plane
  };
  enum class Kind {
    along,        // direction . (p_a - p_b) = offset
    distance,     // |p_a - p_b| = offset
    parallel,     // axis_a . axis_b = 0
    curve,        // distance of p_a from the curve = 0
    coordinates,  // sum of terms = offset
  };
  struct Row {
    Kind kind = Kind::along;
    int a = -1, b = -1;        // anchors; b may be -1: the world's origin
    Vec3<double> direction{};  // along: unit, in W; parallel: axis_a in body a
    Vec3<double> axis_b{};     // parallel, in body b
    Vec3<double> same_b{};     // parallel, in body b: what axis_a is along when all is well
    double offset = 0;
    int first_term = 0, terms = 0;  // coordinates
    int curve = -1;                 // into curves()
  };
  struct Term {
    int q = 0, v = 0;
    double coefficient = 1;
  };
  struct Curve {
    std::shared_ptr<const PlaneCurve> shape;
    double s = 0;
  };
  const std::vector<Anchor>& anchors() const { return anchors_; }
  const std::vector<Row>& row_list() const { return rows_; }
  const std::vector<Term>& terms() const { return terms_; }
  const std::vector<Curve>& curves() const { return curves_; }

 private:
  friend class ConstraintSetMaker;

  std::vector<Constraint> constraints_;
  std::vector<Row> rows_;
  std::vector<std::string> row_names_;
  std::vector<int> first_row_;
  std::vector<Anchor> anchors_;
  std::vector<Term> terms_;
  std::vector<Curve> curves_;
};

}  // namespace chainreel
