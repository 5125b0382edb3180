// The layer `constraints`: what the robot is tied to. Lines and planes are drawn as far as the motion uses them, hatched on
// the side where the robot cannot go, or is not; curves as far as the picture reaches; rods where they are.
#include <algorithm>
#include <array>
#include <cmath>
#include <variant>

#include "draw/layers/ground_plane.hpp"
#include "draw/layers/layer.hpp"
#include "draw/page/scales.hpp"
#include "draw/robot/chain.hpp"
#include "draw/robot/chain_fit.hpp"
#include "draw/robot/joints.hpp"
#include "dynamics/kinematics.hpp"
#include "picture/point.hpp"

namespace chainreel {
namespace {

using Eigen::Vector3d;

constexpr double kLineBeyond = 0.060;     // of the part that the motion uses, on both sides, units of H
constexpr double kPlaneBeyond = 0.2;      // of a plane in space, about that part: it has faded out there
constexpr double kPlaneCells = 14;        // about, over its diameter: closer than the ground's, which may lie in the same plane
constexpr double kCurvePiece = 0.010;     // of a curve, units of H
constexpr int kMostCurvePieces = 3000;
constexpr double kRodWidth = 0.011, kRodEnd = 0.0085;  // radius of its ends

const Frame* frame_of(const Chain& chain, const std::string& name) {
  const int index = find_frame(chain, name);
  return index < 0 ? nullptr : &chain.frames[std::size_t(index)];
}

Vector3d place_of(const Workspace& ws, const Frame& frame) {
  return pose_of(ws, frame.body) * frame.X_BF.translation();
}

// From where to where along the unit vector `along` a frame comes in the run, m from `point`; nothing where it is nowhere.
std::array<double, 2> used_part(const StagedRun& motion, const Frame& frame, const Vector3d& point, const Vector3d& along) {
  std::array<double, 2> used{0, 0};
  bool any = false;
  for (int k = 0; k < motion.counted(); ++k) {
    const double at = (place_of(motion.pose_at(k), frame) - point).dot(along);
    if (!(std::abs(at) <= motion.limit())) break;
    used = any ? std::array{std::min(used[0], at), std::max(used[1], at)} : std::array{at, at};
    any = true;
  }
  return used;
}

// The force that the robot is told to press with on constraint `index`; zero where it is told of none.
Vector3d pressing_force(const ConstraintPlan& plan, std::size_t index) {
  Vector3d force = Vector3d::Zero();
  for (const ContactForce& one : plan.contact_forces)
    if (one.constraint == index) force += one.force;
  return force;
}

class Constraints : public Layer {
 public:
  void measure(const Sight& sight, FitBox& box) const override {
    for_each(sight.motion, [&](const Constraint& constraint, std::size_t) {
      if (const auto* rod = std::get_if<DistanceConstraint>(&constraint))
        if (rod->at) box.add(room_around(sight.marks * size::kGroundLength / 2), sight.camera.flat(*rod->at));
    });
  }

  void draw_once(Picture& picture, const Panel& panel) const override {
    for_each(panel.motion(), [&](const Constraint& constraint, std::size_t index) {
      if (const auto* line = std::get_if<LineConstraint>(&constraint))
        draw_straight(picture, panel, index, line->frame, line->point, line->direction);
      if (const auto* plane = std::get_if<PlaneConstraint>(&constraint)) draw_plane(picture, panel, index, *plane);
      if (const auto* curve = std::get_if<CurveConstraint>(&constraint)) draw_curve(picture, panel, *curve);
      if (const auto* rod = std::get_if<DistanceConstraint>(&constraint))
        if (rod->at && !panel.motion().shapes())
          draw_pin(picture, panel.camera().project(*rod->at), panel.look(), panel.clip());
    });
  }

  void draw(Picture& picture, const Shot& shot) const override {
    const Panel& panel = shot.panel;
    for_each(panel.motion(), [&](const Constraint& constraint, std::size_t) {
      const auto* rod = std::get_if<DistanceConstraint>(&constraint);
      if (!rod) return;
      const Frame *a = frame_of(panel.chain(), rod->a), *b = frame_of(panel.chain(), rod->b);
      if (!a || (!b && !rod->at)) return;
      draw_rod(picture, panel, panel.camera().project(place_of(shot.ws, *a)),
               panel.camera().project(rod->at ? *rod->at : place_of(shot.ws, *b)));
    });
  }

 private:
  template <class Do>
  static void for_each(const StagedRun& motion, Do&& act) {
    if (!motion.is_constrained()) return;
    const std::vector<Constraint>& list = motion.simulation()->constraints.list;
    for (std::size_t i = 0; i < list.size(); ++i) act(list[i], i);
  }

  static void draw_straight(Picture& picture, const Panel& panel, std::size_t index, const std::string& name,
                            const Vector3d& point, const Vector3d& direction) {
    const StagedRun& motion = panel.motion();
    const Camera& camera = panel.camera();
    const Frame* frame = frame_of(panel.chain(), name);
    if (!frame) return;
    const Vector3d along = direction.normalized();
    const auto [from, until] = used_part(motion, *frame, point, along);
    Point a = camera.project(point + from * along), b = camera.project(point + until * along);
    const Point way = camera.project_vector(along, point);
    if (!is_drawable(a) || !is_drawable(b) || !(norm(way) > 0)) return;
    const double beyond = panel.marks() * kLineBeyond;
    a = a - beyond * unit(way);
    b = b + beyond * unit(way);
    if (!panel.chain().planar) return draw_line(picture, {a, b}, size::kGroundLine, toned(panel.look().theme->base, panel.look()), panel.clip());
    Point inside = normal_to(unit(way));
    const Vector3d force = pressing_force(motion.simulation()->constraints, index);
    Point wanted = camera.project_vector(force, point);
    // Where nothing is pressed on, as a table: below, and beside an upright line away from the base.
    if (std::abs(dot(wanted, inside)) <= 1e-9 * norm(wanted) || norm(wanted) == 0) wanted = {0, -1};
    if (std::abs(dot(wanted, inside)) <= 1e-9) wanted = camera.project(point) - camera.project(root_place(panel.chain()));
    if (dot(wanted, inside) < 0) inside = -1 * inside;
    draw_ground(picture, {a, b}, inside, panel.look(), panel.clip());
  }

  static void draw_plane(Picture& picture, const Panel& panel, std::size_t index, const PlaneConstraint& plane) {
    const Chain& chain = panel.chain();
    const Vector3d normal = plane.normal.normalized();
    if (chain.planar)
      return draw_straight(picture, panel, index, plane.frame, plane.point, chain.planar->plane.normal.cross(normal));
    const Frame* frame = frame_of(chain, plane.frame);
    if (!frame) return;
    const Vector3d near = std::abs(normal.x()) < 0.9 ? Vector3d::UnitX() : Vector3d::UnitY();
    const Vector3d first = (near - normal.dot(near) * normal).normalized(), second = normal.cross(first);
    const auto [a0, a1] = used_part(panel.motion(), *frame, plane.point, first);
    const auto [b0, b1] = used_part(panel.motion(), *frame, plane.point, second);
    // A grid that fades as the ground's does: it has no edges that the page could cut.
    GroundPlane patch;
    patch.up = normal;
    patch.middle = plane.point + (a0 + a1) / 2 * first + (b0 + b1) / 2 * second;
    patch.radius = std::hypot(a1 - a0, b1 - b0) / 2 + kPlaneBeyond / panel.camera().scale;
    patch.spacing = round_length(2 * patch.radius / kPlaneCells);
    draw_ground_plane(picture, patch, panel.camera(), toned(panel.look().theme->base, panel.look()), panel.area(), panel.clip());
  }

  // From where the frame is sought first, both ways, until it leaves the picture or comes back.
  static void draw_curve(Picture& picture, const Panel& panel, const CurveConstraint& constraint) {
    if (!panel.chain().planar) return;
    const Plane& plane = panel.chain().planar->plane;
    const Camera& camera = panel.camera();
    const Rect room = widened(panel.area(), kCurvePiece);
    const auto on_page = [&](double s) {
      const Eigen::Vector2d c = constraint.curve->at(s).c;
      return camera.project(c.x() * plane.ex + c.y() * plane.ey);
    };
    const Point start = on_page(constraint.s);
    bool closed = false;
    for (const double way : {1.0, -1.0}) {
      Trail path;
      path.color = toned(panel.look().theme->base, panel.look());
      double s = constraint.s;
      for (int i = 0; i < kMostCurvePieces && !closed; ++i) {
        const Point p = on_page(s);
        if (!is_drawable(p)) break;
        path.points.push_back({p, size::kGroundLine, 1});
        closed = i > 3 && norm(p - start) < 0.75 * kCurvePiece;
        if (closed) path.points.push_back({start, size::kGroundLine, 1});
        if (!(p.x > room.x0 && p.x < room.x1 && p.y > room.y0 && p.y < room.y1)) break;
        const double rate = constraint.curve->at(s).c1.norm() * camera.scale;
        if (!(rate > 0) || !std::isfinite(rate)) break;
        s += way * kCurvePiece / rate;
      }
      if (path.points.size() > 1) picture.add(std::move(path), panel.clip());
    }
  }

  static void draw_rod(Picture& picture, const Panel& panel, Point a, Point b) {
    if (!is_drawable(a) || !is_drawable(b)) return;
    const ChainLook& look = panel.look();
    const Paint paint{tinted(look.theme->base, 0.35, look), toned(look.theme->ink, look), size::kLinkOutline};
    const double size = panel.marks();
    picture.add(Capsule{a, b, size * kRodWidth / 2, paint}, panel.clip());
    for (const Point end : {a, b}) {
      const double r = size * kRodEnd;
      picture.add(Ellipse{end, {r, 0}, {0, r}, {look.theme->background, toned(look.theme->ink, look), size::kLinkOutline}},
                  panel.clip());
    }
  }
};

}  // namespace

std::unique_ptr<const Layer> make_layer_constraints(const Stage&) {
  return std::make_unique<Constraints>();
}

}  // namespace chainreel
