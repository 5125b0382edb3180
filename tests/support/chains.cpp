#include "support/chains.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "model/planar.hpp"

namespace chainreel::test {

using Eigen::Isometry3d;
using Eigen::Matrix3d;
using Eigen::Vector3d;

Vector3d Random::unit_vector() {
  for (;;) {
    const Vector3d v = vector(1);
    if (v.norm() > 0.1 && v.norm() < 1) return v.normalized();
  }
}

Matrix3d Random::rotation() {
  return Eigen::AngleAxisd(between(-3, 3), unit_vector()).toRotationMatrix();
}

Isometry3d Random::pose(double size) {
  Isometry3d X = Isometry3d::Identity();
  X.linear() = rotation();
  X.translation() = vector(size);
  return X;
}

namespace {

Isometry3d shifted(double x, double y = 0, double z = 0) {
  return Isometry3d(Eigen::Translation3d(x, y, z));
}

Body body_of(int parent, JointKind kind, const Vector3d& axis, const Isometry3d& X_PJ) {
  Body body;
  body.parent = parent;
  body.joint.kind = kind;
  body.joint.axis = axis;
  body.joint.X_PJ = X_PJ;
  return body;
}

// Of a solid that could exist: three masses on the axes of a random frame.
Inertia random_inertia(Random& random) {
  Inertia inertia;
  inertia.mass = random.between(0.2, 2);
  inertia.com = random.vector(0.3);
  const Vector3d square(random.between(0.005, 0.05), random.between(0.005, 0.05),
                        random.between(0.005, 0.05));
  const Matrix3d R = random.rotation();
  const Vector3d moments = (Vector3d::Constant(square.sum()) - square) * inertia.mass;
  inertia.about_com = R * moments.asDiagonal() * R.transpose();
  return inertia;
}

JointKind random_kind(Random& random, const TreeOptions& options, bool first) {
  if (first && options.floating_base) return JointKind::floating;
  const double x = random.between(0, 1);
  if (x < options.floating) return JointKind::floating;
  return x < options.floating + options.prismatic ? JointKind::prismatic : JointKind::revolute;
}

// Some joints follow an earlier one of the same kind; some bodies that carry others lose their inertia.
void add_extras(Chain& chain, Random& random, const TreeOptions& options, std::vector<int>& leader) {
  const int n = int(chain.bodies.size());
  leader.assign(std::size_t(n), 0);
  for (int i = 2; i < n; ++i) {
    Joint& joint = chain.bodies[std::size_t(i)].joint;
    if (joint.kind == JointKind::floating || random.between(0, 1) >= options.mimic) continue;
    const int other = 1 + random.below(i - 1);
    if (chain.bodies[std::size_t(other)].joint.kind != joint.kind || leader[std::size_t(other)] != 0)
      continue;
    leader[std::size_t(i)] = other;
    joint.ratio = random.between(0.3, 2) * (random.below(2) == 0 ? 1 : -1);
    joint.offset = random.between(-1, 1);
  }
  // A body without inertia is moved by what it carries: never two of them in a row, or too little is left to
  // move.
  for (int i = 1; i < n; ++i) {
    Body& body = chain.bodies[std::size_t(i)];
    const bool carries = std::any_of(
        chain.bodies.begin() + i + 1, chain.bodies.end(),
        [i](const Body& other) { return other.parent == i && other.joint.kind != JointKind::floating; });
    const bool on_massless = body.parent > 0 && chain.bodies[std::size_t(body.parent)].inertia.mass == 0;
    if (!carries || on_massless || body.joint.kind == JointKind::floating) continue;
    if (random.between(0, 1) < options.massless) body.inertia = {};
  }
}

void number_coordinates(Chain& chain, const std::vector<int>& leader) {
  chain.nq = chain.nv = 0;
  chain.coordinate_names.clear();
  for (std::size_t i = 1; i < chain.bodies.size(); ++i) {
    Joint& joint = chain.bodies[i].joint;
    if (joint.name.empty()) joint.name = "j" + std::to_string(i);
    if (leader[i] != 0) continue;
    const bool floating = joint.kind == JointKind::floating;
    joint.q_index = chain.nq;
    joint.v_index = chain.nv;
    chain.nq += floating ? 7 : 1;
    chain.nv += floating ? 6 : 1;
    for (int k = 0; k < (floating ? 6 : 1); ++k) chain.coordinate_names.push_back(joint.name);
  }
  for (std::size_t i = 1; i < chain.bodies.size(); ++i) {
    if (leader[i] == 0) continue;
    const Joint& other = chain.bodies[std::size_t(leader[i])].joint;
    chain.bodies[i].joint.q_index = other.q_index;
    chain.bodies[i].joint.v_index = other.v_index;
  }
}

void set_flags_and_frames(Chain& chain, const std::vector<int>& leader) {
  std::vector<int> children(chain.bodies.size());
  chain.has_mimic = chain.has_floating = chain.has_dissipation = false;
  chain.frames = {{"base", 0, Isometry3d::Identity()}};
  for (std::size_t i = 1; i < chain.bodies.size(); ++i) {
    Body& body = chain.bodies[i];
    if (body.name.empty()) body.name = "b" + std::to_string(i);
    ++children[std::size_t(body.parent)];
    chain.has_mimic |= leader[i] != 0;
    chain.has_floating |= body.joint.kind == JointKind::floating;
    chain.has_dissipation |= body.joint.damping != 0 || body.joint.friction != 0;
    chain.frames.push_back({body.name, int(i), Isometry3d::Identity()});
  }
  chain.serial = std::all_of(children.begin(), children.end(), [](int n) { return n <= 1; });
  const int last = int(chain.bodies.size()) - 1;
  Isometry3d tip = Isometry3d(Eigen::AngleAxisd(0.3, Vector3d(1, 2, 3).normalized()));
  tip.translation() = Vector3d(0.3, -0.2, 0.1);
  chain.frames.push_back({"tip", last, tip});
  chain.end_effector = int(chain.frames.size()) - 1;
  chain.planar = planar_form_of(chain, chain.why_algebra);
}

void finish(Chain& chain, const std::vector<int>& leader) {
  number_coordinates(chain, leader);
  set_flags_and_frames(chain, leader);
}

}  // namespace

void finish(Chain& chain) {
  finish(chain, std::vector<int>(chain.bodies.size(), 0));
}

Chain without_planar_form(Chain chain) {
  chain.planar.reset();
  return chain;
}

Chain rr_chain(const RR& rr) {
  Chain chain;
  chain.name = "rr";
  chain.gravity = {0, -rr.g, 0};
  Body first = body_of(0, JointKind::revolute, Vector3d::UnitZ(), Isometry3d::Identity());
  first.inertia = {.mass = rr.m1, .com = {rr.L1, 0, 0}};
  Body second = body_of(1, JointKind::revolute, Vector3d::UnitZ(), shifted(rr.L1));
  second.inertia = {.mass = rr.m2, .com = {rr.L2, 0, 0}};
  chain.bodies.insert(chain.bodies.end(), {first, second});
  finish(chain);
  chain.frames.back() = {"gripper", 2, shifted(rr.L2)};
  return chain;
}

Chain rrr_chain() {
  Chain chain;
  chain.name = "rrr";
  chain.gravity = {0, -9.81, 0};
  for (int i = 0; i < 3; ++i) {
    Body rod = body_of(i, JointKind::revolute, Vector3d::UnitZ(), shifted(i == 0 ? 0 : 1));
    rod.inertia.mass = 1;
    rod.inertia.com = {0.5, 0, 0};
    rod.inertia.about_com = Vector3d(0, 1.0 / 12, 1.0 / 12).asDiagonal();
    chain.bodies.push_back(rod);
  }
  finish(chain);
  chain.frames.back() = {"gripper", 3, shifted(1)};
  return chain;
}

Chain pp_chain() {
  Chain chain;
  chain.name = "pp";
  chain.gravity = {0, -9.81, 0};
  for (int i = 0; i < 2; ++i) {
    Body body = body_of(i, JointKind::prismatic, Vector3d::Unit(i), Isometry3d::Identity());
    body.inertia.mass = 1;
    chain.bodies.push_back(body);
  }
  finish(chain);
  chain.frames.back() = {"gripper", 2, Isometry3d::Identity()};
  return chain;
}

Chain planar_serial_chain(int n) {
  Chain chain;
  chain.name = "serial";
  chain.gravity = {0, -9.81, 0};
  const double L = 1.0 / n;
  for (int i = 0; i < n; ++i) {
    Body rod = body_of(i, JointKind::revolute, Vector3d::UnitZ(), shifted(i == 0 ? 0 : L));
    rod.inertia.mass = L;
    rod.inertia.com = {L / 2, 0, 0};
    rod.inertia.about_com = Vector3d(0, 1, 1).asDiagonal() * (L * L * L / 12);
    chain.bodies.push_back(rod);
  }
  finish(chain);
  return chain;
}

Chain arm_chain(std::uint64_t seed) {
  Random random(seed);
  Chain chain;
  chain.name = "arm";
  chain.gravity = {0, 0, -9.81};
  const double quarter = std::numbers::pi / 2;
  const double twist[] = {0, -quarter, quarter, quarter, -quarter, quarter, quarter};
  const Vector3d step[] = {{0, 0, 0.333},       {0, 0, 0}, {0, -0.316, 0}, {0.0825, 0, 0},
                           {-0.0825, 0.384, 0}, {0, 0, 0}, {0.088, 0, 0}};
  for (int i = 0; i < 7; ++i) {
    Isometry3d X_PJ = Isometry3d(Eigen::AngleAxisd(twist[i], Vector3d::UnitX()));
    X_PJ.translation() = step[i];
    Body body = body_of(i, JointKind::revolute, Vector3d::UnitZ(), X_PJ);
    body.inertia = random_inertia(random);
    chain.bodies.push_back(body);
  }
  finish(chain);
  return chain;
}

Chain random_tree(std::uint64_t seed, const TreeOptions& options) {
  Random random(seed);
  Chain chain;
  chain.name = "tree " + std::to_string(seed);
  chain.gravity = random.unit_vector() * 9.81;
  for (int i = 1; i <= options.bodies; ++i) {
    const int parent = options.serial ? i - 1 : random.below(i);
    const JointKind kind = random_kind(random, options, i == 1);
    // Every third axis is one of the frame's own, as in most files.
    const Vector3d axis =
        random.below(3) == 0 ? Vector3d(Vector3d::Unit(random.below(3))) : random.unit_vector();
    Body body = body_of(parent, kind, axis, random.pose(0.5));
    body.inertia = random_inertia(random);
    chain.bodies.push_back(body);
  }
  std::vector<int> leader;
  add_extras(chain, random, options, leader);
  finish(chain, leader);
  return chain;
}

Chain random_planar_tree(std::uint64_t seed, const TreeOptions& options, bool turned) {
  Random random(seed);
  Chain chain;
  chain.name = "planar tree " + std::to_string(seed);
  chain.gravity = turned ? Vector3d(random.unit_vector() * 9.81) : Vector3d(0, -9.81, 0);
  const Matrix3d R_plane = turned ? random.rotation() : Matrix3d(Matrix3d::Identity());
  std::vector<Matrix3d> R_W(1, Matrix3d::Identity());
  for (int i = 1; i <= options.bodies; ++i) {
    const int parent = options.serial ? i - 1 : random.below(i);
    const JointKind kind = random_kind(random, options, false);
    const double angle = random.between(-3, 3);
    const Vector3d in_plane(std::cos(angle), std::sin(angle), 0);
    const Vector3d axis_W = kind == JointKind::prismatic
                                ? Vector3d(R_plane * in_plane)
                                : Vector3d(R_plane.col(2) * (random.below(2) == 0 ? 1 : -1));
    const Matrix3d R_WJ = random.rotation();
    Isometry3d X_PJ = random.pose(0.5);
    X_PJ.linear() = R_W[std::size_t(parent)].transpose() * R_WJ;
    R_W.push_back(R_WJ);
    Body body = body_of(parent, kind, (R_W.back().transpose() * axis_W).normalized(), X_PJ);
    body.inertia = random_inertia(random);
    chain.bodies.push_back(body);
  }
  std::vector<int> leader;
  add_extras(chain, random, options, leader);
  finish(chain, leader);
  return chain;
}

std::vector<double> random_vector(std::size_t n, Random& random, double size) {
  std::vector<double> v(n);
  for (double& x : v) x = random.between(-size, size);
  return v;
}

State random_state(const Chain& chain, Random& random, double speed) {
  const auto nv = std::size_t(chain.nv);
  State state;
  state.q = random_vector(std::size_t(chain.nq), random, 3);
  state.qd = random_vector(nv, random, speed);
  state.qdd = random_vector(nv, random, 5);
  state.tau = random_vector(nv, random, 5);
  for (std::size_t i = 1; i < chain.bodies.size(); ++i) {
    const Joint& joint = chain.bodies[i].joint;
    if (joint.kind != JointKind::floating) continue;
    Eigen::Map<Eigen::Vector4d> turn(&state.q[std::size_t(joint.q_index) + 3]);
    turn.normalize();
  }
  return state;
}

}  // namespace chainreel::test
