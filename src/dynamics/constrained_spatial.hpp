// Constrained forward dynamics of a chain or tree of up to 15 joints in space, with one to three different
// rows: dynamics/kernel_spatial.hpp has the chain's own equations, all vectors about one point O.
//
//   row along e     f = e        gamma = e.(a_a - a_b)                            a at qdd = 0
//   row of a rod    f = d / L    gamma = (d.(a_a - a_b) + |v_a - v_b|^2) / L      d = p_a - p_b
//   C_j = S_j . (p_a x f - p_b x f, f - f) over the anchors that joint j carries
//
// The rows ride through the elimination of M = L^T D L in the lanes of one vector, F = L^-T C^T, so that
// G = F^T D^-1 F and lambda = G^-1 (C qdd_free + gamma) cost no further solution with M.
#pragma once

#include <array>
#include <vector>

#include "dynamics/constraint_set.hpp"
#include "dynamics/kernel_spatial.hpp"

namespace chainreel {

struct SpatialRows {
  struct Anchor {
    int body = 0;                                 // 0: the world
    alignas(32) SpatialKernel::Lanes point[3]{};  // in the kernel's axes of the body, each in all lanes

    bool operator==(const Anchor&) const = default;
  };
  struct Row {
    int a = 0, b = 0;  // anchors
    bool rod = false;
    alignas(32) SpatialKernel::Lanes direction{};
    double length_inv = 0;

    bool operator==(const Row&) const = default;
  };
  std::vector<Anchor> anchors;
  std::array<Row, 3> row;
};

}  // namespace chainreel
