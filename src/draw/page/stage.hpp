// What a film shows, before anyone knows from where: the motions of its runs, and what all of them share.
#pragma once

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "draw/robot/body_shapes.hpp"
#include "draw/robot/fit.hpp"
#include "picture/text.hpp"
#include "picture/theme.hpp"
#include "scene/film_clock.hpp"
#include "scene/layers.hpp"
#include "scene/scene.hpp"
#include "sim/simulate.hpp"

namespace chainreel {

// References must outlive what is drawn from them.
struct PanelRun {
  const Scene& scene;
  const Chain& chain;
  const Trajectory& trajectory;
  const Simulation* simulation = nullptr;  // needed where torques or constraint forces are shown
  const BodyShapes* shapes = nullptr;      // drawn instead of bars
  double accurate_until = HUGE_VAL;        // s: until when its method promises what was asked for
  std::span<const Trajectory> references{};  // two runs of its motion, far more exact, of which one confirms the other; or none
  std::vector<double> change_points{};       // s, rising: where its constraints, independent elsewhere, depend on each other
};

// Pages that have no room for plots beside the scene: what they show stands one above the other.
inline bool is_narrow(const Scene& page) {
  return page.video.width < 1.2 * page.video.height;
}

// Outlines of links lie this far outside the edges of filled ones, units of H.
inline constexpr double kOutlineAway = 1.4 * size::kLinkOutline;

// How a run of a comparison is told apart from the others.
struct Variant {
  Color color;          // of its title, trail, curves, and outline
  std::string letter;   // of layout `ghost`: at the end of its chain, or ""
  bool outlined = false;  // of layout `ghost`: drawn over the first, without ground and marks
  std::shared_ptr<const Theme> theme;  // links in two tones of its colour
};

// Variant i of `count`; in the layout `ghost` with a letter where there are several outlines.
Variant variant_of(int i, int count, bool ghost, const Theme& theme);

// What is said of such instants.
inline constexpr char kRankLost[] = "constraints lose rank";
std::string words_of_stop(const LimitEvent& limit);  // "limit of elbow reached"

// What curves of a run show: its samples, and what lies between them where that was kept.
inline const Trajectory& curve_run_of(const Trajectory& run) {
  return run.between ? *run.between : run;
}

// One run's chain at each of its frames. Not shared between threads: poses use one workspace.
class StagedRun {
 public:
  // The first `samples` samples of the run are its frames. `counts`: the camera must hold all of it, not only its
  // start. `freezes`: where the run comes to no good end it stands still before it leaves its part of the page.
  StagedRun(const PanelRun& run, int samples, bool counts, bool freezes, std::optional<Variant> variant);

  const Scene& scene() const { return run_.scene; }
  const Chain& chain() const { return run_.chain; }
  const Trajectory& trajectory() const { return run_.trajectory; }
  const Simulation* simulation() const { return run_.simulation; }
  const BodyShapes* shapes() const { return run_.shapes; }
  double accurate_until() const { return run_.accurate_until; }
  std::span<const Trajectory> references() const { return run_.references; }
  const std::vector<double>& change_points() const { return run_.change_points; }
  bool is_constrained() const { return run_.simulation && !run_.simulation->constraints.empty(); }
  bool has_foot() const { return run_.simulation && run_.simulation->events && run_.simulation->events->foot; }
  const std::string& title() const { return title_; }  // of the scene, with what it says of this run
  const std::optional<Variant>& variant() const { return variant_; }
  const Theme& theme_of(const Theme& page) const { return variant_ ? *variant_->theme : page; }
  bool is_outlined() const { return variant_ && variant_->outlined; }

  int samples() const { return samples_; }
  // As many samples of it as there are until the end of the last of its frames.
  const Trajectory& curve_run() const { return curve_run_of(run_.trajectory); }
  int curve_samples() const;
  int counted() const { return counts_ ? samples_ : 1; }  // that the camera must hold
  bool counts() const { return counts_; }
  bool is_wild() const;  // the run did not come to an end that it should have
  bool may_freeze() const { return freezes_ && is_wild(); }
  std::optional<LimitEvent> stopping_limit() const;  // that ended the run, as `limit: stop` asks for
  bool may_have_notes() const { return may_freeze() || !run_.scene.events.empty() || !run_.change_points.empty() || stopping_limit(); }
  double limit() const { return limit_; }  // m; places beyond it belong to a run that diverged

  // Rails reach as far as the counted samples use them.
  const Skeleton& skeleton() const { return skeleton_; }
  void let_rails_reach(Skeleton& skeleton, int samples) const;

  // The chain as it stands at sample k, with its rates; good until the next call.
  const Workspace& pose_at(int k) const;
  const Workspace& curve_pose_at(int k) const;  // at a sample of curves; likewise
  // Lets the box hold some of the counted poses.
  void extend(MotionBox& box) const;

 private:
  PanelRun run_;
  int samples_;
  bool counts_, freezes_;
  std::optional<Variant> variant_;
  std::string title_;
  double limit_ = 0;
  Skeleton skeleton_;
  std::unique_ptr<Workspace> ws_;
  mutable int posed_ = -1;  // where the workspace stands
};

// Some of the samples of a clip, equally spaced: enough to decide on the scale of what all of them show.
std::vector<int> some_of(int samples);

// Which share of the length that they have where there is room for it the arrows of a layer have, by its name; 1 of those
// that are not named.
using ArrowShares = std::map<std::string_view, double>;

struct Stage {
  // `page` says what all panels share. Sample k of each trajectory is its frame k, shown at times[k]; the clock says
  // how fast the motion passes there. `has_plots`: of the page or of its story, whose curves have the colours of many variants.
  // Throws Error (bad input) where there is no frame.
  Stage(const Scene& page, const std::vector<PanelRun>& runs, std::vector<double> times, const Fonts& fonts,
        FilmClock clock, ArrowShares arrows = {}, bool has_plots = false);

  const Scene page;  // as it is drawn: its text_scale is that of its size
  const Fonts& fonts;
  const Theme& theme;
  std::vector<double> times;
  FilmClock clock;
  ArrowShares arrows;
  std::vector<StagedRun> motions;
  std::optional<MotionBox> space;  // around all that counts, where it takes an eye or a ground in space

  bool is_comparison() const { return motions.size() > 1; }
  bool is_ghost() const;  // all in one place, all but the first in outline
  bool has_cells() const { return is_comparison() && !is_ghost(); }
  // s: of the clip's end rather than of the last instant shown, so that a picture by itself has the film's layout.
  double latest_time() const { return std::max(page.duration, times.back()); }
  bool stands_still(int k) const;  // a frame of a pause, or an end that is held
  std::size_t full_panels() const { return is_ghost() ? 1 : motions.size(); }
  // Of the lengths, in units of H, that arrows and ellipses have alone on a page: panels share it, and one higher than wide
  // gives lengths by its width.
  double share_of_lengths() const;
  double share_of_arrows(std::string_view layer) const;
  bool shows(const LayerRow& layer) const;    // the page names it, or it is always there, and nothing forbids it
  bool shows(std::string_view name) const;    // the same of the layers of a name
};

}  // namespace chainreel
