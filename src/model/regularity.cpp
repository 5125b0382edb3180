#include "model/regularity.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/dense.hpp"
#include "core/format.hpp"
#include "core/scalar.hpp"

namespace chainreel {
namespace {

using Matrix6 = Eigen::Matrix<double, 6, 6>;
using Vector6 = Eigen::Matrix<double, 6, 1>;

// A pivot is the small difference of what the bodies add and what the joints behind give way to; below this
// part of the sum it is round-off.
constexpr double kPivotFraction = 1e-10;
// A radius of gyration below this is round-off in the placement of a point mass on its axis, m.
constexpr double kLeastRadius = 1e-9;
constexpr int kPoses = 3;

// Spread over the unit interval without any symmetry (multiples of the golden ratio).
double generic_value(std::size_t body, int pose) {
  const double x = 0.6180339887498949 * double(body) + 0.2760393485 * double(pose + 1);
  return x - std::floor(x);
}

Eigen::Matrix3d cross_matrix(const Eigen::Vector3d& v) {
  Eigen::Matrix3d m;
  m << 0, -v[2], v[1], v[2], 0, -v[0], -v[1], v[0], 0;
  return m;
}

Eigen::Matrix3d rotation_about(const Eigen::Vector3d& axis, double angle) {
  const auto [s, c] = sin_cos(angle);
  return c * Eigen::Matrix3d::Identity() + s * cross_matrix(axis) + (1 - c) * axis * axis.transpose();
}

// Pose of a body in its parent at a generic joint value.
Eigen::Isometry3d generic_pose(const Joint& joint, std::size_t body, int pose) {
  const double value = 6.0 * generic_value(body, pose) - 3.0;
  Eigen::Isometry3d X = joint.X_PJ;
  if (joint.kind == JointKind::revolute) X.linear() = X.linear() * rotation_about(joint.axis, value);
  if (joint.kind == JointKind::prismatic) X.translation() += X.linear() * joint.axis * value;
  return X;
}

// Spatial inertia about the body's origin, angular part first.
Matrix6 spatial_inertia(const Inertia& inertia) {
  const Eigen::Matrix3d C = cross_matrix(inertia.com);
  Matrix6 I;
  I << inertia.about_com + inertia.mass * C * C.transpose(), inertia.mass * C,  //
      inertia.mass * C.transpose(), inertia.mass * Eigen::Matrix3d::Identity();
  return I;
}

// Motion of the parent's frame seen in the body's: v_B = X v_P.
Matrix6 motion_transform(const Eigen::Isometry3d& X_PB) {
  const Eigen::Matrix3d R = X_PB.linear().transpose();
  Matrix6 X;
  X << R, Eigen::Matrix3d::Zero(), -R * cross_matrix(X_PB.translation()), R;
  return X;
}

struct Articulated {
  Matrix6 inertia;  // I^A
  Matrix6 sum;      // the same without what the joints behind give way to: the scale of the round-off in I^A
  double mass;      // of everything behind the joint, kg
};

// Takes the joint's freedom out of I^A. False where nothing resists it.
bool release_joint(const Joint& joint, Articulated& body) {
  if (joint.kind == JointKind::floating) {
    const Vector6 scale = body.sum.diagonal().cwiseSqrt();
    if (!(scale.minCoeff() > kLeastRadius * std::sqrt(body.mass))) return false;
    const Matrix6 unit = scale.cwiseInverse().asDiagonal() * body.inertia * scale.cwiseInverse().asDiagonal();
    const bool is_regular = unit.ldlt().vectorD().minCoeff() > kPivotFraction;
    if (is_regular) body.inertia.setZero();
    return is_regular;
  }
  const bool turns = joint.kind == JointKind::revolute;
  Vector6 S = Vector6::Zero();
  S.segment<3>(turns ? 0 : 3) = joint.axis;
  const Vector6 U = body.inertia * S;
  const double D = S.dot(U);
  const double least = turns ? kLeastRadius * kLeastRadius * body.mass : 0;
  if (!(D > kPivotFraction * S.dot(body.sum * S) && D > least)) return false;
  body.inertia -= U * U.transpose() / D;
  return true;
}

std::string vector_text(const Eigen::Vector3d& v) {
  std::string text;
  for (int i = 0; i < 3; ++i) text += (i == 0 ? "" : ", ") + format_significant(std::abs(v[i]) < 1e-9 ? 0 : v[i], 3);
  return "(" + text + ")";
}

std::string in_one_sentence(const std::vector<std::string>& words) {
  std::string text;
  for (std::size_t i = 0; i < words.size(); ++i)
    text += (i == 0 ? "" : i + 1 < words.size() ? ", " : " and ") + words[i];
  return text;
}

// For a floating body: the axes of its frame that nothing resists, else the one motion that its inertia leaves free.
void describe_floating(const Articulated& body, Unresisted& result) {
  std::vector<std::string> turns, slides;
  Vector6 scale = Vector6::Ones();
  for (int k = 0; k < 6; ++k) {
    const double least = k < 3 ? kLeastRadius * kLeastRadius * body.mass : 0, sum = body.sum(k, k);
    if (sum > least) scale[k] = std::sqrt(sum);
    if (body.inertia(k, k) > std::max(kPivotFraction * sum, least)) continue;
    result.behind |= sum > least;
    (k < 3 ? turns : slides).push_back(std::string(1, "xyz"[k % 3]));
  }
  if (turns.empty() && slides.empty()) {
    const Matrix6 unit = scale.cwiseInverse().asDiagonal() * body.inertia * scale.cwiseInverse().asDiagonal();
    Vector6 twist = scale.cwiseInverse().asDiagonal() * eigen_of_symmetric(unit).vectors.col(0);
    int largest = 0;
    twist.cwiseAbs().maxCoeff(&largest);
    if (twist[largest] < 0) twist = -twist;  // an eigenvector's sign is free
    const Eigen::Vector3d w = twist.head<3>(), v = twist.tail<3>();
    if (w.norm() > 1e-6 * v.norm()) {
      turns.push_back("the axis " + vector_text(w.normalized()) + " through " +
                      vector_text(w.cross(v) / w.squaredNorm()));
    } else {
      slides.push_back(vector_text(v.normalized()));
    }
    result.behind = (body.sum - body.inertia).norm() > kPivotFraction * body.sum.norm();
  }
  std::vector<std::string> motions, remedies;
  if (!turns.empty()) motions.push_back("turns about " + in_one_sentence(turns));
  if (!slides.empty()) motions.push_back("moves along " + in_one_sentence(slides));
  if (!slides.empty()) remedies.push_back("a mass");
  if (!turns.empty()) remedies.push_back("an inertia about " + in_one_sentence(turns));
  result.motion = in_one_sentence(motions);
  result.remedy = in_one_sentence(remedies);
}

Unresisted describe(const Joint& joint, int index, const Articulated& body) {
  Unresisted result{index, "", false, ""};
  if (joint.kind == JointKind::floating) {
    describe_floating(body, result);
    return result;
  }
  const bool turns = joint.kind == JointKind::revolute;
  const Eigen::Matrix3d sum = turns ? body.sum.topLeftCorner<3, 3>() : body.sum.bottomRightCorner<3, 3>();
  result.motion = turns ? "turns" : "slides";
  result.behind = joint.axis.dot(sum * joint.axis) > (turns ? kLeastRadius * kLeastRadius * body.mass : 0);
  result.remedy = turns ? "an inertia about its axis " + vector_text(joint.axis) + ", or a mass off it" : "a mass";
  return result;
}

bool is_mimic(const Chain& chain, const Joint& joint) {
  return joint.kind != JointKind::floating &&
         chain.coordinate_names[std::size_t(joint.v_index)] != joint.name;
}

std::optional<Unresisted> unresisted_at(const Chain& chain, int pose) {
  const std::size_t n = chain.bodies.size();
  std::vector<Articulated> bodies(n);
  for (std::size_t i = 1; i < n; ++i) {
    const Matrix6 I = spatial_inertia(chain.bodies[i].inertia);
    bodies[i] = {I, I, chain.bodies[i].inertia.mass};
  }
  for (std::size_t i = n - 1; i > 0; --i) {
    const Body& body = chain.bodies[i];
    if (!is_mimic(chain, body.joint) && !release_joint(body.joint, bodies[i]))
      return describe(body.joint, int(i), bodies[i]);
    if (body.parent == 0) continue;
    const Matrix6 X = motion_transform(generic_pose(body.joint, i, pose));
    Articulated& parent = bodies[std::size_t(body.parent)];
    parent.inertia += X.transpose() * bodies[i].inertia * X;
    parent.sum += X.transpose() * bodies[i].sum * X;
    parent.mass += bodies[i].mass;
  }
  return std::nullopt;
}

}  // namespace

std::optional<Unresisted> unresisted_motion(const Chain& chain) {
  std::optional<Unresisted> found;
  for (int pose = 0; pose < kPoses; ++pose) {
    found = unresisted_at(chain, pose);
    if (!found) break;
  }
  return found;
}

}  // namespace chainreel
