#include "dynamics/constrained_kernel_text.hpp"

namespace chainreel {

ConstrainedKernel::Run constrained_kernel_for_any_processor(int joints, int rows) {
  return constrained_kernel_for(joints, rows);
}

}  // namespace chainreel
