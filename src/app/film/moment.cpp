#include "app/film/moment.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "app/film/render_film.hpp"
#include "app/report/report.hpp"
#include "scene/fall.hpp"

namespace chainreel {
namespace {

// Of the whole film as `render` shows it. `added`: an instant among `times` that is none of its frames.
int frames_of_film(const PreparedFilm& film, const std::vector<Trajectory>& runs,
                   const std::vector<double>& times, std::optional<double> added, const FilmClock& clock) {
  double end = 0;
  for (const Trajectory& run : runs) end = std::max(end, run.end_time);
  int frames = frames_shown(film, runs, int(times.size()));
  // At the end itself it stands in the place of the sample that events leave there.
  if (added && *added < end - same_instant(film.panels.front().simulation)) --frames;
  const Scene& scene = film.scene;
  return std::min(frames, clock.frame_count()) + frame_count(scene.hold.first, scene.video.fps) +
         frame_count(scene.hold.last, scene.video.fps);
}

Moment moment_of(const PreparedFilm& film, const std::vector<Trajectory>& runs,
                 const std::vector<double>& times, int frame, std::optional<double> added,
                 const FilmClock& clock, const Fonts& fonts) {
  require_expected_ends(film, runs, frame);
  int frames = int(times.size());
  if (runs.size() == 1 && film.scene.expect == "finish") frames = std::min(frames, runs.front().size());
  const Film pictures = film_of(film, runs, times, frames, fonts, clock);
  Moment moment;
  moment.at = times[std::size_t(frame)];
  moment.picture = pictures.static_layer();
  moment.picture.append(pictures.frame(frame));
  moment.title = runs.size() == 1 ? title_of(film.panels.front().scene, runs.front()) : film.scene.title;
  Json audit = film_report(film, runs, pictures, frames_of_film(film, runs, times, added, clock));
  audit["at"] = moment.at;
  moment.memory = memory_of(film, audit);
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
  return moment_of(film, simulate_film(film, times), times, frame, added, clock, fonts);
}

Moment telling_moment(const PreparedFilm& film, const Fonts& fonts) {
  const FilmClock clock = clock_of(film);
  const std::vector<double> times = clock.frame_times();
  const std::vector<Trajectory> runs = simulate_film(film, times);
  // An event between two frames, or behind the last one, has an instant of its own.
  if (const std::optional<double> event = last_event(runs)) return moment_at(film, *event, fonts);
  int samples = 0;
  for (const Trajectory& run : runs) samples = std::max(samples, run.size());
  return moment_of(film, runs, times, samples / 2, {}, clock, fonts);
}

}  // namespace chainreel
