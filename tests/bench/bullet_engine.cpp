// Bullet's multi-body, in double precision. Its links have their frames at the centre of mass along the
// principal axes (C); quaternions named rotParentToThis turn vectors of the parent's frame into this frame's:
//   R_CP = R_BC^T R_PJ^T R_PC.
// Gravity is a force on each link, as Bullet's own world applies it; it stays until it is cleared.
#include <BulletDynamics/Featherstone/btMultiBody.h>

#include <Eigen/Eigenvalues>

#include "bench/engines.hpp"

namespace chainreel::bench {
namespace {

btVector3 bullet(const Eigen::Vector3d& v) {
  return {v.x(), v.y(), v.z()};
}

struct PrincipalFrame {
  Eigen::Matrix3d R_BC = Eigen::Matrix3d::Identity();
  Eigen::Vector3d com = Eigen::Vector3d::Zero();      // in B
  Eigen::Vector3d moments = Eigen::Vector3d::Zero();  // about the axes of C
};

PrincipalFrame principal_frame_of(const Inertia& inertia) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(inertia.about_com);
  PrincipalFrame frame{solver.eigenvectors(), inertia.com, solver.eigenvalues()};
  if (frame.R_BC.determinant() < 0) frame.R_BC.col(0) *= -1;
  return frame;
}

}  // namespace

struct BulletEngine::Body {
  explicit Body(int count) : multibody(count, 0, btVector3(0, 0, 0), true, false), links(count) {}

  btMultiBody multibody;
  int links;
  btAlignedObjectArray<btScalar> scratch_r;
  btAlignedObjectArray<btVector3> scratch_v;
  btAlignedObjectArray<btMatrix3x3> scratch_m;
};

EngineInfo BulletEngine::info() {
  const std::string version = std::to_string(BT_BULLET_VERSION);
  return {"Bullet", version.substr(0, 1) + "." + version.substr(1) + ", double",
          "btMultiBody::computeAccelerationsArticulatedBodyAlgorithmMultiDof",
          "the same and stepPositionsMultiDof"};
}

BulletEngine::BulletEngine(const Chain& chain) : body_(std::make_unique<Body>(int(chain.bodies.size()) - 1)) {
  btMultiBody& multibody = body_->multibody;
  std::vector<PrincipalFrame> frames = {{}};
  for (int i = 1; i <= body_->links; ++i) {
    const chainreel::Body& body = chain.bodies[std::size_t(i)];
    const PrincipalFrame& parent = frames[std::size_t(body.parent)];
    const PrincipalFrame frame = principal_frame_of(body.inertia);
    const Eigen::Quaterniond R_CP(
        Eigen::Matrix3d(frame.R_BC.transpose() * body.joint.X_PJ.linear().transpose() * parent.R_BC));
    multibody.setupRevolute(i - 1, body.inertia.mass, bullet(frame.moments), body.parent - 1,
                            btQuaternion(R_CP.x(), R_CP.y(), R_CP.z(), R_CP.w()),
                            bullet(frame.R_BC.transpose() * body.joint.axis),
                            bullet(parent.R_BC.transpose() * (body.joint.X_PJ.translation() - parent.com)),
                            bullet(frame.R_BC.transpose() * frame.com), true);
    frames.push_back(frame);
  }
  multibody.finalizeMultiDof();
  multibody.setLinearDamping(0);
  multibody.setAngularDamping(0);
  multibody.useGlobalVelocities(false);
  multibody.setMaxCoordinateVelocity(1e9);
  for (int i = 1; i <= body_->links; ++i)
    multibody.addLinkForce(i - 1, bullet(chain.gravity * chain.bodies[std::size_t(i)].inertia.mass));
}

BulletEngine::~BulletEngine() = default;

void BulletEngine::set(const test::State& state) {
  for (int i = 0; i < body_->links; ++i) {
    const auto k = std::size_t(i);
    body_->multibody.setJointPosMultiDof(i, &state.q[k]);
    body_->multibody.setJointVelMultiDof(i, &state.qd[k]);
    body_->multibody.getJointTorqueMultiDof(i)[0] = state.tau[k];
  }
}

void BulletEngine::forward_dynamics() {
  // With a step of 0 the velocities stay; the accelerations are left in scratch_r.
  body_->multibody.computeAccelerationsArticulatedBodyAlgorithmMultiDof(
      0, body_->scratch_r, body_->scratch_v, body_->scratch_m, false, false, false);
}

void BulletEngine::step(double h) {
  body_->multibody.computeAccelerationsArticulatedBodyAlgorithmMultiDof(
      h, body_->scratch_r, body_->scratch_v, body_->scratch_m, false, false, false);
  body_->multibody.stepPositionsMultiDof(h);
}

std::vector<double> BulletEngine::qdd() const {
  // Behind a number a joint: six of the base, then the joints'.
  const btScalar* output = &body_->scratch_r[body_->links];
  return {output + 6, output + 6 + body_->links};
}

std::vector<double> BulletEngine::q() const {
  std::vector<double> q;
  for (int i = 0; i < body_->links; ++i) q.push_back(body_->multibody.getJointPos(i));
  return q;
}

std::vector<double> BulletEngine::qd() const {
  std::vector<double> qd;
  for (int i = 0; i < body_->links; ++i) qd.push_back(body_->multibody.getJointVel(i));
  return qd;
}

}  // namespace chainreel::bench
