#include "dynamics/kernel_planar.hpp"

#include <algorithm>
#include <bit>

#include "core/scalar.hpp"

namespace chainreel {

namespace {

constexpr SinCosTable make_sin_cos_table() {
  using namespace detail;
  SinCosTable t{};
  const auto fill = [](SinCosTable::Lanes& lanes, double x) {
    std::fill(std::begin(lanes), std::end(lanes), x);
  };
  fill(t.two_over_pi, kTwoOverPi);
  fill(t.round_to_integer, kRoundToInteger);
  fill(t.half_pi[0], kHalfPi1);
  fill(t.half_pi[1], kHalfPi2);
  fill(t.half_pi[2], kHalfPi3);
  fill(t.rare, 0x1p-19);
  fill(t.one, 1);
  fill(t.half, 0.5);
  for (std::size_t k = 0; k < 6; ++k) {
    fill(t.sin[k], kSin[k]);
    fill(t.cos[k], kCos[k]);
  }
  fill(t.no_sign, std::bit_cast<double>(~std::uint64_t(0) >> 1));
  fill(t.bit_one, std::bit_cast<double>(std::uint64_t(1)));
  fill(t.bit_two, std::bit_cast<double>(std::uint64_t(2)));
  return t;
}

bool fits(const Chain& chain) {
  if (!chain.planar || !chain.serial || chain.has_mimic) return false;
  if (chain.nv < 1 || chain.nv > PlanarKernel::kMaxJoints) return false;
  const auto& bodies = chain.planar->bodies;
  for (std::size_t i = 1; i < bodies.size(); ++i) {
    if (bodies[i].kind != JointKind::revolute || bodies[i].parent + 1 != int(i)) return false;
  }
  return true;
}

}  // namespace

constinit const SinCosTable kSinCosTable = make_sin_cos_table();

void sin_cos_of_each(const double* x, int n, double* s, double* c) {
  for (int i = 0; i < n; ++i) {
    const auto [sin, cos] = sin_cos(x[i]);
    s[i] = sin;
    c[i] = cos;
  }
}

PlanarKernel planar_kernel_of(const Chain& chain) {
  PlanarKernel kernel;
  if (!fits(chain)) return kernel;
  const Plane& plane = chain.planar->plane;
  const auto& bodies = chain.planar->bodies;
  const auto n = std::size_t(chain.nv);
  bool along_x = true, turned = false;
  double carried = 0;  // mass behind the link
  for (std::size_t i = n; i-- > 0;) {
    const PlanarBody& body = bodies[i + 1];
    const Eigen::Vector2d l = i + 1 < n ? bodies[i + 2].p_PJ : Eigen::Vector2d::Zero();
    const Eigen::Vector2d h = body.mass * body.com + l * carried;
    kernel.A_ii[i] = body.inertia + body.mass * body.com.squaredNorm() + l.squaredNorm() * carried;
    kernel.l_x[i] = l.x(), kernel.l_y[i] = l.y();
    kernel.h_x[i] = h.x(), kernel.h_y[i] = h.y();
    kernel.sign[i] = body.sign;
    carried += body.mass;
    along_x &= l.y() == 0 && h.y() == 0;
    turned |= body.sign != 1;
  }
  kernel.A_11_inv = 1 / kernel.A_ii[0];
  kernel.A_11_A_22 = kernel.A_ii[0] * kernel.A_ii[1];
  kernel.g_x.fill(chain.gravity.dot(plane.ex));
  kernel.g_y.fill(chain.gravity.dot(plane.ey));
  kernel.run = __builtin_cpu_supports("avx2") ? planar_kernel_for_avx2(int(n), along_x, turned)
                                              : planar_kernel_for_any_processor(int(n), along_x, turned);
  return kernel;
}

}  // namespace chainreel
