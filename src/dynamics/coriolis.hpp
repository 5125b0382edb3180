// The matrix C of nle = C(q, qd) qd + tau_g, from Christoffel symbols: the one choice of C for which
// Mdot - 2 C is skew for every motion and C is made of derivatives of M alone.
#pragma once

#include <Eigen/Core>

#include "dynamics/workspace.hpp"

namespace chainreel {

// nv x nv, in O(nv d) for a tree of depth d. For floating joints see coriolis.cpp: the two properties hold there too.
Eigen::MatrixXd coriolis_matrix_of(const Chain& chain, ConstVec q, ConstVec qd);

}  // namespace chainreel
