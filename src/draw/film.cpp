#include "draw/film.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/error.hpp"
#include "core/format.hpp"
#include "draw/chain.hpp"
#include "draw/chain_fit.hpp"
#include "draw/joints.hpp"
#include "draw/metre_bar.hpp"
#include "draw/torque_label.hpp"
#include "draw/view.hpp"
#include "dynamics/kinematics.hpp"

namespace chainreel {
namespace {

constexpr double kWild =
    100;  // lengths of the chain: beyond, a run that did not finish is left out of the fit
constexpr int kScaleSamples = 200;    // of a clip decide on the scale of its ellipses
constexpr double kEllipseBar = 0.10;  // units of H: the smaller semi-axis measures about as much
constexpr int kSceneClip = 0;

}  // namespace

Film::Layers Film::layers_of(const Scene& scene) {
  const auto named = [&](const char* name) {
    return std::find(scene.draw.begin(), scene.draw.end(), name) != scene.draw.end();
  };
  return {named("chain"),        named("trail"),   named("time"),      named("title"),
          named("torque_label"), named("ellipse"), named("scale_bar"), named("legend")};
}

Film::Film(const Scene& scene, const Chain& chain, const Trajectory& trajectory, int frames,
           const Fonts& fonts)
    : scene_(scene),
      chain_(chain),
      trajectory_(trajectory),
      fonts_(fonts),
      theme_(light_theme()),
      layers_(layers_of(scene)),
      samples_(std::min(frames, trajectory.size())),
      skeleton_(skeleton_of(chain)),
      ws_(std::make_unique<Workspace>(chain)) {
  if (samples_ < 1)
    throw Error(ExitCode::bad_input, "a film needs at least one frame", scene.place_of("duration"));
  // A run that finished is drawn wherever it went: a free fall may be long.
  limit_ =
      trajectory.status == RunStatus::finished ? std::numeric_limits<double>::max() : kWild * skeleton_.reach;
  find_rails();
  if (layers_.ellipse) find_mass_scale();
  lay_out();
  fit_camera();
  look_ = look_of(skeleton_, camera_, theme_);
  follow_tip();
}

void Film::find_rails() {
  for (int k = 0; k < samples_; ++k) widen_rails(skeleton_, chain_, trajectory_.q_at(k), limit_);
}

void Film::find_mass_scale() {
  const int count = std::min(samples_, kScaleSamples);
  std::vector<double> smaller;
  for (int i = 0; i < count; ++i) {
    const int k = int(std::int64_t(i) * samples_ / count);
    const auto mass = smallest_mass(
        mass_axes(effective_mass_of(chain_, *ws_, trajectory_.q_at(k), chain_.end_effector, Task::linear)));
    if (mass) smaller.push_back(*mass);
  }
  mass_scale_ = mass_scale(std::move(smaller), kEllipseBar);
}

void Film::lay_out() {
  SheetText text;
  text.title_place = scene_.place_of("title");
  if (layers_.title) text.title = scene_.title;
  if (layers_.torque_label) text.torque = torque_notations(chain_, scene_.torque, scene_.control);
  if (layers_.time) text.longest_time = time_text(trajectory_.t[std::size_t(samples_) - 1]);
  if (layers_.ellipse) {
    text.bar = format_shortest(mass_scale_.bar_kg) + " kg";
    text.bar_length = mass_scale_.bar_length;
  }
  if (layers_.ellipse && layers_.legend) text.legend = kEllipseLegend;
  const double aspect = double(scene_.video.width) / scene_.video.height;
  sheet_ = lay_out_sheet(text, aspect, scene_.text_scale, theme_, fonts_);
}

void Film::fit_camera() {
  camera_ = view_of(chain_);
  ChainFit fit(chain_, skeleton_, camera_);
  for (int k = 0; k < samples_; ++k) {
    compute_kinematics(chain_, *ws_, trajectory_.q_at(k), trajectory_.qd_at(k));
    fit.add_pose(*ws_, limit_);
  }
  fit_to(camera_, fit.box(), sheet_.scene, size::kFitMargin);
}

void Film::follow_tip() {
  for (int k = 0; k < samples_; ++k) {
    compute_kinematics(chain_, *ws_, trajectory_.q_at(k), trajectory_.qd_at(k));
    tip_.add(trajectory_.t[std::size_t(k)], camera_.project(tip_position(chain_, *ws_)),
             camera_.project_vector(frame_velocity(chain_, *ws_, chain_.end_effector)));
  }
}

Picture Film::page() const {
  Picture picture;
  picture.aspect = sheet_.aspect;
  picture.background = theme_.background;
  picture.clips = {sheet_.scene};
  return picture;
}

Picture Film::static_layer() const {
  Picture picture = page();
  if (layers_.chain) draw_base(picture, {chain_, skeleton_, camera_, look_}, kSceneClip);
  if (layers_.scale_bar) draw_metre_bar(picture, camera_, sheet_, fonts_);
  draw_sheet(picture, sheet_);
  return picture;
}

Picture Film::frame(int k) const {
  k = std::clamp(k, 0, samples_ - 1);
  compute_kinematics(chain_, *ws_, trajectory_.q_at(k), trajectory_.qd_at(k));
  Picture picture = page();
  const Color trail = theme_.curve[std::size_t(std::max(chain_.nv, 1) - 1) % theme_.curve.size()];
  const ChainDrawing drawing{chain_, skeleton_, camera_, look_};
  if (layers_.chain) draw_rails(picture, drawing, *ws_, kSceneClip);
  if (layers_.trail) draw_trail(picture, tip_, k, trail, kSceneClip);
  if (layers_.chain) draw_links(picture, drawing, *ws_, kSceneClip);
  const Point tip = tip_.place(k);
  if (layers_.ellipse) {
    const EllipseStyle style{&theme_, &fonts_, scene_.text_scale, mass_scale_.per_kg(), sheet_.scene};
    draw_mass_ellipse(
        picture,
        mass_axes(effective_mass_of(chain_, *ws_, trajectory_.q_at(k), chain_.end_effector, Task::linear)),
        tip, camera_, style, kSceneClip);
  }
  if (layers_.chain) draw_end_effector(picture, tip, look_, kSceneClip);
  if (layers_.time) draw_time(picture, sheet_, trajectory_.t[std::size_t(k)], fonts_);
  return picture;
}

}  // namespace chainreel
