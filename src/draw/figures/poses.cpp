#include "draw/figures/poses.hpp"

#include "core/error.hpp"
#include "draw/layers/ground_plane.hpp"
#include "draw/page/sheet.hpp"
#include "draw/robot/chain.hpp"
#include "draw/robot/chain_fit.hpp"
#include "draw/robot/joints.hpp"
#include "draw/robot/view.hpp"
#include "dynamics/kinematics.hpp"

namespace chainreel {
namespace {

// The page of a figure of poses, and the camera that sees all of them.
struct PoseStage {
  PoseStage(const Chain& chain, const std::vector<std::vector<double>>& poses, const PoseFigureOptions& options,
            const Fonts& fonts);

  void stand(const std::vector<double>& q) { compute_kinematics(chain, ws, q, at_rest); }
  FitBox places(const std::vector<std::vector<double>>& poses, const Camera& seen);

  const Chain& chain;
  const BodyShapes* shapes;
  std::vector<double> at_rest;
  Workspace ws;
  Sheet sheet;
  Skeleton skeleton;
  MotionBox motion;
  Camera camera;
};

Sheet sheet_of(const PoseFigureOptions& options, const Fonts& fonts) {
  SheetText text;
  text.title = options.title;
  text.logo = logo_of(options);
  return lay_out_sheet(text, double(options.width) / options.height, options.text_scale, *options.theme, fonts);
}

Skeleton skeleton_over(const Chain& chain, const std::vector<std::vector<double>>& poses) {
  Skeleton skeleton = skeleton_of(chain);
  for (const std::vector<double>& q : poses) widen_rails(skeleton, chain, q, kNoLimit);
  return skeleton;
}

PoseStage::PoseStage(const Chain& its_chain, const std::vector<std::vector<double>>& poses,
                     const PoseFigureOptions& options, const Fonts& fonts)
    : chain(its_chain),
      shapes(options.shapes.get()),
      at_rest(std::size_t(chain.nv), 0.0),
      ws(chain),
      sheet(sheet_of(options, fonts)),
      skeleton(skeleton_over(chain, poses)),
      motion(box_around(chain, skeleton, shapes, ws, poses)),
      camera(aimed_camera(chain, options.camera, motion, sheet.scene, [&](Camera& seen) {
        fit_to(seen, places(poses, seen), sheet.scene, size::kFitMargin);
      })) {}

FitBox PoseStage::places(const std::vector<std::vector<double>>& poses, const Camera& seen) {
  ChainFit fit(chain, skeleton, seen, 1, shapes);
  for (const std::vector<double>& q : poses) {
    stand(q);
    fit.add_pose(ws, kNoLimit);
  }
  return fit.box();
}

}  // namespace

KeptCamera camera_of_poses(const Chain& chain, const std::vector<std::vector<double>>& poses, const PoseFigureOptions& options,
                           const Fonts& fonts) {
  const PoseStage stage(chain, poses, options, fonts);
  return kept_camera(stage.camera, stage.sheet.scene);
}

bool leaves_page(const Chain& chain, const std::vector<double>& q, const PoseFigureOptions& options,
                 const Fonts& fonts) {
  PoseStage stage(chain, {q}, options, fonts);
  const Camera& camera = stage.camera;
  const Rect box = stage.places({q}, camera).box(camera.scale);
  const Rect& area = stage.sheet.scene;
  constexpr double kSlack = 1e-6;  // units of H: round-off of a fit
  return camera.origin.x + camera.scale * box.x0 < area.x0 - kSlack ||
         camera.origin.y + camera.scale * box.y0 < area.y0 - kSlack ||
         camera.origin.x + camera.scale * box.x1 > area.x1 + kSlack ||
         camera.origin.y + camera.scale * box.y1 > area.y1 + kSlack;
}

Picture draw_pose_figure(const Chain& chain, const std::vector<std::vector<double>>& poses,
                         const PoseFigureOptions& options, const Fonts& fonts) {
  if (poses.empty()) throw Error(ExitCode::usage, "a figure needs at least one pose");
  PoseStage stage(chain, poses, options, fonts);
  const Sheet& sheet = stage.sheet;
  const Skeleton& skeleton = stage.skeleton;
  const Camera& camera = stage.camera;

  Picture picture;
  picture.aspect = sheet.aspect;
  picture.background = options.theme->background;
  picture.clips = {sheet.scene};
  const auto ground = ground_of_poses(chain, stage.motion, camera, options.camera);
  if (ground)
    draw_ground_plane(picture, *ground, camera, options.theme->rule, sheet.scene, kSceneClip);
  const auto drawing = [&](double strength) {
    return ChainDrawing{chain, skeleton, camera, look_of(skeleton, camera, *options.theme, strength),
                        options.shapes.get()};
  };
  draw_base(picture, drawing(1), kSceneClip);
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const double strength = i + 1 < poses.size() ? kOnionSkin : 1;
    stage.stand(poses[i]);
    if (ground) draw_shadow(picture, drawing(strength), stage.ws, ground->height, sheet.scene, kSceneClip);
    draw_rails(picture, drawing(strength), stage.ws, kSceneClip);
    draw_links(picture, drawing(strength), stage.ws, kSceneClip);
    if (options.shapes || chain.end_effector < 0) continue;
    draw_end_effector(picture, camera.project(tip_position(chain, stage.ws)), drawing(strength).look, kSceneClip);
  }
  draw_sheet(picture, sheet);
  return picture;
}

PageInUnits in_units(PoseFigureOptions options) {
  constexpr double kUsualPage = 9.0 / 16;
  const int unit = std::min(options.height, int(std::lround(kUsualPage * options.width)));
  const double height = double(options.height) / unit;
  options.height = unit;
  options.text_scale *= height;
  return {std::move(options), height};
}

std::optional<PageLogo> logo_of(const PoseFigureOptions& options) {
  std::optional<PageLogo> logo = options.logo;
  if (logo) logo->page_height = options.height;
  return logo;
}

}  // namespace chainreel
