#include "dynamics/constraints/constraint_rows.hpp"

#include <algorithm>

#include "core/dense.hpp"
#include "dynamics/recursions.hpp"
#include "dynamics/scratch.hpp"

namespace chainreel {

namespace {

using Vector = Vec3<double>;
using FlatAlgebra = Planar<double>;
using SpaceAlgebra = Spatial<double>;
using AnchorState = ConstrainedWorkspace::AnchorState;
using RowState = ConstrainedWorkspace::RowState;
using Row = ConstraintSet::Row;

Vector rotated(const FlatAlgebra::Pose& X, const Vector& u) {
  return {X.c * u.x - X.s * u.y, X.s * u.x + X.c * u.y, u.z};
}
Vector rotated(const SpaceAlgebra::Pose& X, const Vector& u) {
  return X.R * u;
}

void observe(const Links<FlatAlgebra>& links, const FlatAlgebra::Motion& base,
             const ConstraintSet::Anchor& anchor, AnchorState& state) {
  const auto i = std::size_t(anchor.body);
  const auto& pose = links.pose[i];
  const auto p = FlatAlgebra::in_world(pose, FlatAlgebra::Point{anchor.point.x, anchor.point.y});
  const auto v = FlatAlgebra::in_world(pose, links.v[i], p);
  const auto a = FlatAlgebra::classical(FlatAlgebra::in_world(pose, links.a[i], p), v);
  state.p = {p.x, p.y, anchor.point.z};
  state.v = {v.x, v.y, 0};
  state.w = {0, 0, v.w};
  state.a = {a.x - base.x, a.y - base.y, 0};
  state.alpha = {0, 0, a.w};
}

void observe(const Links<SpaceAlgebra>& links, const SpaceAlgebra::Motion& base,
             const ConstraintSet::Anchor& anchor, AnchorState& state) {
  const auto i = std::size_t(anchor.body);
  const auto& pose = links.pose[i];
  state.p = SpaceAlgebra::in_world(pose, anchor.point);
  const auto v = SpaceAlgebra::in_world(pose, links.v[i], state.p);
  const auto a = SpaceAlgebra::classical(SpaceAlgebra::in_world(pose, links.a[i], state.p), v);
  state.v = v.v;
  state.w = v.w;
  state.a = a.v - base.v;
  state.alpha = a.w;
}

// A force at the point p with a moment, both along the world's axes, as one about the body's origin.
FlatAlgebra::Force in_body(const FlatAlgebra::Pose& X, const Vector& p, const Vector& f, const Vector& n) {
  return {n.z + ((p.x - X.x) * f.y - (p.y - X.y) * f.x), f.x, f.y};
}
SpaceAlgebra::Force in_body(const SpaceAlgebra::Pose& X, const Vector& p, const Vector& f, const Vector& n) {
  return {transposed_times(X.R, n + cross(p - X.p, f)), transposed_times(X.R, f)};
}

// row += the power of force F on body i along each unit rate
template <class A>
void add_powers(const Links<A>& links, std::size_t i, typename A::Force F, double* row) {
  for (; i > 0; i = links.joint[i].parent) {
    const auto& joint = links.joint[i];
    for (std::size_t k = 0; k < joint.freedoms; ++k)
      row[joint.v + k] += A::power(A::unit_motion(links.body[i], links.S[i], int(k)), F);
    F = A::to_parent(links.X[i], F);
  }
}

struct RowValues {
  double phi, Jcd_qd;
};

RowValues distance_row(const AnchorState& a, const AnchorState& b, double length, RowState& row) {
  const Vector d = a.p - b.p, dv = a.v - b.v;
  row.f_a = d * (1 / length);
  row.f_b = d * (-1 / length);
  return {(dot(d, d) - length * length) / (2 * length), (dot(d, a.a - b.a) + dot(dv, dv)) / length};
}

RowValues parallel_row(const AnchorState& a, const AnchorState& b, const Vector& z, const Vector& u,
                       RowState& row) {
  const Vector n = cross(u, z);
  const Vector n_rate = cross(cross(b.w, u), z) + cross(u, cross(a.w, z));
  row.n_b = n;
  row.n_a = n * -1.0;
  return {dot(u, z), dot(n, b.alpha - a.alpha) + dot(n_rate, b.w - a.w)};
}

// Newton's iteration for the foot point from s; quadratic near the curve.
PlaneCurve::Place near_foot_point(const PlaneCurve& curve, const Vector& p, double& s) {
  PlaneCurve::Place place = curve.at(s);
  constexpr int kMostSweeps = 30;
  for (int pass = 0; pass < kMostSweeps; ++pass) {
    const Eigen::Vector2d d(p.x - place.c.x(), p.y - place.c.y());
    const double speed2 = place.c1.squaredNorm();
    // Beyond the centre of curvature Newton's slope changes its sign: the tangent alone leads on there.
    const double bent = speed2 - d.dot(place.c2);
    const double step = d.dot(place.c1) / (bent > 0.1 * speed2 ? bent : speed2);
    s += step;
    place = curve.at(s);
    if (!(absolute(step) > 1e-15 * (1 + absolute(s)))) break;
  }
  return place;
}

double distance(const PlaneCurve::Place& place, const Vector& p) {
  return square_root((Eigen::Vector2d(p.x, p.y) - place.c).squaredNorm());
}

// m: a point further off than this may be on the curve elsewhere.
constexpr double kFarFoot = 1e-3;

// The foot point from where it was last. Where that is long ago, as when a state is looked at without those before it,
// the nearest place on a winding curve may be far along it, behind others that are nearer than their neighbours: then
// both ways along the curve are looked at, in pieces of a twentieth of the distance, for a place that p lies on.
PlaneCurve::Place foot_point(const PlaneCurve& curve, const Vector& p, double& s) {
  constexpr int kPieces = 1000;
  constexpr double kOnIt = 1e-6;  // of the distance from the foot point that was found first
  const PlaneCurve::Place first = near_foot_point(curve, p, s);
  const double off = distance(first, p);
  if (!(off > kFarFoot)) return first;
  for (const double way : {1.0, -1.0}) {
    double along = s, before = off;
    bool nears = false;
    PlaneCurve::Place place = first;
    for (int i = 0; i < kPieces; ++i) {
      const double last = along;
      along += way * 0.05 * off / square_root(place.c1.squaredNorm());
      place = curve.at(along);
      const double now = distance(place, p);
      if (nears && now > before) {
        double found = last;
        const PlaneCurve::Place other = near_foot_point(curve, p, found);
        if (distance(other, p) <= kOnIt * off) {
          s = found;
          return other;
        }
      }
      nears = now < before;
      before = now;
    }
  }
  return first;
}

RowValues curve_row(const AnchorState& a, const PlaneCurve& curve, double& s, RowState& row) {
  const PlaneCurve::Place place = foot_point(curve, a.p, s);
  const double speed = square_root(place.c1.squaredNorm());
  const Vector t{place.c1.x() / speed, place.c1.y() / speed, 0};
  const Vector n{-t.y, t.x, 0};
  const double kappa = (place.c1.x() * place.c2.y() - place.c1.y() * place.c2.x()) / (speed * speed * speed);
  const double phi = n.x * (a.p.x - place.c.x()) + n.y * (a.p.y - place.c.y());
  const double along = dot(t, a.v);
  row.f_a = n;
  return {phi, dot(n, a.a) - kappa * along * along / (1 - kappa * phi)};
}

// The rows of coordinates are constant.
double coordinates_phi(const ConstraintSet& set, const Row& row, ConstVec q, double* Jc) {
  double phi = -row.offset;
  for (int k = row.first_term; k < row.first_term + row.terms; ++k) {
    const ConstraintSet::Term& term = set.terms()[std::size_t(k)];
    phi += term.coefficient * q[std::size_t(term.q)];
    Jc[term.v] += term.coefficient;
  }
  return phi;
}

}  // namespace

template <class A>
void evaluate_rows(const Links<A>& links, const typename A::Motion& base, const ConstraintSet& set,
                   ConstrainedWorkspace& cws, ConstVec q) {
  for (std::size_t k = 0; k < set.anchors().size(); ++k)
    observe(links, base, set.anchors()[k], cws.anchor_states[k]);
  std::fill(cws.Jc.begin(), cws.Jc.end(), 0.0);
  const std::size_t nv = cws.qdd.size();
  constexpr AnchorState kOrigin;
  for (std::size_t i = 0; i < set.row_list().size(); ++i) {
    const Row& row = set.row_list()[i];
    RowState& state = cws.row_states[i];
    double* const Jc = cws.Jc.data() + i * nv;
    if (row.kind == ConstraintSet::Kind::coordinates) {
      cws.phi[i] = coordinates_phi(set, row, q, Jc);
      cws.Jcd_qd[i] = 0;
      continue;
    }
    const auto body_of = [&](int anchor) { return std::size_t(set.anchors()[std::size_t(anchor)].body); };
    const AnchorState& a = cws.anchor_states[std::size_t(row.a)];
    const AnchorState& b = row.b < 0 ? kOrigin : cws.anchor_states[std::size_t(row.b)];
    RowValues values{};
    switch (row.kind) {
      case ConstraintSet::Kind::along:
        state.f_a = row.direction;
        state.f_b = row.direction * -1.0;
        values = {dot(row.direction, a.p - b.p) - row.offset, dot(row.direction, a.a - b.a)};
        break;
      case ConstraintSet::Kind::distance:
        values = distance_row(a, b, row.offset, state);
        break;
      case ConstraintSet::Kind::parallel:
        values = parallel_row(a, b, rotated(links.pose[body_of(row.a)], row.direction),
                              rotated(links.pose[body_of(row.b)], row.axis_b), state);
        break;
      default:
        values = curve_row(a, *set.curves()[std::size_t(row.curve)].shape,
                           cws.curve_s[std::size_t(row.curve)], state);
    }
    cws.phi[i] = values.phi;
    cws.Jcd_qd[i] = values.Jcd_qd;
    add_powers(links, body_of(row.a), in_body(links.pose[body_of(row.a)], a.p, state.f_a, state.n_a), Jc);
    if (row.b < 0) continue;
    add_powers(links, body_of(row.b), in_body(links.pose[body_of(row.b)], b.p, state.f_b, state.n_b), Jc);
  }
}

#define INSTANTIATE(A)                                                                    \
  template void evaluate_rows<A>(const Links<A>&, const A::Motion&, const ConstraintSet&, \
                                 ConstrainedWorkspace&, ConstVec);
INSTANTIATE(Planar<double>)
INSTANTIATE(Spatial<double>)
#undef INSTANTIATE

void compute_constraints(const Chain&, Workspace& ws, const ConstraintSet& set, ConstrainedWorkspace& cws,
                         ConstVec q, ConstVec qd) {
  with_links(ws, [&](auto& links) {
    using A = typename std::decay_t<decltype(links)>::Algebra;
    place(links, q);
    locate(links);
    accelerate(links, typename A::Motion{}, qd, ConstVec(ws.scratch->zeros));
    evaluate_rows(links, typename A::Motion{}, set, cws, q);
  });
}

int reversed_row(Workspace& ws, const ConstraintSet& set) {
  return with_links(ws, [&](auto& links) {
    for (std::size_t i = 0; i < set.row_list().size(); ++i) {
      const Row& row = set.row_list()[i];
      if (row.kind != ConstraintSet::Kind::parallel) continue;
      const auto pose_of = [&](int anchor) {
        return links.pose[std::size_t(set.anchors()[std::size_t(anchor)].body)];
      };
      if (dot(rotated(pose_of(row.a), row.direction), rotated(pose_of(row.b), row.same_b)) < 0) return int(i);
    }
    return -1;
  });
}

namespace {

constexpr double kSameRow = 1e-9;

Eigen::MatrixXd rows_of(const Chain& chain, const ConstraintSet& set, const ConstrainedWorkspace& cws) {
  using Rows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  return Eigen::Map<const Rows>(cws.Jc.data(), set.rows(), chain.nv);
}

}  // namespace

bool repeats_others(const Chain& chain, const ConstraintSet& set, const ConstrainedWorkspace& cws, std::size_t k) {
  const Eigen::MatrixXd all = rows_of(chain, set, cws);
  const int first = set.first_row(k), count = set.first_row(k + 1) - first;
  Eigen::MatrixXd others(all.rows() - count, chain.nv);
  others.topRows(first) = all.topRows(first);
  others.bottomRows(others.rows() - first) = all.bottomRows(others.rows() - first);
  // How many freedoms rows take.
  const auto taken_by = [&](const Eigen::MatrixXd& rows) { return rows.rows() == 0 ? Eigen::Index(0) : chain.nv - null_space(rows, kSameRow).cols(); };
  return taken_by(all) < taken_by(all.middleRows(first, count)) + taken_by(others);
}

Eigen::MatrixXd free_directions(const Chain& chain, Workspace& ws, const ConstraintSet& set, ConstVec q) {
  ConstrainedWorkspace cws(chain, set);
  const std::vector<double> rest(std::size_t(chain.nv));
  compute_constraints(chain, ws, set, cws, q, rest);
  return null_space(rows_of(chain, set, cws), kSameRow);
}

}  // namespace chainreel
