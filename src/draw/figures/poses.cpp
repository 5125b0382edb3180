#include "draw/figures/poses.hpp"

#include <limits>

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


}  // namespace

Picture draw_pose_figure(const Chain& chain, const std::vector<std::vector<double>>& poses,
                         const PoseFigureOptions& options, const Fonts& fonts) {
  if (poses.empty()) throw Error(ExitCode::usage, "a figure needs at least one pose");
  SheetText text;
  text.title = options.title;
  const Sheet sheet =
      lay_out_sheet(text, double(options.width) / options.height, options.text_scale, *options.theme, fonts);

  const std::vector<double> at_rest(std::size_t(chain.nv), 0.0);
  Skeleton skeleton = skeleton_of(chain);
  for (const std::vector<double>& q : poses) widen_rails(skeleton, chain, q, kNoLimit);
  Workspace ws(chain);
  const auto stand = [&](const std::vector<double>& q) { compute_kinematics(chain, ws, q, at_rest); };
  const auto fit = [&](Camera& seen) {
    ChainFit places(chain, skeleton, seen, 1, options.shapes.get());
    for (const std::vector<double>& q : poses) {
      stand(q);
      places.add_pose(ws, kNoLimit);
    }
    fit_to(seen, places.box(), sheet.scene, size::kFitMargin);
  };
  const MotionBox motion = box_around(chain, skeleton, options.shapes.get(), ws, poses);
  const Camera camera = aimed_camera(chain, options.camera, motion, sheet.scene, fit);

  Picture picture;
  picture.aspect = sheet.aspect;
  picture.background = options.theme->background;
  picture.clips = {sheet.scene};
  const auto ground = ground_under(motion, camera);
  if (ground && is_oblique(chain, options.camera))
    draw_ground_plane(picture, *ground, camera, *options.theme, kSceneClip);
  const auto drawing = [&](double strength) {
    return ChainDrawing{chain, skeleton, camera, look_of(skeleton, camera, *options.theme, strength),
                        options.shapes.get()};
  };
  draw_base(picture, drawing(1), kSceneClip);
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const double strength = i + 1 < poses.size() ? kOnionSkin : 1;
    stand(poses[i]);
    draw_rails(picture, drawing(strength), ws, kSceneClip);
    draw_links(picture, drawing(strength), ws, kSceneClip);
    if (options.shapes || chain.end_effector < 0) continue;
    draw_end_effector(picture, camera.project(tip_position(chain, ws)), drawing(strength).look, kSceneClip);
  }
  draw_sheet(picture, sheet);
  return picture;
}

}  // namespace chainreel
