#include "draw/robot/made_bodies.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "draw/robot/fit.hpp"
#include "dynamics/kinematics.hpp"
#include "mesh/primitives.hpp"

namespace chainreel {
namespace {

using Eigen::Vector3d;

constexpr double kDensity = 1000;                     // kg/m^3
constexpr double kSlim = 0.08, kStout = 0.20;         // radius of a limb, of its length
constexpr double kThinnest = 0.03, kThickest = 0.25;  // ... of the longest link of all
constexpr double kLeastAround = 0.12, kMostAround = 0.35;  // what is around the joints of a carrier, of their distance
constexpr double kWaist = 0.85;                       // width between two carriers, of theirs
constexpr double kFlat = 0.45, kDeep = 0.70;          // its depth, of its width
constexpr double kBeside = 0.6;                       // of the way along a limb: a mass farther to its side makes a foot
constexpr double kBall = 1.04;                        // radius of a joint, of that of the thicker limb
constexpr double kPlinthWide = 2.2, kPlinthHigh = 1.4;  // radius and height, of the radius of the limb that stands there
constexpr double kUpright = 1e-6;                     // sine between an axis and the vertical, far above round-off of files
constexpr Color kPlinthColor = color_of(0x8A9099);
constexpr Color kBallColor = color_of(0x6F7B8A);

// What is known of a body before it has a shape.
struct Limbs {
  std::vector<Vector3d> ends;  // in the body's frame
  double mass = 0;             // with its share of bodies without length
  double radius = 0;

  bool carries() const { return ends.size() > 1; }
};

class Maker {
 public:
  explicit Maker(const Chain& chain) : chain_(chain), zero_(chain), limbs_(chain.bodies.size()) {
    const std::vector<double> q = zero_configuration(chain), qd(std::size_t(chain.nv), 0.0);
    compute_kinematics(chain, zero_, q, qd);
    for (const LinkSegment& link : skeleton_of(chain).links) {
      limbs_[std::size_t(link.body)].ends.push_back(link.to);
      longest_ = std::max(longest_, (link.to - link.from).norm());
    }
    stand_on_world();
    share_masses();
  }

  BodyShapes make() {
    for (int b = 0; b < int(chain_.bodies.size()); ++b) {
      Limbs& limbs = of(b);
      if (limbs.carries())
        add_carrier(b);
      else if (limbs.ends.size() == 1)
        add_limb(b);
    }
    for (int b = 0; b < int(chain_.bodies.size()); ++b)
      if (of(b).carries()) add_head(b);
    add_balls();
    add_plinths();
    return std::move(result_);
  }

 private:
  Limbs& of(int body) { return limbs_[std::size_t(body)]; }
  const Limbs& of(int body) const { return limbs_[std::size_t(body)]; }
  int parent(int body) const { return chain_.bodies[std::size_t(body)].parent; }
  bool is_leaf(int body) const {
    return std::none_of(chain_.bodies.begin() + 1, chain_.bodies.end(), [&](const Body& other) { return other.parent == body; });
  }
  Vector3d turned(const Vector3d& v, int from, int to) const {
    return pose_of(zero_, to).linear().transpose() * (pose_of(zero_, from).linear() * v);
  }

  // A trunk that is fixed to the world has its limbs there, close to one another.
  void stand_on_world() {
    std::vector<Vector3d>& ends = limbs_[0].ends;
    for (std::size_t b = 1; b < chain_.bodies.size(); ++b) {
      if (chain_.bodies[b].parent != 0 || chain_.bodies[b].joint.kind == JointKind::floating) continue;
      const Vector3d place = chain_.bodies[b].joint.X_PJ.translation();
      if (std::none_of(ends.begin(), ends.end(), [&](const Vector3d& end) { return (end - place).norm() < 1e-9; })) ends.push_back(place);
    }
    for (const Vector3d& end : ends)
      if (ends.size() < 2 || (end - ends.front()).norm() > longest_) return ends.clear();
  }

  // What has no length adds to the thickness of what it hangs between.
  void share_masses() {
    std::vector<std::vector<int>> takers(limbs_.size());
    for (int b = 1; b < int(limbs_.size()); ++b) {
      int above = parent(b);
      if (of(b).ends.empty()) {
        while (above > 0 && of(above).ends.empty()) above = parent(above);
        if (above > 0) takers[std::size_t(b)].push_back(above);
      } else {
        for (; above > 0 && of(above).ends.empty(); above = parent(above)) takers[std::size_t(above)].push_back(b);
      }
    }
    for (int b = 1; b < int(limbs_.size()); ++b) {
      const double mass = chain_.bodies[std::size_t(b)].inertia.mass;
      const std::vector<int>& own = takers[std::size_t(b)];
      of(b).mass += own.empty() ? mass : 0;
      for (const int taker : own) of(taker).mass += mass / double(own.size());
    }
  }

  // The body with a shape that carries this one; -1 where there is none.
  int above(int body) const {
    if (body == 0) return -1;
    int b = parent(body);
    while (b > 0 && of(b).ends.empty()) b = parent(b);
    return of(b).ends.empty() ? -1 : b;
  }
  int carrier_above(int body) const {
    int b = above(body);
    while (b >= 0 && !of(b).carries()) b = above(b);
    return b;
  }
  int carrier_below(int body) const {
    for (int b = body + 1; b < int(limbs_.size()); ++b)
      if (of(b).carries())
        for (int up = above(b); up >= 0; up = above(up))
          if (up == body) return b;
    return -1;
  }

  void add(int body, const Vector3d& middle, const Eigen::Matrix3d& axes, const Vector3d& edges, double radius, const Color& color) {
    BodyShape shape;
    shape.body = body;
    shape.X_BM.linear() = axes;
    shape.X_BM.translation() = middle;
    shape.mesh = std::make_shared<const TriangleMesh>(rounded_box_mesh(edges, std::min(radius, edges.minCoeff() / 2)));
    shape.color = color;
    measure_corners(shape);
    result_.shapes.push_back(std::move(shape));
  }
  void add_capsule(int body, const Vector3d& from, const Vector3d& to, double radius, const Color& color) {
    const Vector3d way = to - from;
    const Eigen::Matrix3d axes = Eigen::Quaterniond::FromTwoVectors(Vector3d::UnitZ(), way).toRotationMatrix();
    add(body, (from + to) / 2, axes, {2 * radius, 2 * radius, way.norm() + 2 * radius}, radius, color);
  }
  Color tint(int body) const {
    int place = 0;
    for (int b = body; b >= 0; b = above(b)) ++place;
    return link_tint(place);
  }

  // The box around the joints of a carrier.
  struct Around {
    Vector3d lower, upper;
    Vector3d edges() const { return upper - lower; }
  };
  Around around(int body) const {
    Around box{Vector3d::Zero(), Vector3d::Zero()};
    if (body == 0) box = {of(body).ends.front(), of(body).ends.front()};
    for (const Vector3d& end : of(body).ends) box = {box.lower.cwiseMin(end), box.upper.cwiseMax(end)};
    return box;
  }

  void add_carrier(int body) {
    const Around box = around(body);
    const double longest = box.edges().maxCoeff();
    double least = kLeastAround * longest, most = kMostAround * longest;
    // As much around the joints as the mass fills.
    for (int pass = 0; pass < 30; ++pass) {
      const double radius = (least + most) / 2;
      const bool is_filled = (box.edges().array() + 2 * radius).prod() * kDensity >= of(body).mass;
      (is_filled ? most : least) = radius;
    }
    of(body).radius = most;
    const Vector3d edges = box.edges().array() + 2 * most;
    add(body, (box.lower + box.upper) / 2, Eigen::Matrix3d::Identity(), edges, 0.8 * edges.minCoeff() / 2, tint(body));
  }

  void add_limb(int body) {
    const Vector3d end = of(body).ends.front();
    const int from = carrier_above(body), to = carrier_below(body);
    if (from >= 0 && to >= 0) return add_trunk(body, from, to);
    if (is_leaf(body) && add_foot(body)) return;
    const double length = end.norm();
    const double filled = std::sqrt(of(body).mass / (kDensity * std::numbers::pi * length));
    of(body).radius = std::clamp(std::clamp(filled, kSlim * length, kStout * length), kThinnest * longest_, kThickest * longest_);
    // What stands upright on a plinth ends in it, and not below the ground.
    const Vector3d begin = stands_upright(body) ? Vector3d(std::min(of(body).radius, length / 2) * end.normalized()) : Vector3d::Zero();
    add_capsule(body, begin, end, of(body).radius, tint(body));
  }

  // Between two carriers, as wide as they are along their longest sides.
  void add_trunk(int body, int from, int to) {
    const Vector3d end = of(body).ends.front(), along = end.normalized();
    Vector3d across = Vector3d::Zero();
    double width = 0;
    for (const int carrier : {from, to}) {
      const Vector3d edges = around(carrier).edges();
      Eigen::Index side = 0;
      width += kWaist * edges.maxCoeff(&side) / 2;
      Vector3d axis = turned(Vector3d::Unit(side), carrier, body);
      axis -= along.dot(axis) * along;
      if (axis.norm() > across.norm()) across = axis;
    }
    if (across.norm() < 1e-6) across = along.unitOrthogonal();
    across.normalize();
    Eigen::Matrix3d axes;
    axes.col(1) = across;
    axes.col(2) = along;
    axes.col(0) = across.cross(along);
    const double depth = std::clamp(of(body).mass / (kDensity * end.norm() * width), kFlat * width, kDeep * width);
    of(body).radius = depth / 2;
    add(body, end / 2, axes, {depth, width, end.norm() + depth / 2}, 0.45 * depth, tint(body));
  }

  // Where the mass of a last link lies beside its limb. False where it does not.
  bool add_foot(int body) {
    const int limb = above(body);
    if (limb < 0 || of(limb).ends.size() != 1 || !(chain_.bodies[std::size_t(body)].inertia.com - of(body).ends.front()).isZero(1e-9)) return false;
    const Vector3d end = of(body).ends.front(), down = turned(of(limb).ends.front(), limb, body).normalized();
    const double height = down.dot(end);
    const Vector3d ahead = end - height * down;
    if (!(height > 0) || !(ahead.norm() > kBeside * height)) return false;
    constexpr double kHeel = 0.35, kThick = 0.3, kWide = 0.4;  // of the way ahead
    const double reach = ahead.norm(), thick = std::min(kThick * reach, height);
    of(body).radius = std::min(0.75 * of(limb).radius, 0.8 * height);
    const Vector3d sole = (height - thick / 2) * down;
    add_capsule(body, Vector3d::Zero(), (height - std::max(thick / 2, of(body).radius)) * down, of(body).radius, tint(body));
    Eigen::Matrix3d axes;
    axes.col(0) = ahead / reach;
    axes.col(2) = -down;
    axes.col(1) = axes.col(2).cross(axes.col(0));
    add(body, sole + (1 - kHeel) / 2 * ahead, axes, {(1 + kHeel) * reach, kWide * reach, thick}, 0.45 * thick, tint(body));
    return true;
  }

  // Two arms, nothing else on their carrier, and limbs at the other end of the trunk, too: that is a person.
  void add_head(int body) {
    const std::vector<Vector3d>& arms = of(body).ends;
    const int trunk = above(body), hips = carrier_above(body);
    if (arms.size() != 2 || trunk < 0 || hips < 0 || of(hips).ends.size() < 3) return;
    Vector3d up = Vector3d::Zero();
    // The trunk's last piece with a length of its own.
    for (const Vector3d& end : of(trunk).ends)
      if (turned(end, trunk, body).norm() > up.norm()) up = turned(end, trunk, body);
    up.normalize();
    const Vector3d apart = arms[1] - arms[0], middle = (arms[0] + arms[1]) / 2;
    const double width = apart.norm();
    if (std::abs(up.dot(apart)) > 0.2 * width) return;
    Eigen::Matrix3d axes;
    axes.col(2) = up;
    axes.col(1) = (apart - up.dot(apart) * up).normalized();
    axes.col(0) = axes.col(1).cross(axes.col(2));
    const Vector3d top = middle + (of(body).radius + 0.40 * width) * up;
    add_capsule(body, middle, top, 0.12 * width, kBallColor);
    add(body, top, axes, {0.42 * width, 0.37 * width, 0.52 * width}, 0.185 * width, tint(body));
  }

  // At each place one, however many joints meet there.
  void add_balls() {
    std::vector<Vector3d> known;
    for (int b = 1; b < int(limbs_.size()); ++b) {
      if (chain_.bodies[std::size_t(b)].joint.kind == JointKind::floating) continue;
      const Vector3d place = pose_of(zero_, b).translation();
      if (std::any_of(known.begin(), known.end(), [&](const Vector3d& other) { return (other - place).norm() < 1e-6 * longest_; })) continue;
      known.push_back(place);
      double radius = 0;
      bool is_hidden = false;  // in a trunk
      for (int c = b; c < int(limbs_.size()); ++c) {
        if ((pose_of(zero_, c).translation() - place).norm() > 1e-6 * longest_) continue;
        radius = std::max(radius, of(c).radius);
        is_hidden |= !of(c).ends.empty() && carrier_above(c) >= 0 && (of(c).carries() || carrier_below(c) >= 0);
      }
      if (const int limb = above(b); limb >= 0 && of(limb).ends.size() == 1) radius = std::max(radius, of(limb).radius);
      if (!(radius > 0) || is_hidden || bears_plinth(b)) continue;
      add(b, Vector3d::Zero(), Eigen::Matrix3d::Identity(), Vector3d::Constant(2 * kBall * radius), kBall * radius, kBallColor);
    }
  }

  // What turns about an upright axis on the world, where no trunk stands.
  bool bears_plinth(int body) const {
    const Joint& joint = chain_.bodies[std::size_t(body)].joint;
    return body > 0 && of(0).ends.empty() && parent(body) == 0 && joint.kind == JointKind::revolute &&
           (pose_of(zero_, body).linear() * joint.axis).cross(up_of(chain_)).norm() < kUpright;
  }
  bool stands_upright(int body) const {
    const Vector3d along = pose_of(zero_, body).linear() * of(body).ends.front();
    return bears_plinth(body) && along.cross(up_of(chain_)).norm() < kUpright * along.norm() && along.dot(up_of(chain_)) > 0;
  }

  // Around the foot of an upright limb; below one that lies.
  void add_plinths() {
    const Vector3d up = up_of(chain_);
    for (int b = 1; b < int(limbs_.size()); ++b) {
      if (!bears_plinth(b)) continue;
      const Eigen::Isometry3d pose = pose_of(zero_, b);
      int limb = b;  // that is as thick as the plinth is to bear
      while (limb + 1 < int(limbs_.size()) && !(of(limb).radius > 0)) ++limb;
      const double radius = of(limb).radius;
      if (!(radius > 0)) continue;
      BodyShape shape;
      shape.body = 0;
      shape.X_BM.linear() = Eigen::Quaterniond::FromTwoVectors(Vector3d::UnitZ(), up).toRotationMatrix();
      const bool is_around = !of(b).ends.empty() && stands_upright(b);
      shape.X_BM.translation() = pose.translation() + (is_around ? 1 : -1) * kPlinthHigh * radius / 2 * up;
      shape.mesh = std::make_shared<const TriangleMesh>(cylinder_mesh(kPlinthWide * radius, kPlinthHigh * radius));
      shape.color = kPlinthColor;
      measure_corners(shape);
      result_.shapes.push_back(std::move(shape));
    }
  }

  const Chain& chain_;
  Workspace zero_;  // at q = 0
  std::vector<Limbs> limbs_;
  double longest_ = 0;  // link
  BodyShapes result_;
};

}  // namespace

BodyShapes made_bodies(const Chain& chain) {
  const auto slides = [](const Body& body) { return body.joint.kind == JointKind::prismatic; };
  if (std::any_of(chain.bodies.begin() + 1, chain.bodies.end(), slides)) return {};
  return Maker(chain).make();
}

}  // namespace chainreel
