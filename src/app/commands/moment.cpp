#include "app/commands/moment.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "app/commands/render_film.hpp"
#include "app/report/alt_text.hpp"
#include "app/report/run_report.hpp"
#include "core/error.hpp"
#include "scene/run/fall.hpp"

namespace chainreel {
namespace {

// How many the whole film has as `render` shows it. `added`: instants among those of the runs that are none
// of its frames.
int frames_of_film(const Runs& runs, const std::vector<double>& added) {
  double end = 0;
  for (const Trajectory& run : runs.list()) end = std::max(end, run.end_time);
  int frames = runs.frames_shown(int(runs.times().size()));
  // At the end itself one stands in the place of the sample that events leave there.
  for (const double at : added)
    if (at < end - same_instant(runs.film().panels.front().simulation)) --frames;
  const Scene& scene = runs.film().scene;
  return std::min(frames, runs.clock().frame_count()) + frame_count(scene.hold.first, scene.video.fps) +
         frame_count(scene.hold.last, scene.video.fps);
}

// Sorted, among those of the frames; `added` are those that were none of them.
struct Instants {
  std::vector<double> times, added;
  std::vector<int> frames;  // of each that is asked for
};

Instants instants_of(const PreparedFilm& film, const FilmClock& clock, const std::vector<double>& asked) {
  Instants instants{clock.frame_times(), {}, {}};
  const double same = same_instant(film.panels.front().simulation);
  const auto place_of = [&](double at) {
    return std::lower_bound(instants.times.begin(), instants.times.end(), at - same);
  };
  for (const double at : asked) {
    const auto place = place_of(at);
    if (place != instants.times.end() && std::abs(*place - at) <= same) continue;
    instants.times.insert(place, at);
    instants.added.push_back(at);
  }
  for (const double at : asked) instants.frames.push_back(int(place_of(at) - instants.times.begin()));
  return instants;
}

std::optional<double> last_event(const std::vector<Trajectory>& runs) {
  std::optional<double> last;
  for (const Trajectory& run : runs)
    for (const double t : run.events.t) last = std::max(last.value_or(t), t);
  return last;
}

}  // namespace

struct Moments::State {
  const PreparedFilm& film;
  std::vector<int> frames;
  Runs runs;
  Film pictures;
  FilmReport report;
  ClipMemory memory;
  std::vector<std::string> warnings;

  State(const PreparedFilm& of, FilmClock clock, Instants instants, const Fonts& fonts)
      : film(of),
        frames(std::move(instants.frames)),
        runs(film, std::move(clock), std::move(instants.times)),
        pictures(runs.pictures(frames_drawn(), fonts)),
        report(film_report(runs, pictures, frames_of_film(runs, instants.added))) {
    report.writes = Writes::pictures;
    memory = memory_of(report);
    warnings = warning_lines(report);
  }

  // Those that every run shows that must come to its end.
  int frames_drawn() const {
    for (const int frame : frames) runs.require_expected_ends(frame);
    const int all = int(runs.times().size());
    return runs.size() == 1 && film.scene.expect == Outcome::finish ? std::min(all, runs[0].size()) : all;
  }
};

Moments::Moments(const PreparedFilm& film, const std::vector<double>& at, const Fonts& fonts) {
  FilmClock clock = clock_of(film);
  Instants instants = instants_of(film, clock, at);
  state_ = std::make_unique<State>(film, std::move(clock), std::move(instants), fonts);
}

Moments::~Moments() = default;

Moment Moments::moment(std::size_t i) const {
  const State& state = *state_;
  const int frame = state.frames[i];
  Moment moment;
  moment.at = state.runs.times()[std::size_t(frame)];
  moment.picture = state.pictures.static_layer();
  moment.picture.append(state.pictures.frame(frame));
  moment.title = state.runs.size() == 1 ? title_of(state.film.panels.front().scene, state.runs[0])
                                        : state.film.scene.title;
  moment.memory = state.memory;
  moment.memory.audit["at"] = moment.at;
  moment.warnings = state.warnings;
  return moment;
}

Moment moment_at(const PreparedFilm& film, double at, const Fonts& fonts) {
  return Moments(film, {at}, fonts).moment(0);
}

Moment telling_moment(const PreparedFilm& film, const Fonts& fonts) {
  const FilmClock clock = clock_of(film);
  const Runs runs(film, clock, clock.frame_times());
  // An event between two frames, or behind the last one, has an instant of its own.
  if (const std::optional<double> event = last_event(runs.list())) return moment_at(film, *event, fonts);
  int samples = 0;
  for (const Trajectory& run : runs.list()) samples = std::max(samples, run.size());
  return moment_at(film, runs.times()[std::size_t(samples / 2)], fonts);
}

std::vector<double> instants_asked(const PreparedFilm& film, const std::vector<AskedInstant>& asked) {
  std::optional<Runs> runs;
  std::vector<double> instants;
  for (const AskedInstant& one : asked) {
    if (const std::string trouble = trouble_of_instant(one, film.scene); !trouble.empty())
      throw Error(ExitCode::usage, "--at " + one.text + ": " + trouble);
    if (one.event.empty()) {
      instants.push_back(one.at);
      continue;
    }
    if (!runs) runs.emplace(film);
    std::optional<double> first;
    for (std::size_t panel = 0; panel < runs->size(); ++panel) {
      const EventHits& hits = (*runs)[panel].events;
      for (int k = 0; k < hits.size(); ++k)
        if (film.panels[panel].scene.events[std::size_t(hits.event[std::size_t(k)])].title() == one.event)
          first = std::min(first.value_or(hits.t[std::size_t(k)]), hits.t[std::size_t(k)]);
    }
    if (!first)
      throw Error(ExitCode::bad_input, "--at " + one.text + ": the event does not happen in this run",
                  {film.scene.file});
    instants.push_back(*first);
  }
  return instants;
}

}  // namespace chainreel
