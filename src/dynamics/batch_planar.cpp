#include "dynamics/batch_planar.hpp"

namespace chainreel {

std::string to_string(InstructionSet set) {
  switch (set) {
    case InstructionSet::sse2:
      return "sse2";
    case InstructionSet::avx2:
      return "avx2";
    case InstructionSet::avx512:
      return "avx512";
  }
  return "unknown";
}

bool is_supported(InstructionSet set) {
  switch (set) {
    case InstructionSet::avx512:
      return __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq");
    case InstructionSet::avx2:
      return __builtin_cpu_supports("avx2");
    case InstructionSet::sse2:
      break;  // every x86-64 processor has it
  }
  return true;
}

InstructionSet widest_instruction_set() {
  InstructionSet widest = InstructionSet::sse2;
  for (const InstructionSet set : kInstructionSets)
    if (is_supported(set)) widest = set;
  return widest;
}

bool are_alike(const PlanarKernel& a, const PlanarKernel& b) {
  return a.joints == b.joints && a.along_x == b.along_x && a.turned == b.turned;
}

void set_lane_chain(PlanarBlock& block, int lane, const PlanarKernel& kernel) {
  for (std::size_t i = 0; i < std::size_t(kernel.joints); ++i) {
    block.A_ii[i][lane] = kernel.A_ii[i];
    block.pull_c[i][lane] = kernel.pull_c[i];
    block.pull_s[i][lane] = kernel.pull_s[i];
    block.l_x[i][lane] = kernel.l_x[i];
    block.l_y[i][lane] = kernel.l_y[i];
    block.h_x[i][lane] = kernel.h_x[i];
    block.h_y[i][lane] = kernel.h_y[i];
    block.sign[i][lane] = kernel.sign[i];
  }
  block.A_11_inv[lane] = kernel.A_11_inv;
  block.A_11_A_22[lane] = kernel.A_11_A_22;
  block.l_1_h_2[lane] = kernel.l_1_h_2;
}

void set_lane_torque(PlanarBlock& block, int lane, int joints, const double* tau) {
  for (int i = 0; i < joints; ++i) {
    const double handed_on = i + 1 < joints ? tau[i + 1] * block.sign[i + 1][lane] : 0;
    block.Q[i][lane] = tau[i] * block.sign[i][lane] - handed_on;
  }
}

StepPlanarBlocks planar_batch_for(const PlanarKernel& kernel, InstructionSet set) {
  switch (set) {
    case InstructionSet::avx512:
      return planar_batch_for_avx512(kernel);
    case InstructionSet::avx2:
      return planar_batch_for_avx2(kernel);
    case InstructionSet::sse2:
      break;
  }
  return planar_batch_for_sse2(kernel);
}

}  // namespace chainreel
