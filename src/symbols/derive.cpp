#include "symbols/derive.hpp"

#include <algorithm>
#include <cmath>

#include "core/format.hpp"

namespace chainreel {
namespace {

using GiNaC::ex;
using GiNaC::numeric;
using Rotation3 = std::array<Algebra3, 3>;  // rows

// Files write a quarter of a turn with as few as five digits.
constexpr double kRightAngle = 1e-5;

ex dot(const Algebra3& a, const Algebra3& b) {
  return (a[0] * b[0] + a[1] * b[1] + a[2] * b[2]).expand();
}

Algebra3 cross(const Algebra3& a, const Algebra3& b) {
  return {(a[1] * b[2] - a[2] * b[1]).expand(), (a[2] * b[0] - a[0] * b[2]).expand(), (a[0] * b[1] - a[1] * b[0]).expand()};
}

Algebra3 sum(const Algebra3& a, const Algebra3& b) {
  return {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
}

Algebra3 scaled(const ex& s, const Algebra3& a) {
  return {(s * a[0]).expand(), (s * a[1]).expand(), (s * a[2]).expand()};
}

Algebra3 times(const Rotation3& R, const Algebra3& v) {
  return {dot(R[0], v), dot(R[1], v), dot(R[2], v)};
}

Rotation3 transposed(const Rotation3& R) {
  Rotation3 t;
  for (std::size_t r = 0; r < 3; ++r)
    for (std::size_t c = 0; c < 3; ++c) t[c][r] = R[r][c];
  return t;
}

Rotation3 product(const Rotation3& a, const Rotation3& b) {
  const Rotation3 columns = transposed(b);
  Rotation3 p;
  for (std::size_t r = 0; r < 3; ++r)
    for (std::size_t c = 0; c < 3; ++c) p[r][c] = dot(a[r], columns[c]);
  return p;
}

Algebra3 exact(const Eigen::Vector3d& v) {
  return {exact_number(v[0]), exact_number(v[1]), exact_number(v[2])};
}

// A fixed rotation; by right angles where it is that to the digits of a file.
Rotation3 exact(const Eigen::Matrix3d& R, double& off) {
  const Eigen::Matrix3d right = R.array().round();
  const double deviation = (R - right).cwiseAbs().maxCoeff();
  const bool is_right = deviation < kRightAngle;
  if (is_right) off = std::max(off, deviation);
  Rotation3 numbers;
  for (int r = 0; r < 3; ++r) numbers[std::size_t(r)] = exact(Eigen::Vector3d((is_right ? right : R).row(r).transpose()));
  return numbers;
}

// About a unit axis by an angle with this cosine and sine.
Rotation3 rotation(const Algebra3& axis, const ex& cosine, const ex& sine) {
  Rotation3 R;
  for (std::size_t r = 0; r < 3; ++r)
    for (std::size_t c = 0; c < 3; ++c) {
      const ex skew = r == c ? ex(0) : (c == (r + 1) % 3 ? -1 : 1) * axis[3 - r - c];
      R[r][c] = ((r == c ? cosine : ex(0)) + (1 - cosine) * axis[r] * axis[c] + sine * skew).expand();
    }
  return R;
}

// A body's pose in W and the twist of its frame, in its own axes, for each unit rate.
struct Moving {
  Rotation3 R;
  Algebra3 p;
  std::vector<Algebra3> angular, linear;
};

class Walk {
 public:
  Walk(const Chain& chain, const ChainParameters& parameters, const Coordinates& coordinates)
      : chain_(chain), parameters_(parameters), coordinates_(coordinates) {
    const Algebra3 none{0, 0, 0};
    const std::vector<Algebra3> still(std::size_t(chain.nv), none);
    moving_.push_back({{Algebra3{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, none, still, still});
    for (std::size_t i = 1; i < chain.bodies.size(); ++i) moving_.push_back(next(i));
  }

  const Moving& body(int i) const { return moving_[std::size_t(i)]; }
  double off() const { return off_; }

 private:
  // The value of the joint's own coordinate as cosine and sine.
  std::pair<ex, ex> turned(const Joint& joint) {
    const ex z = pow(coordinates_.exponential[std::size_t(joint.v_index)], numeric(long(std::lround(joint.ratio))));
    const ex cosine = (z + 1 / z) / 2, sine = (z - 1 / z) / (2 * GiNaC::I);
    if (joint.offset == 0) return {cosine, sine};
    const ex c = exact_number(std::cos(joint.offset)), s = exact_number(std::sin(joint.offset));
    return {(cosine * c - sine * s).expand(), (sine * c + cosine * s).expand()};
  }

  Moving next(std::size_t i) {
    const Body& body = chain_.bodies[i];
    const Joint& joint = body.joint;
    const Moving& parent = moving_[std::size_t(body.parent)];
    const std::size_t own = std::size_t(joint.v_index);
    const Algebra3 axis = exact(joint.axis);
    const Rotation3 fixed = exact(Eigen::Matrix3d(joint.X_PJ.linear()), off_);
    const ex ratio = exact_number(joint.ratio);
    Rotation3 R = fixed;
    Algebra3 t = parameters_.bodies[i].joint;
    if (joint.kind == JointKind::revolute) {
      const auto [cosine, sine] = turned(joint);
      R = product(fixed, rotation(axis, cosine, sine));
    } else {
      t = sum(t, times(fixed, scaled(ratio * coordinates_.position[own] + exact_number(joint.offset), axis)));
    }
    Moving moving{product(parent.R, R), sum(parent.p, times(parent.R, t)), {}, {}};
    const Rotation3 back = transposed(R);
    for (std::size_t j = 0; j < parent.angular.size(); ++j) {
      moving.angular.push_back(times(back, parent.angular[j]));
      moving.linear.push_back(times(back, sum(parent.linear[j], cross(parent.angular[j], t))));
    }
    auto& freedom = joint.kind == JointKind::revolute ? moving.angular[own] : moving.linear[own];
    freedom = sum(freedom, scaled(ratio, axis));
    return moving;
  }

  const Chain& chain_;
  const ChainParameters& parameters_;
  const Coordinates& coordinates_;
  std::vector<Moving> moving_;
  double off_ = 0;
};

// w_j^T I w_k of one body.
ex turning(const Chain& chain, const BodyParameters& named, const Algebra3& wj, const Algebra3& wk) {
  // In the plane both are along its normal.
  if (chain.planar) return named.planar_inertia.is_zero() ? ex(0) : ex(named.planar_inertia * dot(wj, wk));
  ex e = 0;
  for (std::size_t r = 0; r < 3; ++r) e += wj[r] * dot(named.inertia[r], wk);
  return e;
}

bool is_right(const Eigen::MatrixXd& m) {
  return (m.array() - m.array().round()).abs().maxCoeff() < kRightAngle;
}

}  // namespace

bool is_right_angled(const Chain& chain) {
  return std::all_of(chain.bodies.begin() + 1, chain.bodies.end(), [](const Body& body) {
    return is_right(body.joint.X_PJ.linear()) && is_right(body.joint.axis);
  });
}

Chain flattened(const Chain& chain) {
  const PlanarChain& planar = *chain.planar;
  Eigen::Matrix3d to_plane;
  to_plane << planar.plane.ex.transpose(), planar.plane.ey.transpose(), planar.plane.normal.transpose();
  Chain flat = chain;
  flat.planar->plane = {};
  flat.gravity = to_plane * chain.gravity;
  flat.gravity[2] = 0;
  for (std::size_t i = 0; i < chain.bodies.size(); ++i) {
    const PlanarBody& body = planar.bodies[i];
    flat.planar->X_WB_zero[i].linear().setIdentity();
    Joint& joint = flat.bodies[i].joint;
    joint.X_PJ = Eigen::Isometry3d(Eigen::Translation3d(body.p_PJ[0], body.p_PJ[1], 0));
    joint.axis = body.kind == JointKind::revolute ? Eigen::Vector3d(0, 0, body.sign)
                                                  : Eigen::Vector3d(body.direction[0], body.direction[1], 0);
    flat.bodies[i].inertia.com = {body.com[0], body.com[1], 0};
  }
  for (Frame& frame : flat.frames) {
    const Eigen::Isometry3d& at_zero = planar.X_WB_zero[std::size_t(frame.body)];
    Eigen::Vector3d p = to_plane * (at_zero.linear() * frame.X_BF.translation());
    p[2] = 0;
    frame.X_BF = Eigen::Isometry3d(Eigen::Translation3d(p));
  }
  return flat;
}

Derived derive(const Chain& chain, const ChainParameters& parameters, const Coordinates& coordinates,
               const std::vector<Eigen::Vector3d>& directions) {
  const Walk walk(chain, parameters, coordinates);
  const unsigned n = unsigned(chain.nv);
  Derived derived;
  derived.M = GiNaC::matrix(n, n);
  for (std::size_t i = 1; i < chain.bodies.size(); ++i) {
    const Moving& body = walk.body(int(i));
    const BodyParameters& named = parameters.bodies[i];
    std::vector<Algebra3> v;
    for (std::size_t j = 0; j < n; ++j) v.push_back(sum(body.linear[j], cross(body.angular[j], named.com)));
    for (unsigned j = 0; j < n; ++j)
      for (unsigned k = 0; k <= j; ++k) {
        const ex part = named.mass * dot(v[j], v[k]) + turning(chain, named, body.angular[j], body.angular[k]);
        derived.M(j, k) = (derived.M(j, k) + part).expand();
        derived.M(k, j) = derived.M(j, k);
      }
    derived.potential -= named.mass * dot(parameters.gravity, sum(body.p, times(body.R, named.com)));
  }
  derived.potential = derived.potential.expand();
  if (chain.end_effector >= 0) {
    const Moving& body = walk.body(chain.frames[std::size_t(chain.end_effector)].body);
    const Algebra3 p = sum(body.p, times(body.R, parameters.end_effector));
    for (const Eigen::Vector3d& d : directions) derived.position.push_back(dot(exact(d), p));
  }
  if (walk.off() > 1e-12)
    derived.notes.push_back("angles of joints' frames that are right but for " + format_significant(walk.off(), 2) +
                            " rad are taken for right ones");
  return derived;
}

ex derivative(const ex& e, const Coordinates& coordinates, std::size_t i) {
  if (!coordinates.turns[i]) return e.diff(GiNaC::ex_to<GiNaC::symbol>(coordinates.position[i])).expand();
  const GiNaC::symbol& z = coordinates.exponential[i];
  return (GiNaC::I * z * e.diff(z)).expand();
}

GiNaC::matrix coriolis_of(const GiNaC::matrix& M, const Coordinates& coordinates) {
  const unsigned n = M.rows();
  std::vector<GiNaC::matrix> by;  // dM/dq_k
  for (unsigned k = 0; k < n; ++k) {
    GiNaC::matrix d(n, n);
    for (unsigned i = 0; i < n; ++i)
      for (unsigned j = 0; j < n; ++j) d(i, j) = derivative(M(i, j), coordinates, k);
    by.push_back(d);
  }
  GiNaC::matrix C(n, n);
  for (unsigned i = 0; i < n; ++i)
    for (unsigned j = 0; j < n; ++j) {
      ex c = 0;
      for (unsigned k = 0; k < n; ++k) c += (by[k](i, j) + by[j](i, k) - by[i](j, k)) * coordinates.rate[k] / 2;
      C(i, j) = c.expand();
    }
  return C;
}

}  // namespace chainreel
