// Everything that an algorithm writes. Sized for one chain when made; no algorithm allocates afterwards,
// except where a dense matrix is asked for the first time. Masses, lengths and gravity are folded into it: a
// chain that changes needs a new one.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <memory>
#include <span>
#include <vector>

#include "model/chain.hpp"

namespace chainreel {

using ConstVec = std::span<const double>;
using Vec = std::span<double>;

struct Workspace {
  explicit Workspace(const Chain& chain);
  ~Workspace();
  Workspace(Workspace&&) noexcept;
  Workspace& operator=(Workspace&&) noexcept;

  // Results, by the algorithm that writes them.
  std::vector<double> qdd;                  // nv; compute_forward_dynamics, compute_aba
  std::vector<double> tau;                  // nv; compute_inverse_dynamics
  std::vector<double> nle;                  // nv; compute_nle: C qd + tau_g
  std::vector<double> tau_g;                // nv; compute_gravity_torque
  std::vector<double> tau_f;                // nv; compute_friction
  Eigen::MatrixXd M;                        // nv x nv, symmetric, both halves; compute_mass_matrix
  Eigen::MatrixXd J;                        // rows x nv; compute_jacobian
  Eigen::VectorXd Jd_qd;                    // rows; compute_jacobian_rate
  std::vector<Eigen::Isometry3d> X_WB;      // per body; compute_kinematics
  std::vector<Eigen::Vector3d> v_WB, w_WB;  // per body: velocity of its origin and angular velocity, in W

  // Throws Error (bad input) unless the workspace is one of a chain like this, q has nq numbers, and each of the others nv.
  template <class... Rates>
  void require_sizes(const Chain& chain, ConstVec q, const Rates&... rates) const {
    const std::size_t nv = std::size_t(chain.nv);
    if (q.size() != std::size_t(chain.nq) || qdd.size() != nv || ((rates.size() != nv) || ...)) [[unlikely]] refuse_sizes(chain);
  }

  struct Scratch;  // planar or spatial arrays of the recursions
  std::unique_ptr<Scratch> scratch;

 private:
  [[noreturn]] void refuse_sizes(const Chain& chain) const;
};

}  // namespace chainreel
