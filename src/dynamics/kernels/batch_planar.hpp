// Semi-implicit Euler steps of many small planar chains at once: kernel_planar.hpp's forward dynamics with a
// chain in each lane of a vector, instead of a joint. Masses, lengths, torques and steps may differ from lane
// to lane; the number of joints and the two properties of PlanarKernel that choose another text may not.
//
// Each lane does the operations of the scalar path in the scalar path's order, none fused, so that it has the
// same bits. Lanes whose angles the scalar path would hand to the careful sine and cosine are handed to it one by one.
#pragma once

#include "dynamics/kernels/kernel_planar.hpp"

namespace chainreel {

// Eight chains, each number of theirs in a row. The layout is the same for every width.
struct alignas(64) PlanarBlock {
  static constexpr int kLanes = 8;
  static constexpr int kMaxJoints = PlanarKernel::kMaxJoints;
  using Row = double[kLanes];

  Row q[kMaxJoints]{}, qd[kMaxJoints]{};
  Row h{};              // s; 0 leaves a lane where it is
  Row Q[kMaxJoints]{};  // tau_i - tau_{i+1}, along the normal
  // As in PlanarKernel.
  Row A_ii[kMaxJoints]{}, pull_c[kMaxJoints]{};
  Row A_11_inv{}, A_11_A_22{}, l_1_h_2{};
  Row l_x[kMaxJoints]{}, h_x[kMaxJoints]{};
  Row pull_s[kMaxJoints]{}, l_y[kMaxJoints]{}, h_y[kMaxJoints]{};
  Row sign[kMaxJoints]{};
};

// Whether two chains may stand in one block.
bool are_alike(const PlanarKernel& a, const PlanarKernel& b);

void set_lane_chain(PlanarBlock& block, int lane, const PlanarKernel& kernel);
void set_lane_torque(PlanarBlock& block, int lane, int joints, const double* tau);  // after the chain

// Moves each lane of `count` blocks by that many steps. A few blocks at a time, all in the fastest cache,
// hide each other's latencies.
using StepPlanarBlocks = void (*)(PlanarBlock* blocks, int count, long steps);
inline constexpr int kBlocksAtATime = 4;

// For blocks of chains like this one.
StepPlanarBlocks planar_batch_for(const PlanarKernel& kernel);

}  // namespace chainreel
