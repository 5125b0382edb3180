#include "draw/page/stage.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/error.hpp"
#include "draw/page/house_style.hpp"
#include "draw/robot/chain_fit.hpp"
#include "draw/robot/view.hpp"
#include "dynamics/kinematics.hpp"
#include "picture/plot.hpp"
#include "scene/layers.hpp"
#include "scene/run/title.hpp"

namespace chainreel {
namespace {

constexpr double kWild =
    100;  // lengths of the chain: beyond, a run that did not finish is left out of the fit
constexpr int kMostColours = 4;  // of variants in panels of their own: more would have the colours of vectors, and tell nothing without a plot
constexpr double kFirstTone = 0.72, kSecondTone = 0.38;  // of a variant's colour in its links
constexpr int kScaleSamples = 200;  // of a clip decide on the scale of what it shows

Color between(Color from, Color to, double share) {
  const auto mix = [&](std::uint8_t a, std::uint8_t b) { return std::uint8_t(std::lround(a + share * (double(b) - a))); };
  return {mix(from.r, to.r), mix(from.g, to.g), mix(from.b, to.b), to.a};
}

}  // namespace

Variant variant_of(int i, int count, bool ghost, const Theme& theme) {
  const Color color = variant_color(theme, i, count);
  auto own = std::make_shared<Theme>(theme);
  for (std::size_t link = 0; link < own->link.size(); ++link)
    own->link[link] = between(theme.background, color, link % 2 == 0 ? kFirstTone : kSecondTone);
  return {color, ghost && i > 0 && count > 2 ? std::string(1, char('A' + i)) : "", ghost && i > 0, std::move(own)};
}

std::vector<int> some_of(int samples) {
  std::vector<int> some;
  const int count = std::min(samples, kScaleSamples);
  for (int i = 0; i < count; ++i) some.push_back(int(std::int64_t(i) * samples / count));
  return some;
}

StagedRun::StagedRun(const PanelRun& run, int samples, bool counts, bool freezes, std::optional<Variant> variant)
    : run_(run),
      samples_(samples),
      counts_(counts),
      freezes_(freezes),
      variant_(std::move(variant)),
      title_(title_of(run.scene, run.simulation, run.trajectory)),
      skeleton_(skeleton_of(run.chain)),
      ws_(std::make_unique<Workspace>(run.chain)) {
  // A run that finished is drawn wherever it went: a free fall may be long.
  limit_ = run.trajectory.status == RunStatus::finished ? std::numeric_limits<double>::max()
                                                        : kWild * skeleton_.reach;
  let_rails_reach(skeleton_, counted());
}

int StagedRun::curve_samples() const {
  if (samples_ == 0) return samples_;
  constexpr double kSameEnd = 1e-6;  // of a frame: sums of frames are no exact multiples
  const std::vector<double>&frames = run_.trajectory.t, &t = curve_run().t;
  const double last = frames[std::size_t(samples_) - 1], frame = samples_ > 1 ? last - frames[std::size_t(samples_) - 2] : 0;
  return int(std::upper_bound(t.begin(), t.end(), last + (1 + kSameEnd) * frame) - t.begin());
}

std::string words_of_stop(const LimitEvent& limit) {
  return (limit.quantity == "position" ? "" : limit.quantity + " ") + "limit of " + limit.joint + " reached";
}

std::optional<LimitEvent> StagedRun::stopping_limit() const {
  const Trajectory& run = run_.trajectory;
  if (run.status != RunStatus::stopped || run.ending_event >= 0 || run.limits.empty()) return {};
  return run.limits.back();
}

bool StagedRun::is_wild() const {
  return !is_complete(run_.trajectory.status);
}

void StagedRun::let_rails_reach(Skeleton& skeleton, int samples) const {
  for (int k = 0; k < samples; ++k) widen_rails(skeleton, run_.chain, run_.trajectory.q_at(k), limit_);
}

const Workspace& StagedRun::pose_at(int k) const {
  if (k != posed_) compute_kinematics(run_.chain, *ws_, run_.trajectory.q_at(k), run_.trajectory.qd_at(k));
  posed_ = k;
  return *ws_;
}

const Workspace& StagedRun::curve_pose_at(int k) const {
  compute_kinematics(run_.chain, *ws_, curve_run().q_at(k), curve_run().qd_at(k));
  posed_ = -1;
  return *ws_;
}

void StagedRun::extend(MotionBox& box) const {
  for (const int k : some_of(counted()))
    chainreel::extend(box, run_.chain, skeleton_, run_.shapes, pose_at(k), limit_);
}

Stage::Stage(const Scene& shown_page, const std::vector<PanelRun>& runs, std::vector<double> shown_times,
             const Fonts& all_fonts, FilmClock film_clock, ArrowShares shares, bool has_plots)
    : page(shown_page),
      fonts(all_fonts),
      theme(page_theme(page)),
      times(std::move(shown_times)),
      clock(std::move(film_clock)),
      arrows(std::move(shares)) {
  const int count = int(runs.size());
  const bool ghost = count > 1 && is_ghost_layout(page);
  const bool has_colours = count > 1 && (count <= kMostColours || has_plots);
  const auto is_good = [](const PanelRun& run) { return is_complete(run.trajectory.status); };
  const bool any_good = std::any_of(runs.begin(), runs.end(), is_good);
  for (int i = 0; i < count; ++i) {
    const PanelRun& run = runs[std::size_t(i)];
    const int samples = std::min(int(times.size()), run.trajectory.size());
    if (samples < 1)
      throw Error(ExitCode::bad_input, "a film needs at least one frame", page.place_of("duration"));
    motions.emplace_back(run, samples, is_good(run) || !any_good, count > 1 || run.scene.expect == Outcome::diverge,
                         has_colours ? std::optional(variant_of(i, count, ghost, theme)) : std::nullopt);
  }
  const Chain& first = motions.front().chain();
  if (!is_oblique(first, page.camera) && !has_eye(first, page.camera)) return;
  space.emplace(up_of(first));
  for (const StagedRun& motion : motions)
    if (motion.counts()) motion.extend(*space);
}

bool Stage::is_ghost() const {
  return is_comparison() && motions.back().is_outlined();
}

bool Stage::stands_still(int k) const {
  const auto at = std::size_t(k);
  if ((at == 0 && page.hold.first > 0) || (at + 1 == times.size() && page.hold.last > 0)) return true;
  return (at > 0 && times[at - 1] == times[at]) || (at + 1 < times.size() && times[at + 1] == times[at]);
}

double Stage::share_of_lengths() const {
  return std::min(1.0, double(page.video.width) / page.video.height) / std::sqrt(double(full_panels()));
}

double Stage::share_of_arrows(std::string_view layer) const {
  const auto known = arrows.find(layer);
  return known == arrows.end() ? 1 : known->second;
}

bool Stage::shows(const LayerRow& layer) const {
  if (is_transparent(page) && layer.needs == LayerNeeds::words) return false;
  const auto& named = page.draw;
  return *layer.name == 0 || std::find(named.begin(), named.end(), layer.name) != named.end();
}

bool Stage::shows(std::string_view name) const {
  return std::any_of(std::begin(kLayerRows), std::end(kLayerRows),
                     [&](const LayerRow& layer) { return layer.name == name && shows(layer); });
}

}  // namespace chainreel
