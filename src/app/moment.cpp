#include "app/moment.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "app/render_film.hpp"
#include "app/report.hpp"
#include "scene/fall.hpp"

namespace chainreel {
namespace {

Moment moment_of(const PreparedFilm& film, const std::vector<Trajectory>& runs,
                 const std::vector<double>& times, int frame, const FilmClock& clock, const Fonts& fonts) {
  require_expected_ends(film, runs, frame);
  int frames = int(times.size());
  if (runs.size() == 1 && film.scene.expect == "finish") frames = std::min(frames, runs.front().size());
  const Film pictures = film_of(film, runs, times, frames, fonts, clock);
  Moment moment;
  moment.at = times[std::size_t(frame)];
  moment.picture = pictures.static_layer();
  moment.picture.append(pictures.frame(frame));
  moment.title = runs.size() == 1 ? title_of(film.panels.front().scene, runs.front()) : film.scene.title;
  Json audit = film_report(film, runs, pictures);
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
  if (place == times.end() || std::abs(*place - at) > same) place = times.insert(place, at);
  const int frame = int(place - times.begin());
  return moment_of(film, simulate_film(film, times), times, frame, clock, fonts);
}

Moment telling_moment(const PreparedFilm& film, const Fonts& fonts) {
  const FilmClock clock = clock_of(film);
  const std::vector<double> times = clock.frame_times();
  const std::vector<Trajectory> runs = simulate_film(film, times);
  int samples = 0;
  for (const Trajectory& run : runs) samples = std::max(samples, run.size());
  int frame = samples / 2;
  // The first frame in which the event has happened; a run that it ended has its last sample there.
  if (const std::optional<double> event = last_event(runs))
    frame = int(std::lower_bound(times.begin(), times.end(), *event) - times.begin());
  return moment_of(film, runs, times, std::clamp(frame, 0, std::max(samples - 1, 0)), clock, fonts);
}

}  // namespace chainreel
