#include "draw/layers/ground_plane.hpp"

#include <algorithm>
#include <cmath>

#include "draw/layers/layer.hpp"
#include "draw/page/scales.hpp"
#include "draw/robot/chain.hpp"
#include "draw/robot/view.hpp"

namespace chainreel {
namespace {

using Eigen::Vector3d;

constexpr double kTouches = 0.02;  // of the motion's size: how far from the plane its lowest place may be
constexpr double kGroundBeyond = 0.35;   // of the motion's reach, the grid goes on beyond it
constexpr double kCells = 10;      // about, over the diameter
constexpr double kLine = 0.0016;   // units of H
constexpr double kShown = 0.9;     // opacity of the lines in the middle
constexpr double kFades = 0.07;    // units of H before the edges of the scene
constexpr int kPieces = 64;        // of a line; vector pages have one opacity a piece

// Any two directions that span the plane, along the world's axes where these lie in it.
std::array<Vector3d, 2> along(const Vector3d& up) {
  const Vector3d near = std::abs(up.x()) < 0.9 ? Vector3d::UnitX() : Vector3d::UnitY();
  const Vector3d first = (near - up.dot(near) * up).normalized();
  return {first, up.cross(first)};
}

}  // namespace

namespace {

std::optional<GroundPlane> ground_at(double height, const MotionBox& motion, const Camera& camera) {
  if (motion.empty() || camera.toward_viewer.dot(motion.up()) < 0) return std::nullopt;
  if (!(std::abs(motion.lowest() - height) <= kTouches * motion.size())) return std::nullopt;
  GroundPlane ground;
  ground.up = motion.up();
  ground.height = height;
  ground.middle = motion.middle() + (height - ground.up.dot(motion.middle())) * ground.up;
  ground.radius = (1 + kGroundBeyond) * std::max(motion.width(), motion.size() / 2) / 2;
  ground.spacing = round_length(2 * ground.radius / kCells);
  return ground;
}

}  // namespace

std::optional<GroundPlane> ground_under(const MotionBox& motion, const Camera& camera) {
  return ground_at(0, motion, camera);
}

std::optional<GroundPlane> ground_of_poses(const Chain& chain, const MotionBox& poses, const Camera& camera, const CameraEntry& wanted) {
  if (!is_oblique(chain, wanted)) return std::nullopt;
  return ground_at(chain.has_floating ? poses.lowest() : 0, poses, camera);
}

void draw_ground_plane(Picture& picture, const GroundPlane& ground, const Camera& camera, Color color,
                       const Rect& area, int clip) {
  const Fade edges{area, kFades, kFades, kFades, kFades};
  const std::array<Vector3d, 2> axes = along(ground.up);
  for (std::size_t i = 0; i < 2; ++i) {
    const Vector3d &line = axes[i], &step = axes[1 - i];
    const double middle = ground.middle.dot(step);
    const auto first = std::ceil((middle - ground.radius) / ground.spacing);
    for (double k = first; k * ground.spacing <= middle + ground.radius; ++k) {
      const double off = k * ground.spacing - middle;
      const double half = std::sqrt(std::max(0.0, ground.radius * ground.radius - off * off));
      Trail way{{}, color};
      for (int piece = 0; piece <= kPieces; ++piece) {
        const double at = half * (2.0 * piece / kPieces - 1);
        const Point p = camera.project(ground.middle + off * step + at * line);
        const double away = std::hypot(off, at) / ground.radius;
        if (is_drawable(p)) way.points.push_back({p, kLine, kShown * std::max(0.0, 1 - away * away) * edges.opacity_at(p)});
      }
      if (way.points.size() > 1) picture.add(std::move(way), clip);
    }
  }
}

namespace {

// The ground below all runs of the stage; none where the view is flat.
class OnGround : public Layer {
 public:
  explicit OnGround(const Stage& stage) : stage_(&stage) {}

 protected:
  const Theme& theme() const { return stage_->theme; }
  std::optional<GroundPlane> ground_of(const Panel& panel) const {
    if (!is_oblique(stage_->motions.front().chain(), stage_->page.camera)) return std::nullopt;
    return ground_under(*stage_->space, panel.camera());
  }

 private:
  const Stage* stage_;
};

class GroundLayer : public OnGround {
 public:
  using OnGround::OnGround;
  UnderWords under_words() const override { return UnderWords::freely; }
  void draw_once(Picture& picture, const Panel& panel) const override {
    if (const auto ground = ground_of(panel))
      draw_ground_plane(picture, *ground, panel.camera(), theme().rule, panel.area(), panel.clip());
  }
};

class ShadowLayer : public OnGround {
 public:
  using OnGround::OnGround;
  UnderWords under_words() const override { return UnderWords::freely; }
  void draw(Picture& picture, const Shot& shot) const override {
    if (const auto ground = ground_of(shot.panel))
      draw_shadow(picture, shot.panel.drawing(), shot.ws, ground->height, shot.panel.area(), shot.panel.clip());
  }
};

}  // namespace

std::unique_ptr<const Layer> make_layer_ground(const Stage& stage) {
  return std::make_unique<GroundLayer>(stage);
}

std::unique_ptr<const Layer> make_layer_shadow(const Stage& stage) {
  return std::make_unique<ShadowLayer>(stage);
}

}  // namespace chainreel
