#include <dart/config.hpp>
#include <dart/dynamics/BodyNode.hpp>
#include <dart/dynamics/RevoluteJoint.hpp>
#include <dart/dynamics/Skeleton.hpp>

#include "bench/engines.hpp"
#include "peers/mjcf.hpp"

namespace chainreel::bench {

namespace dynamics = dart::dynamics;

struct DartEngine::Body {
  dynamics::SkeletonPtr skeleton = dynamics::Skeleton::create();
  Eigen::VectorXd vector;  // a state's numbers as DART takes them
};

EngineInfo DartEngine::info() {
  return {"DART", DART_VERSION, "Skeleton::computeForwardDynamics",
          "the same, integrateVelocities and integratePositions"};
}

DartEngine::DartEngine(const Chain& chain) : body_(std::make_unique<Body>()) {
  dynamics::Skeleton& skeleton = *body_->skeleton;
  skeleton.disableSelfCollisionCheck();
  skeleton.setGravity(chain.gravity);
  for (std::size_t i = 1; i < chain.bodies.size(); ++i) {
    const chainreel::Body& body = chain.bodies[i];
    dynamics::RevoluteJoint::Properties joint;
    joint.mName = "j" + std::to_string(i);
    joint.mAxis = body.joint.axis;
    joint.mT_ParentBodyToJoint = body.joint.X_PJ;
    // DART takes no moments of zero either.
    const Eigen::Matrix3d moments =
        body.inertia.about_com + Eigen::Matrix3d(peers::kLeast * Eigen::Matrix3d::Identity());
    dynamics::BodyNode::Properties node;
    node.mName = "b" + std::to_string(i);
    node.mInertia = dynamics::Inertia(body.inertia.mass, body.inertia.com, moments);
    dynamics::BodyNode* parent =
        body.parent == 0 ? nullptr : skeleton.getBodyNode(std::size_t(body.parent) - 1);
    skeleton.createJointAndBodyNodePair<dynamics::RevoluteJoint>(parent, joint, node);
  }
  body_->vector.resize(chain.nv);
}

DartEngine::~DartEngine() = default;

void DartEngine::set(const test::State& state) {
  const auto as_vector = [this](const std::vector<double>& numbers) -> const Eigen::VectorXd& {
    for (std::size_t i = 0; i < numbers.size(); ++i) body_->vector[Eigen::Index(i)] = numbers[i];
    return body_->vector;
  };
  body_->skeleton->setPositions(as_vector(state.q));
  body_->skeleton->setVelocities(as_vector(state.qd));
  body_->skeleton->setForces(as_vector(state.tau));
}

void DartEngine::forward_dynamics() {
  body_->skeleton->computeForwardDynamics();
}

void DartEngine::step(double h) {
  body_->skeleton->computeForwardDynamics();
  body_->skeleton->integrateVelocities(h);
  body_->skeleton->integratePositions(h);
}

namespace {

std::vector<double> as_numbers(const Eigen::VectorXd& v) {
  return {v.data(), v.data() + v.size()};
}

}  // namespace

std::vector<double> DartEngine::qdd() const {
  return as_numbers(body_->skeleton->getAccelerations());
}

std::vector<double> DartEngine::q() const {
  return as_numbers(body_->skeleton->getPositions());
}

std::vector<double> DartEngine::qd() const {
  return as_numbers(body_->skeleton->getVelocities());
}

}  // namespace chainreel::bench
