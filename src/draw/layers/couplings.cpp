// The layer `constraints` above the chain: what is tied of its coordinates themselves. A joint that is held has a filled square in place of its
// disc, as where links are welded; joints that move by one another are led together by a dashed line with a ring at each.
#include <algorithm>
#include <numbers>
#include <optional>
#include <variant>

#include "draw/layers/layer.hpp"
#include "draw/robot/chain.hpp"
#include "draw/robot/joints.hpp"
#include "dynamics/kinematics.hpp"
#include "picture/point.hpp"
#include "sim/drive/linear_drive.hpp"

namespace chainreel {
namespace {

constexpr double kHeldSquare = 0.014, kTiedRing = 0.021;  // units of H: half of its side; radius, about the disc of a joint
constexpr double kTiedLine = 0.0022;

class Couplings : public Layer {
 public:
  explicit Couplings(const Stage&) {}

  UnderWords under_words() const override { return UnderWords::if_need_be; }

  void draw(Picture& picture, const Shot& shot) const override {
    const StagedRun& motion = shot.panel.motion();
    if (!motion.is_constrained()) return;
    for (const Constraint& constraint : motion.simulation()->constraints.list) {
      if (const auto* held = std::get_if<JointConstraint>(&constraint)) draw_held(picture, shot, body_of(motion.chain(), held->coordinate));
      if (const auto* tied = std::get_if<LinearConstraint>(&constraint)) draw_tied(picture, shot, *tied);
    }
  }

 private:
  static std::optional<int> body_of(const Chain& chain, const std::string& coordinate) {
    const auto name = std::ranges::find(chain.coordinate_names, coordinate);
    if (name == chain.coordinate_names.end()) return std::nullopt;
    return body_of_freedom(chain, int(name - chain.coordinate_names.begin()));
  }

  static std::optional<Point> place_of(const Shot& shot, std::optional<int> body) {
    if (!body) return std::nullopt;
    const Point place = shot.panel.camera().project(pose_of(shot.ws, *body).translation());
    return is_drawable(place) ? std::optional(place) : std::nullopt;
  }

  // With the link's own direction on the page, that it is seen to turn with.
  static void draw_held(Picture& picture, const Shot& shot, std::optional<int> body) {
    const std::optional<Point> place = place_of(shot, body);
    if (!place) return;
    const Camera& camera = shot.panel.camera();
    const Eigen::Isometry3d pose = pose_of(shot.ws, *body);
    Point along = camera.project_vector(pose.linear() * Eigen::Vector3d::UnitX(), pose.translation());
    along = norm(along) > 1e-9 ? unit(along) : Point{1, 0};
    const ChainLook& look = shot.panel.look();
    const double half = shot.panel.marks() * kHeldSquare;
    const Point u = half * along, v = half * normal_to(along);
    picture.add(Polygon{{*place + u + v, *place - u + v, *place - u - v, *place + u - v}, 4,
                        {toned(look.theme->ink, look), look.theme->background, size::kLinkOutline}},
                shot.panel.clip());
  }

  static void draw_tied(Picture& picture, const Shot& shot, const LinearConstraint& tied) {
    const ChainLook& look = shot.panel.look();
    const Color color = toned(look.theme->constraint, look);
    const double ring = shot.panel.marks() * kTiedRing;
    std::optional<Point> before;
    for (const LinearConstraint::Term& term : tied.terms) {
      const std::optional<Point> place = term.coefficient == 0 ? std::nullopt : place_of(shot, body_of(shot.panel.chain(), term.coordinate));
      if (!place) continue;
      picture.add(Arc{*place, ring, 0, 2 * std::numbers::pi, kTiedLine, color}, shot.panel.clip());
      if (before && norm(*place - *before) > 2 * ring) {
        const Point way = ring * unit(*place - *before);
        draw_dashed_line(picture, {*before + way, *place - way}, kTiedLine, color, shot.panel.clip());
      }
      before = place;
    }
  }
};

}  // namespace

std::unique_ptr<const Layer> make_layer_couplings(const Stage& stage) {
  return std::make_unique<Couplings>(stage);
}

}  // namespace chainreel
