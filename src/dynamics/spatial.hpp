// The algebra of motion in space: 6-vectors, in the axes and about the origin of each body's own frame.
// R. Featherstone, Rigid Body Dynamics Algorithms (2008), ch. 2 and appendix A (the compact forms used here).
//
//   Motion  (w; v)   angular velocity; velocity of the origin
//   Force   (n; f)   moment about the origin; force
//   S       motion of the body against its parent for a unit rate of its coordinate; for floating joints
//           the six unit twists, in the order of the velocity: linear, then angular
//   X       pose of the body in its parent: R turns the body's axes into the parent's, p is the body's
//           origin there
#pragma once

#include <array>

#include "core/scalar.hpp"
#include "dynamics/algebra.hpp"
#include "model/chain.hpp"

namespace chainreel {

template <class T>
struct Spatial {
  using Scalar = T;
  static constexpr bool has_floating = true;

  struct Motion {
    Vec3<T> w, v;
    friend Motion operator+(const Motion& a, const Motion& b) { return {a.w + b.w, a.v + b.v}; }
    friend Motion operator*(const Motion& a, const T& k) { return {a.w * k, a.v * k}; }
  };

  struct Force {
    Vec3<T> n, f;
    friend Force operator+(const Force& a, const Force& b) { return {a.n + b.n, a.f + b.f}; }
    friend Force operator*(const Force& a, const T& k) { return {a.n * k, a.f * k}; }
  };

  // Mass, mass times centre of mass, moments of inertia about the origin.
  struct RigidInertia {
    T m{};
    Vec3<T> h;
    Sym3<T> I;
    friend Force operator*(const RigidInertia& I, const Motion& v) {
      return {I.I * v.w + cross(I.h, v.v), v.v * I.m - cross(I.h, v.w)};
    }
  };

  // [I H; H^T M], from Motion to Force.
  struct Inertia {
    Sym3<T> I;
    Mat3<T> H;
    Sym3<T> M;
    friend Force operator*(const Inertia& A, const Motion& v) {
      return {A.I * v.w + A.H * v.v, transposed_times(A.H, v.w) + A.M * v.v};
    }
  };

  struct Placement {
    Mat3<T> R{{T(1), T(0), T(0)}, {T(0), T(1), T(0)}, {T(0), T(0), T(1)}};
    Vec3<T> p;
  };
  using Pose = Placement;

  // What is constant in one body. A turning joint's R is turn_0 + turn_s sin + turn_c cos of its angle
  // (Rodrigues' formula behind the fixed turn of the joint frame); a sliding one's p is p_PJ + slide q.
  struct Body {
    JointKind kind = JointKind::revolute;
    T ratio{1}, offset{};
    Mat3<T> turn_0, turn_s, turn_c;
    Vec3<T> p_PJ, slide;
    Motion S;
    RigidInertia I;
  };

  static Body body_of(const Chain& chain, int i);
  // Body `self` at joint coordinates q (one number, or seven of a floating joint).
  static void place(const Body& self, const Placement& parent, const T* q, Placement& X, Motion& S,
                    RigidInertia& I);
  static Pose pose_of(const Pose& parent, const Placement& X) {
    return {parent.R * X.R, parent.R * X.p + parent.p};
  }
  static Motion base_acceleration(const Chain& chain) {  // the world rises at -gravity
    return {{}, vec3_of<T>(-chain.gravity)};
  }

  static Motion joint_motion(const Body& self, const Motion& S, const T* qd) {
    if (self.kind == JointKind::floating) return {{qd[3], qd[4], qd[5]}, {qd[0], qd[1], qd[2]}};
    return S * *qd;
  }
  static Motion unit_motion(const Body& self, const Motion& S, int k) {
    if (self.kind != JointKind::floating) return S;
    const auto unit = [](int j) { return Vec3<T>{T(j == 0 ? 1 : 0), T(j == 1 ? 1 : 0), T(j == 2 ? 1 : 0)}; };
    return {unit(k - 3), unit(k)};
  }

  static Motion to_child(const Placement& X, const Motion& v) {
    return {transposed_times(X.R, v.w), transposed_times(X.R, v.v + cross(v.w, X.p))};
  }
  static Force to_parent(const Placement& X, const Force& f) {
    const Vec3<T> force = X.R * f.f;
    return {X.R * f.n + cross(X.p, force), force};
  }
  static RigidInertia to_parent(const Placement& X, const RigidInertia& I);
  static Inertia to_parent(const Placement& X, const Inertia& I);

  // of a force along a motion
  static T power(const Motion& v, const Force& f) { return dot(v.w, f.n) + dot(v.v, f.f); }
  // v x m, and v x* f
  static Motion cross_motion(const Motion& v, const Motion& m) {
    return {cross(v.w, m.w), cross(v.w, m.v) + cross(v.v, m.w)};
  }
  static Force cross_force(const Motion& v, const Force& f) {
    return {cross(v.w, f.n) + cross(v.v, f.f), cross(v.w, f.f)};
  }

  // Points of a frame, in the body and in the world; a motion in the world's axes, at such a point instead of
  // the body's origin; the acceleration that a stopwatch would measure there.
  using Point = Vec3<T>;
  static Point point_of(const Chain&, const Frame& frame) { return vec3_of<T>(frame.X_BF.translation()); }
  static Point in_world(const Pose& X, const Point& p) { return X.R * p + X.p; }
  static Motion in_world(const Pose& X, const Motion& v, const Point& at) {
    const Vec3<T> w = X.R * v.w;
    return {w, X.R * v.v + cross(w, at - X.p)};
  }
  static Motion classical(const Motion& a, const Motion& v) { return {a.w, a.v + cross(v.w, v.v)}; }
  static constexpr int kLinearRows = 3, kFullRows = 6;
  static std::array<T, 6> rows(const Motion& v) { return {v.w.x, v.w.y, v.w.z, v.v.x, v.v.y, v.v.z}; }

  static Inertia articulated(const RigidInertia& I);
  static void add(RigidInertia& sum, const RigidInertia& I) { sum = {sum.m + I.m, sum.h + I.h, sum.I + I.I}; }
  static void add(Inertia& sum, const Inertia& I) { sum = {sum.I + I.I, sum.H + I.H, sum.M + I.M}; }
  // I - U U^T / D
  static Inertia without(const Inertia& I, const Force& U, const T& D_inv);
  // The motion that a force gives to an inertia.
  static Motion solve(const Inertia& I, const Force& f);
  static Force joint_force(const T* tau) { return {{tau[3], tau[4], tau[5]}, {tau[0], tau[1], tau[2]}}; }
  static void write_joint_rates(const Motion& m, T* rates) {
    rates[0] = m.v.x, rates[1] = m.v.y, rates[2] = m.v.z;
    rates[3] = m.w.x, rates[4] = m.w.y, rates[5] = m.w.z;
  }

 private:
  static void place_floating(const Body& self, const T* q, Placement& X);
};

template <class T>
typename Spatial<T>::Body Spatial<T>::body_of(const Chain& chain, int i) {
  const chainreel::Body& b = chain.bodies[std::size_t(i)];
  const Joint& joint = b.joint;
  Body self;
  self.kind = joint.kind;
  self.ratio = T(joint.ratio);
  self.offset = T(joint.offset);
  self.p_PJ = vec3_of<T>(joint.X_PJ.translation());

  const Mat3<T> R_PJ = mat3_of<T>(joint.X_PJ.linear());
  const Vec3<T> axis = vec3_of<T>(joint.axis);
  if (joint.kind == JointKind::revolute) {
    const Mat3<T> identity = Placement{}.R;
    const Mat3<T> along = outer(axis, axis);
    self.turn_0 = R_PJ * along;
    self.turn_s = R_PJ * cross(axis, identity);
    self.turn_c = R_PJ * (identity - along);
    self.S.w = axis * self.ratio;
  } else {
    self.turn_0 = R_PJ;
    self.slide = R_PJ * axis;
    self.S.v = axis * self.ratio;
  }

  const Vec3<T> com = vec3_of<T>(b.inertia.com);
  self.I.m = T(b.inertia.mass);
  self.I.h = com * self.I.m;
  const Mat3<T> about_com = mat3_of<T>(b.inertia.about_com);
  const T hc = dot(self.I.h, com);
  self.I.I = upper(about_com) + Sym3<T>{hc, T(0), T(0), hc, T(0), hc} + upper(outer(self.I.h * T(-1), com));
  return self;
}

template <class T>
void Spatial<T>::place(const Body& self, const Placement&, const T* q, Placement& X, Motion& S,
                       RigidInertia& I) {
  S = self.S;
  I = self.I;
  if (self.kind == JointKind::floating) return place_floating(self, q, X);
  const T value = self.ratio * *q + self.offset;
  if (self.kind == JointKind::revolute) {
    const auto [sin, cos] = sin_cos(value);
    X.R = self.turn_0 + self.turn_s * sin + self.turn_c * cos;
    X.p = self.p_PJ;
  } else {
    X.R = self.turn_0;
    X.p = self.p_PJ + self.slide * value;
  }
}

// The quaternion need not be of unit length: inside a step of an integrator it is so only nearly.
template <class T>
void Spatial<T>::place_floating(const Body& self, const T* q, Placement& X) {
  const Vec3<T> u{q[3], q[4], q[5]};
  const T w = q[6];
  const T k = T(2) / (dot(u, u) + w * w);
  const T xx = k * u.x * u.x, yy = k * u.y * u.y, zz = k * u.z * u.z;
  const T xy = k * u.x * u.y, xz = k * u.x * u.z, yz = k * u.y * u.z;
  const T wx = k * w * u.x, wy = k * w * u.y, wz = k * w * u.z;
  const Mat3<T> turn{{T(1) - (yy + zz), xy - wz, xz + wy},
                     {xy + wz, T(1) - (xx + zz), yz - wx},
                     {xz - wy, yz + wx, T(1) - (xx + yy)}};
  X.R = self.turn_0 * turn;
  X.p = self.p_PJ + self.turn_0 * Vec3<T>{q[0], q[1], q[2]};
}

// Steiner's rule, written with h so that massless bodies are no exception.
template <class T>
typename Spatial<T>::RigidInertia Spatial<T>::to_parent(const Placement& X, const RigidInertia& I) {
  const Vec3<T>& p = X.p;
  const Vec3<T> h = X.R * I.h;
  const Vec3<T> h_new = h + p * I.m;
  const T d = dot(h + h_new, p);
  const Mat3<T> cross_part = outer(h, p) + outer(p, h_new);
  return {I.m, h_new, rotated(X.R, I.I) + Sym3<T>{d, T(0), T(0), d, T(0), d} + upper(cross_part * T(-1))};
}

template <class T>
typename Spatial<T>::Inertia Spatial<T>::to_parent(const Placement& X, const Inertia& A) {
  const Sym3<T> M = rotated(X.R, A.M);
  const Mat3<T> H = X.R * A.H * transpose(X.R);
  const Mat3<T> Hp = H + cross(X.p, full(M));
  // I - H [p]x + [p]x Hp^T; with H [p]x = -([p]x H^T)^T
  const Mat3<T> left = transpose(cross(X.p, transpose(H)));
  const Mat3<T> right = cross(X.p, transpose(Hp));
  return {rotated(X.R, A.I) + upper(left + right), Hp, M};
}

template <class T>
typename Spatial<T>::Inertia Spatial<T>::articulated(const RigidInertia& I) {
  const T m = I.m;
  const Vec3<T>& h = I.h;
  return {I.I, {{T(0), -h.z, h.y}, {h.z, T(0), -h.x}, {-h.y, h.x, T(0)}}, {m, T(0), T(0), m, T(0), m}};
}

template <class T>
typename Spatial<T>::Inertia Spatial<T>::without(const Inertia& A, const Force& U, const T& D_inv) {
  const Force V = U * (-D_inv);
  return {A.I + upper(outer(U.n, V.n)), A.H + outer(U.n, V.f), A.M + upper(outer(U.f, V.f))};
}

template <class T>
typename Spatial<T>::Motion Spatial<T>::solve(const Inertia& A, const Force& f) {
  std::array<T, 36> L{A.I.xx,   A.I.xy,   A.I.xz,   A.H.r0.x, A.H.r0.y, A.H.r0.z,  //
                      A.I.xy,   A.I.yy,   A.I.yz,   A.H.r1.x, A.H.r1.y, A.H.r1.z,  //
                      A.I.xz,   A.I.yz,   A.I.zz,   A.H.r2.x, A.H.r2.y, A.H.r2.z,  //
                      A.H.r0.x, A.H.r1.x, A.H.r2.x, A.M.xx,   A.M.xy,   A.M.xz,    //
                      A.H.r0.y, A.H.r1.y, A.H.r2.y, A.M.xy,   A.M.yy,   A.M.yz,    //
                      A.H.r0.z, A.H.r1.z, A.H.r2.z, A.M.xz,   A.M.yz,   A.M.zz};
  std::array<T, 6> x{f.n.x, f.n.y, f.n.z, f.f.x, f.f.y, f.f.z};
  ldlt_factor(6, L.data());
  ldlt_solve(6, L.data(), x.data());
  return {{x[0], x[1], x[2]}, {x[3], x[4], x[5]}};
}

}  // namespace chainreel
