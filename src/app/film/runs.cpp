#include "app/film/runs.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "app/cli/streams.hpp"
#include "app/film/progress.hpp"
#include "core/error.hpp"
#include "core/format.hpp"
#include "picture/formula_words.hpp"
#include "scene/run/title.hpp"
#include "scene/slow_motion.hpp"
#include "sim/rank_loss.hpp"

namespace chainreel {
namespace {

// The frames' instants, and the end of the motion for tables and the audit.
std::vector<double> with_end(std::vector<double> times, const PreparedFilm& film) {
  const double end = film.scene.duration;
  if (times.back() < end - same_instant(film.panels.front().simulation)) times.push_back(end);
  return times;
}

// The instants of the frames; where events ended all runs, the last frame stands at the last of them.
std::vector<double> shown_times(const std::vector<Trajectory>& runs, const std::vector<double>& times,
                                int frames) {
  std::vector<double> shown(times.begin(), times.begin() + frames);
  double end = 0;
  for (const Trajectory& run : runs) {
    if (run.status != RunStatus::stopped) return shown;
    end = std::max(end, run.end_time);
  }
  for (double& time : shown) time = std::min(time, end);
  return shown;
}

// How far apart curves of plots are looked at between frames, s: so near that a sharp peak of multipliers is drawn within half a
// pixel of 1920, where that is nearer than frames are. On pages of every size it is the same, or words that name a curve's largest number would
// depend on it; wider ones have plots of a part of their width.
double between_of(const PreparedFilm& film) {
  constexpr double kPartsOfClip = 2 * 1920;
  return film.scene.duration / kPartsOfClip;
}

// A trajectory a panel, at these instants; unless it is only looked at for the clock, with its energy at steps.
enum class RunUse { whole, for_clock };
std::vector<Trajectory> runs_of(const PreparedFilm& film, const std::vector<double>& times, RunUse use = RunUse::whole) {
  std::vector<Trajectory> list;
  Ticker ticker(film.quiet);
  for (const PreparedScene& panel : film.panels) {
    const auto part_of_all = [&](double t) {
      return (double(list.size()) + part_done(panel.simulation, t)) / double(film.panels.size());
    };
    const auto stop = [&](double t) {
      if (ticker.is_due()) ticker.say(simulating_text(film, panel), part_of_all(t));
      return interrupted();
    };
    list.push_back(use == RunUse::whole ? simulate_audited(panel.simulation, times, stop, between_of(film)) : simulate(panel.simulation, times, stop));
    throw_if_interrupted();
  }
  return list;
}

// Whether the film must know its motion to find out where it is slow by itself. Not where no words can say that it is,
// unless the scene asks for it.
bool may_slow_down(const PreparedFilm& film) {
  const std::optional<SlowMotionRule>& rule = film.scene.slow_motion_rule;
  if (!rule || (is_transparent(film.scene) && !rule->is_asked)) return false;
  return std::any_of(film.panels.begin(), film.panels.end(), [](const PreparedScene& panel) {
    return may_be_hasty(panel.scene, panel.simulation.chain);
  });
}

// Instants at which constraints lose rank, s, of each panel. Of a recorded motion nothing is stepped anew.
std::vector<std::vector<double>> change_points_of(const PreparedFilm& film, const std::vector<Trajectory>& runs) {
  std::vector<std::vector<double>> all(runs.size());
  for (std::size_t i = 0; i < runs.size(); ++i) {
    if (film.panels[i].simulation.motion || !is_complete(runs[i].status)) continue;
    for (const RankLoss& loss : rank_losses_of(film.panels[i].simulation, runs[i])) all[i].push_back(loss.t);
    throw_if_interrupted();
  }
  return all;
}

// By the runs of all panels at the frames of their own speed.
std::vector<Stretch> own_stretches(const PreparedFilm& film, const std::vector<Trajectory>& runs) {
  const SlowMotionRule& rule = *film.scene.slow_motion_rule;
  std::vector<Haste> events, turns;
  const std::vector<std::vector<double>> change_points = change_points_of(film, runs);
  double end = 0;
  for (std::size_t i = 0; i < runs.size(); ++i) {
    const PreparedScene& panel = film.panels[i];
    std::ranges::move(notable_instants(panel.scene, runs[i], change_points[i]), std::back_inserter(events));
    std::ranges::move(fast_turns(panel.simulation.chain, runs[i], rule.turn, film.scene.video.fps), std::back_inserter(turns));
    if (is_complete(runs[i].status)) end = std::max(end, runs[i].end_time);
  }
  return end > 0 ? stretches_by(rule, end, events, turns) : std::vector<Stretch>{};
}

// `runs`: as above; null where none was needed for that.
FilmClock clock_after(const PreparedFilm& film, const std::vector<Trajectory>* runs) {
  const Scene& scene = film.scene;
  std::vector<EventHits> hits(film.panels.size());
  std::vector<RunEvents> panels;
  const auto is_of_event = [](const auto& entry) { return !entry.event.empty(); };
  const bool slows_at_events = std::ranges::any_of(scene.slow_motion, is_of_event);  // of the first panel
  for (std::size_t i = 0; i < hits.size(); ++i) {
    const auto is_of_panel = [&](const AnnotationEntry& entry) { return is_of_event(entry) && std::size_t(entry.panel) == i + 1; };
    if (runs != nullptr)
      hits[i] = (*runs)[i].events;
    else if ((i == 0 && slows_at_events) || std::ranges::any_of(scene.annotate, is_of_panel))
      hits[i] = simulate(film.panels[i].simulation, {}, [](double) { return interrupted(); }).events;
    throw_if_interrupted();
    panels.push_back({&film.panels[i].scene.events, &hits[i]});
  }
  const FilmClock clock(scene.duration, scene.video.fps,
                        runs != nullptr ? own_stretches(film, *runs) : stretches_of(scene.slow_motion, film.panels.front().scene.events, hits.front()),
                        pauses_of(scene.annotate, panels));
  if (clock.is_plain()) return clock;
  const double frames = clock.film_seconds() * scene.video.fps.value();
  if (frames > kMostFrames)
    throw Error(ExitCode::limit, "slow motion and pauses make a film of more than ten million frames",
                scene.place_of(scene.slow_motion.empty() ? "annotate" : "slow_motion"));
  if (frames < 0.5)
    throw Error(ExitCode::bad_input, "slow motion leaves less than half a frame: the film would be empty",
                scene.place_of("slow_motion"));
  return clock;
}

}  // namespace

std::vector<double> plain_times(const PreparedFilm& film) {
  return with_end(frame_times(film.scene), film);
}

FilmClock clock_of(const PreparedFilm& film) {
  if (!may_slow_down(film)) return clock_after(film, nullptr);
  const std::vector<Trajectory> runs = runs_of(film, plain_times(film), RunUse::for_clock);
  return clock_after(film, &runs);
}

std::vector<RunEvents> events_of(const Runs& runs) {
  std::vector<RunEvents> panels;
  for (std::size_t i = 0; i < runs.size(); ++i) panels.push_back({&runs.film().panels[i].scene.events, &runs[i].events});
  return panels;
}

std::string simulating_text(const PreparedFilm& film, const PreparedScene& panel) {
  return film.scene.name + ": simulating" + (film.panels.size() == 1 ? "" : " '" + panel.scene.title + "'");
}

Runs::Runs(const PreparedFilm& film, OwnSlowMotion own) : film_(film) {
  if (may_slow_down(film)) {
    times_ = plain_times(film);
    list_ = runs_of(film, times_);
    clock_ = clock_after(film, &list_);
    if (clock_.is_plain()) return;  // these are its frames
    leaves_slow_motion_out_ = own == OwnSlowMotion::left_out && !clock_.stretches().empty();
    if (leaves_slow_motion_out_) {
      clock_ = FilmClock(film.scene.duration, film.scene.video.fps);
      return;
    }
  } else {
    clock_ = clock_after(film, nullptr);
  }
  times_ = with_end(clock_.frame_times(), film);
  list_ = runs_of(film, times_);
}

Runs::Runs(const PreparedFilm& film, FilmClock clock, std::vector<double> times)
    : film_(film), clock_(std::move(clock)), times_(std::move(times)), list_(runs_of(film, times_)) {}

int Runs::frames_shown(int frames) const {
  int shown = 0;
  for (std::size_t i = 0; i < list_.size(); ++i) {
    const bool stands = list_[i].status == RunStatus::diverged && film_.panels[i].scene.expect == Outcome::diverge;
    shown = std::max(shown, stands ? frames : std::min(frames, list_[i].size()));
  }
  return shown;
}

namespace {

// s, by the method that was chosen.
double promised_until(const PreparedScene& panel) {
  if (!panel.choice) return HUGE_VAL;
  return panel.choice->is_met ? panel.choice->holds_until.value_or(HUGE_VAL) : 0;
}

}  // namespace

void Runs::run_references() const {
  if (!references_.empty()) return;
  for (const Simulation& reference : film_.references) {
    references_.push_back(simulate(reference, times_, [](double) { return interrupted(); }, {}, between_of(film_)));
    throw_if_interrupted();
  }
}

void Runs::find_change_points() const {
  if (!change_points_.empty()) return;
  change_points_ = change_points_of(film_, list_);
}

std::vector<PanelRun> Runs::panels() const {
  run_references();
  find_change_points();
  std::vector<PanelRun> panels;
  for (std::size_t i = 0; i < list_.size(); ++i)
    panels.push_back({film_.panels[i].scene, film_.panels[i].simulation.chain, list_[i],
                      &film_.panels[i].simulation, film_.panels[i].shapes.get(), promised_until(film_.panels[i]), references_, change_points_[i]});
  return panels;
}

Film Runs::pictures(int frames, const Fonts& fonts) const {
  return Film(film_.scene, panels(), shown_times(list_, times_, frames), fonts, clock_);
}

Composition Runs::composition(const Scene& page, int frames, const Fonts& fonts) const {
  return compose(page, panels(), shown_times(list_, times_, frames), fonts, clock_);
}

std::string in_panel(const Scene& scene, const Trajectory& trajectory, std::size_t i, const std::string& message) {
  return "panel " + std::to_string(i + 1) + " (" + in_plain_words(title_of(scene, nullptr, trajectory)) + "): " + message;
}

// What its author can do about a run that failed.
std::string remedy_of(const Trajectory& trajectory, const Scene& scene) {
  if (scene.motion) return "";
  if (trajectory.status == RunStatus::torque_not_finite && scene.control && scene.control->function)
    return ": " + scene.control->function->words + " must give finite numbers, N m or N, wherever q and qd are finite";
  if (trajectory.status == RunStatus::inconsistent && trajectory.end_time <= 0)
    return ": the rates of the start lead off the constraints, as where ways cross. Name fewer of them, `start: {qd: {joint: 1}}`, so that the others follow, or start elsewhere";
  return ": try a smaller step or another method";
}

std::vector<LimitEvent> unexpected_limits(const Trajectory& trajectory, const Scene& scene) {
  std::vector<LimitEvent> passed;
  if (scene.expect == Outcome::within_limits)
    std::ranges::copy_if(trajectory.limits, std::back_inserter(passed), [&](const LimitEvent& one) { return !is_cut(one, scene.limit); });
  return passed;
}

void require_expected_end(const Trajectory& trajectory, const Scene& scene) {
  throw_if_interrupted();
  if (scene.expect == Outcome::diverge) {
    if (trajectory.status == RunStatus::diverged) return;
    if (is_complete(trajectory.status))
      throw Error(ExitCode::numerical,
                  "the run was expected to diverge, but " + to_string(trajectory.status) +
                      " at t = " + format_shortest(trajectory.end_time) + " s with " + method_text(scene),
                  scene.place_of("expect"));
  }
  if (is_complete(trajectory.status)) {
    const std::vector<LimitEvent> passed = unexpected_limits(trajectory, scene);
    if (passed.empty()) return;
    constexpr std::size_t kTold = 4;
    std::string limits;
    for (std::size_t i = 0; i < std::min(passed.size(), kTold); ++i) limits += (i == 0 ? "" : "; ") + to_string(passed[i]);
    if (passed.size() > kTold) limits += "; and " + std::to_string(passed.size() - kTold) + " more";
    throw Error(ExitCode::limit, limits + ": `expect: within_limits` stands there (--set expect=finish shows the run)", scene.place_of("expect"));
  }
  throw Error(ExitCode::numerical,
              trajectory.trouble + " with " + method_text(scene) + remedy_of(trajectory, scene),
              {scene.file});
}

namespace {

// What a still says of a run that goes on behind it.
bool is_within_limits_until(const Trajectory& trajectory, const Scene& scene, int frame) {
  const std::vector<LimitEvent> passed = unexpected_limits(trajectory, scene);
  return passed.empty() || passed.front().t > trajectory.t[std::size_t(frame)];
}

}  // namespace

void Runs::require_expected_ends(std::optional<int> frame) const {
  std::vector<Problem> problems;
  ExitCode code = ExitCode::numerical;
  for (std::size_t i = 0; i < list_.size(); ++i) {
    const Scene& scene = film_.panels[i].scene;
    if (frame && *frame < list_[i].size() && scene.expect != Outcome::diverge && is_within_limits_until(list_[i], scene, *frame)) continue;
    try {
      require_expected_end(list_[i], scene);
    } catch (const Error& error) {
      if (error.code() != ExitCode::numerical && error.code() != ExitCode::limit) throw;  // a signal
      if (problems.empty()) code = error.code();
      const Problem& problem = error.problems().front();
      problems.push_back(
          {list_.size() == 1 ? problem.message : in_panel(scene, list_[i], i, problem.message), problem.place});
    }
  }
  if (!problems.empty()) throw Error(code, std::move(problems));
}

}  // namespace chainreel
