#include "dynamics/kernel_planar_text.hpp"

namespace chainreel {

PlanarKernel::Run planar_kernel_for_any_processor(int joints, bool along_x, bool turned) {
  return planar_kernel_for(joints, along_x, turned);
}

}  // namespace chainreel
