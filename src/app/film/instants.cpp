#include "app/film/instants.hpp"

#include <algorithm>
#include <cmath>

namespace chainreel {

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

double telling_instant(const Runs& runs) {
  std::optional<double> last;
  int samples = 0;
  for (const Trajectory& run : runs.list()) {
    for (const double t : run.events.t) last = std::max(last.value_or(t), t);
    samples = std::max(samples, run.size());
  }
  return last ? *last : runs.times()[std::size_t(samples / 2)];
}

std::optional<double> first_time_of(const Runs& runs, const std::string& event) {
  std::optional<double> first;
  for (std::size_t panel = 0; panel < runs.size(); ++panel) {
    const EventHits& hits = runs[panel].events;
    const std::vector<EventEntry>& events = runs.film().panels[panel].scene.events;
    for (int k = 0; k < hits.size(); ++k)
      if (events[std::size_t(hits.event[std::size_t(k)])].title() == event)
        first = std::min(first.value_or(hits.t[std::size_t(k)]), hits.t[std::size_t(k)]);
  }
  return first;
}

}  // namespace chainreel
