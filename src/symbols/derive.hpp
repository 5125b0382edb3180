// Energies and positions of a chain as polynomials in its parameters and in z_i = exp(i q_i), and their derivatives:
// cosines and sines are sums of z_i and 1 / z_i, so that expanding a product is all the trigonometry there is. Internal.
#pragma once

#include <ginac/ginac.h>

#include <string>
#include <vector>

#include "symbols/parameters.hpp"

namespace chainreel {

struct Coordinates {
  std::vector<bool> turns;                // one a coordinate
  std::vector<GiNaC::symbol> exponential; // z_i, of those that turn
  std::vector<GiNaC::ex> position, rate;  // q_i of sliders (0 of others), qd_i
};

// Whether all joints' frames and axes stand at right angles to their bodies', to the digits of a file. Others have numbers
// for their directions, which a chain in space multiplies to terms by the hundred thousand.
bool is_right_angled(const Chain& chain);

// A planar chain as its planar form has it: in the xy plane, every frame parallel to it at zero.
Chain flattened(const Chain& chain);

struct Derived {
  GiNaC::matrix M;                  // nv x nv
  GiNaC::ex potential;              // J
  std::vector<GiNaC::ex> position;  // of the end effector, along the rows of its Jacobian
  std::vector<std::string> notes;
};

// `directions`: of the Jacobian's rows, in W.
Derived derive(const Chain& chain, const ChainParameters& parameters, const Coordinates& coordinates,
               const std::vector<Eigen::Vector3d>& directions);

// With respect to the i-th coordinate.
GiNaC::ex derivative(const GiNaC::ex& e, const Coordinates& coordinates, std::size_t i);

// C of M qdd + C qd, by Christoffel's symbols.
GiNaC::matrix coriolis_of(const GiNaC::matrix& M, const Coordinates& coordinates);

}  // namespace chainreel
