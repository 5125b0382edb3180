// The Taylor series of a chain of revolute joints in one plane, term by term, in absolute angles phi_i.
// A. Jorba, M. Zou, A Software Package for the Numerical Integration of ODEs by Means of High-Order Taylor
// Methods, Experimental Mathematics 14 (2005) 99-117, for series from recurrences; the equations are those of
// kernel_planar.hpp (R_i, l_i, h_i, A_ij, Q_i), written so that products of three series never occur.
//
// With s_i = sin phi_i, c_i = cos phi_i, and kappa_ij, sigma_ij the scalar and the cross product of l_i with
// h_j for i < j, of h_i with l_j for i > j:
//
//   A_ii phi_i'' + c_i Y_i - s_i X_i = Q_i,
//   Y_i = sum_{j != i} (kappa_ij s_j'' + sigma_ij c_j'') - pull_c_i,
//   X_i = sum_{j != i} (kappa_ij c_j'' - sigma_ij s_j'') - pull_s_i,
//
// since c_i s_j'' - s_i c_j'' is cos(phi_i - phi_j) phi_j'' + sin(phi_i - phi_j) phi_j'^2. Q_i = tau_i -
// tau_{i+1} in the torques about the normal: polynomials in t plus multiples of q and qd, so that it has its
// own series. With x[k] the coefficient of t^k in x,
//
//   m s[m] =   sum_{j=1..m} j phi[j] c[m-j],     m c[m] = - sum_{j=1..m} j phi[j] s[m-j].
//
// phi[k+2] enters s[k+2] and c[k+2] linearly, as c[0] phi[k+2] and -s[0] phi[k+2], and through them the
// coefficient k of the equation: M times phi''[k] = what is known, with one M = (A_ij) for all orders.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/scalar.hpp"
#include "model/chain.hpp"

namespace chainreel {

// tau_i = sum_k powers[i][k] t^k + sum_j (K[i n + j] q_j + D[i n + j] qd_j), with digits to spare.
struct AffineTorque {
  std::vector<std::vector<Quad>> powers;  // of each joint
  std::vector<Quad> K, D;                 // n x n, row by row
};

// Why the chain has no such series, a clause that follows "because"; nothing where it has one.
std::optional<std::string> why_no_planar_series(const Chain& chain);

// For double, DoubleDouble and Quad.
template <class T>
class PlanarSeries {
 public:
  // The chain must have a series; orders up to `highest_order` may be asked for, from 2 on.
  PlanarSeries(const Chain& chain, const AffineTorque& torque, int highest_order);
  ~PlanarSeries();
  PlanarSeries(PlanarSeries&&) noexcept;

  // Coefficients of q(t + s) in s up to the order, n numbers each. Allocates nothing.
  void expand(T t, std::span<const T> q, std::span<const T> v, int order, std::span<T> c);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace chainreel
