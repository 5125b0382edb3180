#include "dynamics/kernels/kernel_planar.hpp"

namespace chainreel {

namespace {

bool fits_planar(const Chain& chain) {
  if (!chain.planar || !chain.serial || chain.has_mimic) return false;
  if (chain.nv < 1 || chain.nv > PlanarKernel::kMaxJoints) return false;
  const auto& bodies = chain.planar->bodies;
  for (std::size_t i = 1; i < bodies.size(); ++i) {
    const PlanarBody& body = bodies[i];
    const bool next_in_row = body.parent + 1 == int(i) && body.q_index + 1 == int(i);
    if (body.kind != JointKind::revolute || !next_in_row) return false;
  }
  return true;
}

}  // namespace

PlanarKernel planar_kernel_of(const Chain& chain) {
  PlanarKernel kernel;
  if (!fits_planar(chain)) return kernel;
  kernel.joints = chain.nv;
  const Eigen::Vector2d gravity(chain.gravity.dot(chain.planar->plane.ex),
                                chain.gravity.dot(chain.planar->plane.ey));
  const auto& bodies = chain.planar->bodies;
  const auto n = std::size_t(chain.nv);
  double carried = 0;  // mass behind the link
  for (std::size_t i = n; i-- > 0;) {
    const PlanarBody& body = bodies[i + 1];
    const Eigen::Vector2d l = i + 1 < n ? bodies[i + 2].p_PJ : Eigen::Vector2d(Eigen::Vector2d::Zero());
    const Eigen::Vector2d h = body.mass * body.com + l * carried;
    kernel.A_ii[i] = body.inertia + body.mass * body.com.squaredNorm() + l.squaredNorm() * carried;
    kernel.l_x[i] = l.x(), kernel.l_y[i] = l.y();
    kernel.h_x[i] = h.x(), kernel.h_y[i] = h.y();
    kernel.pull_c[i] = h.x() * gravity.y() - h.y() * gravity.x();
    kernel.pull_s[i] = h.x() * gravity.x() + h.y() * gravity.y();
    kernel.sign[i] = body.sign;
    carried += body.mass;
    kernel.along_x &= l.y() == 0 && h.y() == 0 && kernel.pull_s[i] == 0;
    kernel.turned |= body.sign != 1;
  }
  kernel.A_11_inv = 1 / kernel.A_ii[0];
  kernel.A_11_A_22 = kernel.A_ii[0] * kernel.A_ii[1];
  kernel.l_1_h_2 = kernel.l_x[0] * kernel.h_x[1];
  return kernel;
}

}  // namespace chainreel
