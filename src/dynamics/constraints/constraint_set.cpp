#include "dynamics/constraints/constraint_set.hpp"

#include <cmath>

#include "core/error.hpp"
#include "core/format.hpp"
#include "dynamics/kinematics.hpp"

namespace chainreel {

namespace {

using Eigen::Vector3d;

// The least part of a unit vector that lies in the plane: less is the round-off of a vector along the normal.
constexpr double kAcross = 1e-9;

// Two unit vectors that make a right-handed basis with n; axes of the world where n is one.
std::pair<Vector3d, Vector3d> across(const Vector3d& n) {
  int least = 2;
  for (int k = 1; k >= 0; --k)
    if (std::fabs(n[k]) < std::fabs(n[least])) least = k;
  const Vector3d e1 = (Vector3d::Unit(least) - n * n[least]).normalized();
  return {e1, n.cross(e1)};
}

}  // namespace

// Takes the constraints apart. What is wrong is gathered in `problems`.
class ConstraintSetMaker {
 public:
  ConstraintSetMaker(const Chain& chain, ConstraintSet& set)
      : chain_(chain), set_(set), basis_(task_basis(chain, Task::linear)) {}

  void add(const Constraint& constraint) {
    name_ = name_of(constraint);
    set_.first_row_.push_back(set_.rows());
    const auto rows = set_.rows_.size();
    const auto faults = faults_;
    std::visit([&](const auto& c) { take(c); }, constraint);
    if (set_.rows_.size() == rows && faults_ == faults)
      fault("the chain moves in one plane, and no motion in it changes this condition");
  }

  void finish() {
    set_.first_row_.push_back(set_.rows());
    problems_.throw_if_any();
  }

 private:
  using Row = ConstraintSet::Row;
  using Kind = ConstraintSet::Kind;

  void fault(const std::string& what) {
    ++faults_;
    problems_.add("constraint '" + name_ + "': " + what, {});
  }

  // Into the numbers that rows are measured in.
  Vec3<double> numbers(const Vector3d& v) const {
    if (!chain_.planar) return vec3_of<double>(v);
    const Plane& plane = chain_.planar->plane;
    return {plane.ex.dot(v), plane.ey.dot(v), plane.normal.dot(v)};
  }

  // A vector of a body, and of a frame, as the numbers that the recursions know it by.
  Vec3<double> body_numbers(int body, const Vector3d& v) const {
    if (!chain_.planar) return vec3_of<double>(v);
    return numbers(chain_.planar->X_WB_zero[std::size_t(body)].linear() * v);
  }
  Vec3<double> body_numbers(const Frame& frame, const Vector3d& v) const {
    return body_numbers(frame.body, frame.X_BF.linear() * v);
  }

  int frame_of(const std::string& name) {
    const int frame = find_frame(chain_, name);
    if (frame >= 0) return frame;
    std::vector<std::string> names;
    for (const Frame& f : chain_.frames) names.push_back(f.name);
    const std::string near = did_you_mean(name, names);
    fault("no frame '" + name + (near.empty() ? "'; there are " + joined(names) : "':" + near));
    return -1;
  }

  int anchor_at(int index) {
    const Frame& frame = chain_.frames[std::size_t(index)];
    ConstraintSet::Anchor anchor{frame.body, body_numbers(frame.body, frame.X_BF.translation())};
    if (chain_.planar) {
      const auto& X_zero = chain_.planar->X_WB_zero[std::size_t(frame.body)];
      anchor.point.z += chain_.planar->plane.normal.dot(X_zero.translation());
    }
    return shared(anchor);
  }

  // A place of the world.
  int anchor_at(const Vector3d& at) { return shared({0, numbers(at)}); }

  int shared(const ConstraintSet::Anchor& anchor) {
    for (std::size_t k = 0; k < set_.anchors_.size(); ++k) {
      const auto& other = set_.anchors_[k];
      const Vec3<double> d = other.point - anchor.point;
      if (other.body == anchor.body && dot(d, d) == 0) return int(k);
    }
    set_.anchors_.push_back(anchor);
    return int(set_.anchors_.size()) - 1;
  }

  // -1 where there is no such frame, or it cannot move.
  int moving_anchor(const std::string& name) {
    const int frame = frame_of(name);
    if (frame < 0) return -1;
    if (chain_.frames[std::size_t(frame)].body != 0) return anchor_at(frame);
    fault("frame '" + name + "' belongs to the base, which does not move");
    return -1;
  }

  // Two different frames of which one can move against the other.
  bool pair_of(const std::string& a, const std::string& b, int& frame_a, int& frame_b) {
    frame_a = frame_of(a);
    frame_b = frame_of(b);
    if (frame_a < 0 || frame_b < 0) return false;
    if (chain_.frames[std::size_t(frame_a)].body != chain_.frames[std::size_t(frame_b)].body) return true;
    fault("'" + a + "' and '" + b + "' belong to one body");
    return false;
  }

  void push(const Row& row, const std::string& part) {
    set_.rows_.push_back(row);
    set_.row_names_.push_back(part.empty() ? name_ : name_ + " " + part);
  }

  // direction . (p_a - p_b) = direction . at, unless nothing can move along `direction`.
  void push_along(int a, int b, const Vector3d& direction, const Vector3d& at, const std::string& part) {
    const Vec3<double> e = numbers(direction);
    if (chain_.planar && e.x * e.x + e.y * e.y < kAcross * kAcross) return;
    push({.kind = Kind::along, .a = a, .b = b, .direction = e, .offset = direction.dot(at)}, part);
  }

  std::string axis_name(const Vector3d& e) const {
    for (std::size_t k = 0; k < basis_.directions.size(); ++k)
      if (basis_.directions[k].cross(e).norm() < kAcross) return basis_.names[k];
    return {};
  }

  void take(const LineConstraint& c) {
    const int a = moving_anchor(c.frame);
    Vector3d direction = c.direction;
    if (!(direction.norm() > 0)) return fault("the direction has no length");
    if (a < 0) return;
    if (!chain_.planar) {
      const auto [e1, e2] = across(direction.normalized());
      push_along(a, -1, e1, c.point, "1");
      return push_along(a, -1, e2, c.point, "2");
    }
    const Vector3d& normal = chain_.planar->plane.normal;
    if (std::fabs(direction.normalized().dot(normal)) > kAcross)
      return fault("the line leaves the plane in which the chain moves");
    push_along(a, -1, normal.cross(direction).normalized(), c.point, {});
  }

  void take(const PlaneConstraint& c) {
    const int a = moving_anchor(c.frame);
    if (!(c.normal.norm() > 0)) return fault("the normal has no length");
    if (a >= 0) push_along(a, -1, c.normal.normalized(), c.point, {});
  }

  void take(const PointConstraint& c) {
    const int a = moving_anchor(c.frame);
    if (a < 0) return;
    for (std::size_t k = 0; k < basis_.directions.size(); ++k)
      push_along(a, -1, basis_.directions[k], c.at, basis_.names[k]);
  }

  void take(const DistanceConstraint& c) {
    if (!(c.length > 0))
      return fault("the length must be above zero; two points that coincide are a 'close'");
    if (c.at) {
      const int a = moving_anchor(c.a);
      if (a >= 0) push({.kind = Kind::distance, .a = a, .b = anchor_at(*c.at), .offset = c.length}, {});
      return;
    }
    int a = 0, b = 0;
    if (!pair_of(c.a, c.b, a, b)) return;
    push({.kind = Kind::distance, .a = anchor_at(a), .b = anchor_at(b), .offset = c.length}, {});
  }

  void take(const CloseConstraint& c) {
    int a = 0, b = 0;
    if (!pair_of(c.a, c.b, a, b)) return;
    const int anchor_a = anchor_at(a), anchor_b = anchor_at(b);
    for (std::size_t k = 0; k < basis_.directions.size(); ++k)
      push_along(anchor_a, anchor_b, basis_.directions[k], Vector3d::Zero(), basis_.names[k]);
    const auto push_parallel = [&](const Vector3d& axis_a, const Vector3d& axis_b, const std::string& part) {
      push({.kind = Kind::parallel,
            .a = anchor_a,
            .b = anchor_b,
            .direction = body_numbers(chain_.frames[std::size_t(a)], axis_a),
            .axis_b = body_numbers(chain_.frames[std::size_t(b)], axis_b),
            .same_b = body_numbers(chain_.frames[std::size_t(b)], axis_a)},
           part);
    };
    if (c.kind == Closure::weld && chain_.planar) return push_parallel_in_plane(anchor_a, anchor_b, a, b);
    if (c.kind == Closure::weld) {
      for (int k = 0; k < 3; ++k)
        push_parallel(Vector3d::Unit((k + 1) % 3), Vector3d::Unit((k + 2) % 3), std::string("w_") + "xyz"[k]);
    }
    if (c.kind == Closure::axis && !chain_.planar) {
      if (!(c.axis.norm() > 0)) return fault("the axis has no length");
      const auto [e1, e2] = across(c.axis.normalized());
      push_parallel(c.axis.normalized(), e1, "w_1");
      push_parallel(c.axis.normalized(), e2, "w_2");
    }
  }

  // An axis of frame a in the plane of motion, and the same axis of frame b, a quarter turn on.
  void push_parallel_in_plane(int anchor_a, int anchor_b, int a, int b) {
    const auto axis_of = [&](int frame, int k) {
      return body_numbers(chain_.frames[std::size_t(frame)], Vector3d::Unit(k));
    };
    int flattest = 0;
    for (int k = 1; k < 3; ++k)
      if (std::fabs(axis_of(a, k).z) < std::fabs(axis_of(a, flattest).z)) flattest = k;
    const Vec3<double> u = axis_of(a, flattest), w = axis_of(b, flattest);
    if (std::fabs(u.z - w.z) > kAcross)
      return fault("the frames cannot become parallel by motion in the plane");
    const double size_u = std::hypot(u.x, u.y), size_w = std::hypot(w.x, w.y);
    push({.kind = Kind::parallel,
          .a = anchor_a,
          .b = anchor_b,
          .direction = {u.x / size_u, u.y / size_u, 0},
          .axis_b = {-w.y / size_w, w.x / size_w, 0},
          .same_b = {w.x / size_w, w.y / size_w, 0}},
         "w");
  }

  void take(const CurveConstraint& c) {
    const int a = moving_anchor(c.frame);
    if (!chain_.planar) return fault("curves are for chains that move in one plane");
    if (!c.curve) return fault("no curve is given");
    if (a < 0) return;
    push({.kind = Kind::curve, .a = a, .curve = int(set_.curves_.size())}, {});
    set_.curves_.push_back({c.curve, c.s});
  }

  void push_coordinates(const std::vector<LinearConstraint::Term>& terms, double value) {
    Row row{.kind = Kind::coordinates, .offset = value, .first_term = int(set_.terms_.size())};
    bool moves = false;
    for (const LinearConstraint::Term& term : terms) {
      const auto joint = joint_of(term.coordinate);
      if (!joint) return;
      set_.terms_.push_back({joint->q_index, joint->v_index, term.coefficient});
      moves |= term.coefficient != 0;
    }
    if (!moves) return fault("all coefficients are zero");
    row.terms = int(terms.size());
    push(row, {});
  }

  const Joint* joint_of(const std::string& coordinate) {
    for (std::size_t v = 0; v < chain_.coordinate_names.size(); ++v) {
      if (chain_.coordinate_names[v] != coordinate) continue;
      for (std::size_t i = 1; i < chain_.bodies.size(); ++i) {
        const Joint& joint = chain_.bodies[i].joint;
        if (joint.kind != JointKind::floating && joint.v_index == int(v)) return &joint;
      }
      fault("'" + coordinate + "' belongs to a floating joint");
      return nullptr;
    }
    fault("no coordinate '" + coordinate + "'" + did_you_mean(coordinate, chain_.coordinate_names));
    return nullptr;
  }

  void take(const JointConstraint& c) { push_coordinates({{c.coordinate, 1}}, c.value); }
  void take(const LinearConstraint& c) { push_coordinates(c.terms, c.value); }

  const Chain& chain_;
  ConstraintSet& set_;
  TaskBasis basis_;
  ProblemList problems_;
  int faults_ = 0;
  std::string name_;
};

ConstraintSet::ConstraintSet(const Chain& chain, std::vector<Constraint> constraints)
    : constraints_(std::move(constraints)) {
  ConstraintSetMaker maker(chain, *this);
  for (const Constraint& constraint : constraints_) maker.add(constraint);
  maker.finish();
}

}  // namespace chainreel
