// What a method may ask of the thing that it integrates, in four forms. Knows nothing of robots: q are
// coordinates, v their rates, p momenta.
#pragma once

#include <span>

namespace chainreel {

// q' = N(q) v, v' = f(t, q, v). Where nq = nv, q' = v.
class SecondOrder {
 public:
  virtual ~SecondOrder() = default;
  virtual int nq() const = 0;
  virtual int nv() const = 0;
  // Writes nv numbers. Must not allocate.
  virtual void acceleration(double t, std::span<const double> q, std::span<const double> v,
                            std::span<double> vd) = 0;
  // q' from v. Only systems with nq != nv (quaternions) need their own.
  virtual void q_rate(std::span<const double> q, std::span<const double> v, std::span<double> q_dot) const;
  // q <- q (+) h v: the motion along a constant v.
  virtual void advance(std::span<double> q, std::span<const double> v, double h) const;
  // Brings q back to its manifold (unit quaternions) after a step that added q_rate's.
  virtual void normalize(std::span<double> q) const;
};

// The same motion in momenta p = M(q) v, for nq = nv = n: q' = M(q)^-1 p, p' = dT/dq + Q(t, q, v), where
// T = p^T M^-1 p / 2 is the kinetic energy, differentiated at constant v, and Q all generalized forces.
class Momenta {
 public:
  virtual ~Momenta() = default;
  virtual int n() const = 0;
  // M is constant and no force depends on v: what is implicit for others then needs no iteration.
  virtual bool is_separable() const { return false; }
  virtual void momentum(std::span<const double> q, std::span<const double> v, std::span<double> p) = 0;
  virtual void velocity(std::span<const double> q, std::span<const double> p, std::span<double> v) = 0;
  // p' at v = M(q)^-1 p. Counts as one evaluation.
  virtual void force(double t, std::span<const double> q, std::span<const double> v,
                     std::span<double> p_dot) = 0;
};

// A motion whose Taylor series can be had term by term.
class Series {
 public:
  virtual ~Series() = default;
  virtual int n() const = 0;
  // The coefficients of q(t + s) = sum_k c_k s^k for k = 0 .. order, n numbers each, c_0 = q and c_1 = v
  // first. Counts as one evaluation.
  virtual void expand(double t, std::span<const double> q, std::span<const double> v, int order,
                      std::span<double> c) = 0;
};

// Points in the plane, linked to a chain: point 0 stands still, |x_i - x_{i-1}| = length_i for i = 1 .. n.
// Masses are constant: T = 1/2 sum_i (a_i |x_{i-1}'|^2 + 2 b_i x_{i-1}' . x_i' + c_i |x_i'|^2).
class LinkedPoints {
 public:
  struct Link {
    double length = 1;           // m
    double a = 0, b = 0, c = 0;  // kg
  };
  virtual ~LinkedPoints() = default;
  virtual std::span<const Link> links() const = 0;  // n
  virtual bool force_depends_on_velocity() const { return true; }
  // x: (x_1, y_1, .. x_n, y_n); from and to coordinates. Of the angles that differ by whole turns `read` and
  // `force` mean the one that is nearest to what was placed, read or asked for last.
  virtual void place(std::span<const double> q, std::span<const double> v, std::span<double> x,
                     std::span<double> x_dot) = 0;
  virtual void read(std::span<const double> x, std::span<const double> x_dot, std::span<double> q,
                    std::span<double> v) = 0;
  // All forces on the points but those of the links, 2 n numbers. Counts as one evaluation.
  virtual void force(double t, std::span<const double> x, std::span<const double> x_dot,
                     std::span<double> f) = 0;
};

// Plain coordinates x (x' = rates, as many as v) of a system whose own q are none, about a base that moves along.
class Chart {
 public:
  virtual ~Chart() = default;
  virtual int own_coordinates() const = 0;  // of the system itself
  // The base is q; writes its x and x'.
  virtual void move_to(std::span<const double> q, std::span<const double> v, std::span<double> x,
                       std::span<double> x_dot) = 0;
  // The system's own state at (x, x').
  virtual void leave(std::span<const double> x, std::span<const double> x_dot, std::span<double> q,
                     std::span<double> v) const = 0;
};

enum class Form { second_order, momenta, series, linked_points };

// One system in all forms that were made for it; a method takes the one that its row names. `second_order` is
// always there: dense output between steps asks it for accelerations.
struct Forms {
  SecondOrder* second_order = nullptr;
  Momenta* momenta = nullptr;
  Series* series = nullptr;
  LinkedPoints* linked_points = nullptr;
  Chart* chart = nullptr;  // the forms speak of its x; null: of the system's own coordinates
};

}  // namespace chainreel
