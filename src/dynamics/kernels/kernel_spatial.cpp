#include "dynamics/kernels/kernel_spatial.hpp"

namespace chainreel {

namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

bool fits_spatial(const Chain& chain) {
  if (chain.has_mimic || chain.has_floating) return false;
  if (chain.nv < 1 || chain.nv > SpatialKernel::kMaxJoints) return false;
  for (std::size_t i = 1; i < chain.bodies.size(); ++i) {
    if (chain.bodies[i].joint.q_index + 1 != int(i)) return false;
  }
  return true;
}

SpatialKernel::Lanes all(double x) {
  return {x, x, x, x};
}

SpatialKernel::Link link_of(const Chain& chain, std::size_t i, const Matrix3d& Q_parent, const Matrix3d& Q) {
  const Body& body = chain.bodies[i];
  const Matrix3d T = Q_parent.transpose() * body.joint.X_PJ.linear() * Q;
  const Vector3d p = Q_parent.transpose() * body.joint.X_PJ.translation();
  const Vector3d com = Q.transpose() * body.inertia.com;
  const Matrix3d I = Q.transpose() * body.inertia.about_com * Q;
  SpatialKernel::Link link;
  for (int r = 0; r < 3; ++r) {
    for (int c = 0; c < 3; ++c) {
      link.T[c][r] = all(T(r, c));
      link.I[c][r] = all(I(r, c));
    }
    link.p[r] = all(p[r]);
    link.com[r] = all(com[r]);
  }
  link.mass = all(body.inertia.mass);
  link.parent = body.parent - 1;
  link.slides = body.joint.kind == JointKind::prismatic;
  return link;
}

SpatialKernel::RowMask mask_of(const std::vector<SpatialKernel::Link>& links, int i) {
  SpatialKernel::RowMask mask{};
  mask.lanes[0] = ~std::uint64_t(0);
  for (int j = i; j >= 0; j = links[std::size_t(j)].parent) mask.lanes[j + 1] = ~std::uint64_t(0);
  return mask;
}

}  // namespace

// Where the axis is one of the body's own, without round-off.
Matrix3d kernel_axes(const Vector3d& axis) {
  Eigen::Index largest = 0;
  axis.cwiseAbs().maxCoeff(&largest);
  const Vector3d other = Vector3d::Unit((largest + 1) % 3);
  Matrix3d Q;
  Q.col(2) = axis;
  Q.col(0) = (other - axis * axis.dot(other)).normalized();
  Q.col(1) = Q.col(2).cross(Q.col(0));
  return Q;
}

SpatialKernel spatial_kernel_of(const Chain& chain) {
  SpatialKernel kernel;
  if (!fits_spatial(chain)) return kernel;
  kernel.joints = chain.nv;
  kernel.serial = chain.serial;
  kernel.base_acceleration = {-chain.gravity.x(), -chain.gravity.y(), -chain.gravity.z(), 0};
  std::vector<Matrix3d> Q{Matrix3d::Identity()};
  for (std::size_t i = 1; i < chain.bodies.size(); ++i) {
    Q.push_back(kernel_axes(chain.bodies[i].joint.axis));
    kernel.links.push_back(link_of(chain, i, Q[std::size_t(chain.bodies[i].parent)], Q.back()));
    kernel.serial &= chain.bodies[i].parent + 1 == int(i);
  }
  for (int i = 0; i < kernel.joints; ++i) kernel.masks.push_back(mask_of(kernel.links, i));
  return kernel;
}

}  // namespace chainreel
