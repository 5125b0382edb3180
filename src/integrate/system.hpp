// What a method may ask of the thing that it integrates. Knows nothing of robots.
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

}  // namespace chainreel
