// A chain inside MuJoCo, asked and answering in our coordinates.
//
// A floating joint's pose is stored as x y z qx qy qz qw from the joint's frame here, x y z qw qx qy qz from
// the world there. Its velocity is the twist in the body's axes here (v, w); there the linear part is along
// the world's axes, V = R v, the angular part is the same. So V' = R (v' + w x v), and forces, dual to
// velocities, turn the same way: F = R f.
//   velocity_mujoco = T velocity,  T = diag(R, 1):  M = T^T M_mujoco T.
#pragma once

#include <mujoco/mujoco.h>

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "model/chain.hpp"

namespace chainreel::peers {

struct MujocoDeleter {
  void operator()(mjModel* model) const { mj_deleteModel(model); }
  void operator()(mjData* data) const { mj_deleteData(data); }
};

class MujocoChain {
 public:
  // Throws std::runtime_error with MuJoCo's words where it refuses the model or warns about it.
  // `equality` as in mjcf.hpp.
  explicit MujocoChain(const Chain& chain, const std::string& equality = "");

  // Accelerations under the given joint torques.
  std::vector<double> qdd_of(std::span<const double> q, std::span<const double> qd,
                             std::span<const double> tau);
  Eigen::MatrixXd mass_matrix_of(std::span<const double> q);
  // Everything that MuJoCo has warned about during the calls, "" where it was content.
  std::string warnings() const;

  const mjModel* model() const { return model_.get(); }
  mjData* data() { return data_.get(); }
  void set_position(std::span<const double> q);
  void set_step(double h) { model_->opt.timestep = h; }
  // Where a `connect` holds its first body's point, and that point: along the second body's axes and its own.
  void connect(int equality, const Eigen::Vector3d& in_first, const Eigen::Vector3d& in_second) {
    mjtNum* const data = model_->eq_data + equality * mjNEQDATA;
    for (int k = 0; k < 3; ++k) data[k] = in_first[k], data[3 + k] = in_second[k];
  }
  void use_rk4() { model_->opt.integrator = mjINT_RK4; }

 private:
  Eigen::Matrix3d turn(std::size_t joint) const;  // of a floating joint, as set

  struct JointPlace {
    bool floating = false;
    Eigen::Isometry3d X_WJ = Eigen::Isometry3d::Identity();  // of a floating joint
    std::size_t q = 0, v = 0;                                // ours
    std::size_t mujoco_q = 0, mujoco_v = 0;                  // theirs
  };
  std::vector<JointPlace> joints_;
  std::size_t nv_ = 0;
  std::unique_ptr<mjModel, MujocoDeleter> model_;
  std::unique_ptr<mjData, MujocoDeleter> data_;
};

}  // namespace chainreel::peers
