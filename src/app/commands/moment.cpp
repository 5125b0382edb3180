#include "app/commands/moment.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "app/commands/render_film.hpp"
#include "app/report/alt_text.hpp"
#include "app/report/run_report.hpp"
#include "scene/run/fall.hpp"

namespace chainreel {
namespace {

// How many the whole film has as `render` shows it. `added`: an instant among those of the runs that is none
// of its frames.
int frames_of_film(const Runs& runs, std::optional<double> added) {
  double end = 0;
  for (const Trajectory& run : runs.list()) end = std::max(end, run.end_time);
  int frames = runs.frames_shown(int(runs.times().size()));
  // At the end itself it stands in the place of the sample that events leave there.
  if (added && *added < end - same_instant(runs.film().panels.front().simulation)) --frames;
  const Scene& scene = runs.film().scene;
  return std::min(frames, runs.clock().frame_count()) + frame_count(scene.hold.first, scene.video.fps) +
         frame_count(scene.hold.last, scene.video.fps);
}

Moment moment_of(const Runs& runs, int frame, std::optional<double> added, const Fonts& fonts) {
  const PreparedFilm& film = runs.film();
  runs.require_expected_ends(frame);
  int frames = int(runs.times().size());
  if (runs.size() == 1 && film.scene.expect == Outcome::finish) frames = std::min(frames, runs[0].size());
  const Film pictures = runs.pictures(frames, fonts);
  Moment moment;
  moment.at = runs.times()[std::size_t(frame)];
  moment.picture = pictures.static_layer();
  moment.picture.append(pictures.frame(frame));
  moment.title = runs.size() == 1 ? title_of(film.panels.front().scene, runs[0]) : film.scene.title;
  FilmReport report = film_report(runs, pictures, frames_of_film(runs, added));
  report.writes = Writes::pictures;
  moment.memory = memory_of(report);
  moment.memory.audit["at"] = moment.at;
  moment.warnings = warning_lines(report);
  return moment;
}

std::optional<double> last_event(const std::vector<Trajectory>& runs) {
  std::optional<double> last;
  for (const Trajectory& run : runs)
    for (const double t : run.events.t) last = std::max(last.value_or(t), t);
  return last;
}

}  // namespace

Moment moment_at(const PreparedFilm& film, double at, const Fonts& fonts) {
  const FilmClock clock = clock_of(film);
  std::vector<double> times = clock.frame_times();
  const double same = same_instant(film.panels.front().simulation);
  auto place = std::lower_bound(times.begin(), times.end(), at - same);
  std::optional<double> added;
  if (place == times.end() || std::abs(*place - at) > same) {
    place = times.insert(place, at);
    added = at;
  }
  const int frame = int(place - times.begin());
  return moment_of(Runs(film, clock, std::move(times)), frame, added, fonts);
}

Moment telling_moment(const PreparedFilm& film, const Fonts& fonts) {
  const FilmClock clock = clock_of(film);
  const Runs runs(film, clock, clock.frame_times());
  // An event between two frames, or behind the last one, has an instant of its own.
  if (const std::optional<double> event = last_event(runs.list())) return moment_at(film, *event, fonts);
  int samples = 0;
  for (const Trajectory& run : runs.list()) samples = std::max(samples, run.size());
  return moment_of(runs, samples / 2, {}, fonts);
}

}  // namespace chainreel
