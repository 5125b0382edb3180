#include "peers/mujoco_chain.hpp"

#include <algorithm>
#include <array>
#include <cstring>
#include <stdexcept>

#include "peers/mjcf.hpp"

namespace chainreel::peers {
namespace {

using Eigen::Map;
using Eigen::Matrix3d;
using Eigen::Quaterniond;
using Eigen::Vector3d;

std::unique_ptr<mjModel, MujocoDeleter> load(const std::string& mjcf) {
  // A file in memory: mjVFS is megabytes, too much for the stack.
  const auto files = std::make_unique<mjVFS>();
  mj_defaultVFS(files.get());
  const int slot = mj_makeEmptyFileVFS(files.get(), "chain.xml", int(mjcf.size()));
  if (slot < 0) throw std::runtime_error("MuJoCo takes no file of " + std::to_string(mjcf.size()) + " bytes");
  std::memcpy(files->filedata[slot], mjcf.data(), mjcf.size());

  std::array<char, 1000> words{};
  std::unique_ptr<mjModel, MujocoDeleter> model(
      mj_loadXML("chain.xml", files.get(), words.data(), int(words.size())));
  mj_deleteVFS(files.get());
  // A model that was loaded with a warning says so in the same place.
  if (!model || words.front() != '\0') throw std::runtime_error(std::string("MuJoCo: ") + words.data());
  return model;
}

}  // namespace

MujocoChain::MujocoChain(const Chain& chain, const std::string& equality)
    : nv_(std::size_t(chain.nv)), model_(load(mjcf_of(chain, equality))) {
  data_.reset(mj_makeData(model_.get()));
  for (std::size_t i = 1; i < chain.bodies.size(); ++i) {
    const Joint& joint = chain.bodies[i].joint;
    const int id = mj_name2id(model_.get(), mjOBJ_JOINT, ("j" + std::to_string(i)).c_str());
    if (id < 0) throw std::runtime_error("MuJoCo lost joint " + std::to_string(i));
    joints_.push_back({joint.kind == JointKind::floating, joint.X_PJ, std::size_t(joint.q_index),
                       std::size_t(joint.v_index), std::size_t(model_->jnt_qposadr[id]),
                       std::size_t(model_->jnt_dofadr[id])});
  }
}

void MujocoChain::set_position(std::span<const double> q) {
  for (const JointPlace& joint : joints_) {
    double* to = data_->qpos + joint.mujoco_q;
    const double* from = q.data() + joint.q;
    if (!joint.floating) {
      to[0] = from[0];
      continue;
    }
    const Vector3d p_WB = joint.X_WJ * Map<const Vector3d>(from);
    const Quaterniond R_WB =
        Quaterniond(joint.X_WJ.linear()) * Quaterniond(Map<const Eigen::Vector4d>(from + 3));
    Map<Vector3d>{to} = p_WB;
    Map<Eigen::Vector4d>(to + 3) = Eigen::Vector4d(R_WB.w(), R_WB.x(), R_WB.y(), R_WB.z());
  }
}

Matrix3d MujocoChain::turn(std::size_t joint) const {
  const double* p = data_->qpos + joints_[joint].mujoco_q + 3;
  return Quaterniond(p[0], p[1], p[2], p[3]).toRotationMatrix();
}

std::vector<double> MujocoChain::qdd_of(std::span<const double> q, std::span<const double> qd,
                                        std::span<const double> tau) {
  set_position(q);
  for (std::size_t k = 0; k < joints_.size(); ++k) {
    const JointPlace& joint = joints_[k];
    double* velocity = data_->qvel + joint.mujoco_v;
    double* force = data_->qfrc_applied + joint.mujoco_v;
    const std::size_t freedoms = joint.floating ? 6 : 1;
    std::copy_n(qd.data() + joint.v, freedoms, velocity);
    std::copy_n(tau.data() + joint.v, freedoms, force);
    if (!joint.floating) continue;
    const Matrix3d R = turn(k);
    Map<Vector3d>{velocity} = R * Map<const Vector3d>(qd.data() + joint.v);
    Map<Vector3d>{force} = R * Map<const Vector3d>(tau.data() + joint.v);
  }
  mj_forward(model_.get(), data_.get());

  std::vector<double> qdd(nv_);
  for (std::size_t k = 0; k < joints_.size(); ++k) {
    const JointPlace& joint = joints_[k];
    std::copy_n(data_->qacc + joint.mujoco_v, joint.floating ? 6 : 1, qdd.data() + joint.v);
    if (!joint.floating) continue;
    const Map<const Vector3d> v(qd.data() + joint.v), w(qd.data() + joint.v + 3);
    Map<Vector3d>(qdd.data() + joint.v) =
        turn(k).transpose() * Map<const Vector3d>(data_->qacc + joint.mujoco_v) - w.cross(v);
  }
  return qdd;
}

Eigen::MatrixXd MujocoChain::mass_matrix_of(std::span<const double> q) {
  set_position(q);
  mj_fwdPosition(model_.get(), data_.get());
  const auto n = Eigen::Index(nv_);
  Eigen::MatrixXd theirs(n, n);
  mj_fullM(model_.get(), theirs.data(), data_->qM);  // symmetric: row by row or column by column

  // T, also from our order of the freedoms to theirs.
  Eigen::MatrixXd T = Eigen::MatrixXd::Zero(n, n);
  for (std::size_t k = 0; k < joints_.size(); ++k) {
    const auto row = Eigen::Index(joints_[k].mujoco_v), column = Eigen::Index(joints_[k].v);
    if (!joints_[k].floating) {
      T(row, column) = 1;
      continue;
    }
    T.block<3, 3>(row, column) = turn(k);
    T.block<3, 3>(row + 3, column + 3).setIdentity();
  }
  return T.transpose() * theirs * T;
}

std::string MujocoChain::warnings() const {
  std::string text;
  for (int i = 0; i < mjNWARNING; ++i)
    if (data_->warning[i].number > 0)
      text += std::string(mju_warningText(i, size_t(data_->warning[i].lastinfo))) + "; ";
  return text;
}

}  // namespace chainreel::peers
