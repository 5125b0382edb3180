#include "draw/poses.hpp"

#include <limits>

#include "core/error.hpp"
#include "draw/chain.hpp"
#include "draw/chain_fit.hpp"
#include "draw/joints.hpp"
#include "draw/sheet.hpp"
#include "draw/view.hpp"
#include "dynamics/kinematics.hpp"

namespace chainreel {
namespace {

constexpr double kOnionSkin = 0.25;
constexpr int kSceneClip = 0;

}  // namespace

Picture draw_pose_figure(const Chain& chain, const std::vector<std::vector<double>>& poses,
                         const PoseFigureOptions& options, const Fonts& fonts) {
  if (poses.empty()) throw Error(ExitCode::usage, "a figure needs at least one pose");
  SheetText text;
  text.title = options.title;
  const Sheet sheet =
      lay_out_sheet(text, double(options.width) / options.height, options.text_scale, *options.theme, fonts);

  constexpr double kNoLimit = std::numeric_limits<double>::max();
  const std::vector<double> at_rest(std::size_t(chain.nv), 0.0);
  Skeleton skeleton = skeleton_of(chain);
  for (const std::vector<double>& q : poses) widen_rails(skeleton, chain, q, kNoLimit);
  Workspace ws(chain);
  Camera camera = view_of(chain);
  ChainFit fit(chain, skeleton, camera);
  for (const std::vector<double>& q : poses) {
    compute_kinematics(chain, ws, q, at_rest);
    fit.add_pose(ws, kNoLimit);
  }
  fit_to(camera, fit.box(), sheet.scene, size::kFitMargin);

  Picture picture;
  picture.aspect = sheet.aspect;
  picture.background = options.theme->background;
  picture.clips = {sheet.scene};
  draw_base(picture, {chain, skeleton, camera, look_of(skeleton, camera, *options.theme)}, kSceneClip);
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const double strength = i + 1 < poses.size() ? kOnionSkin : 1;
    const ChainLook look = look_of(skeleton, camera, *options.theme, strength);
    compute_kinematics(chain, ws, poses[i], at_rest);
    draw_rails(picture, {chain, skeleton, camera, look}, ws, kSceneClip);
    draw_links(picture, {chain, skeleton, camera, look}, ws, kSceneClip);
    draw_end_effector(picture, camera.project(tip_position(chain, ws)), look, kSceneClip);
  }
  draw_sheet(picture, sheet);
  return picture;
}

}  // namespace chainreel
