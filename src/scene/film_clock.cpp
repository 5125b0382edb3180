#include "scene/film_clock.hpp"

#include <algorithm>
#include <cmath>

namespace chainreel {
namespace {

constexpr double kSameInstant = 1e-9;  // s of the film: a frame this close before a change stands on it
constexpr double kRoundOff = 1e-12;    // of a sum of stretches: half a frame is half a frame

// The slowest of those that hold at `t`; 1 where there is none.
double speed_of(const std::vector<Stretch>& stretches, double t) {
  double speed = 0;
  for (const Stretch& one : stretches)
    if (one.from <= t && t < one.until) speed = speed == 0 ? one.speed : std::min(speed, one.speed);
  return speed == 0 ? 1 : speed;
}

// Without overlaps, and neighbours of one speed as one.
std::vector<Stretch> merged(const std::vector<Stretch>& stretches, double duration) {
  std::vector<double> bounds{0, duration};
  for (const Stretch& one : stretches)
    for (const double t : {one.from, one.until}) bounds.push_back(std::clamp(t, 0.0, duration));
  std::sort(bounds.begin(), bounds.end());
  std::vector<Stretch> all;
  for (std::size_t i = 0; i + 1 < bounds.size(); ++i) {
    if (!(bounds[i] < bounds[i + 1])) continue;
    const double speed = speed_of(stretches, bounds[i]);
    if (!all.empty() && all.back().speed == speed)
      all.back().until = bounds[i + 1];
    else
      all.push_back({bounds[i], bounds[i + 1], speed});
  }
  return all;
}

}  // namespace

FilmClock::FilmClock(double duration, FrameRate fps, const std::vector<Stretch>& stretches, std::vector<Pause> pauses)
    : duration_(duration), fps_(fps) {
  std::erase_if(pauses, [&](const Pause& pause) {
    return !(pause.seconds > 0 && pause.at >= 0 && pause.at <= duration);
  });
  std::stable_sort(pauses.begin(), pauses.end(), [](const Pause& a, const Pause& b) { return a.at < b.at; });
  double film = 0;
  auto pause = pauses.begin();
  const std::vector<Stretch> all = merged(stretches, duration);
  if (!all.empty()) pieces_.clear();
  for (const Stretch& one : all) {
    pieces_.push_back({one.from, film, one.speed});
    if (one.speed != 1) slow_.push_back(one);
    double from = one.from;
    for (; pause != pauses.end() && (pause->at < one.until || one.until >= duration); ++pause) {
      film += (pause->at - from) / one.speed;
      from = pause->at;
      pieces_.push_back({from, film, 0});
      film += pause->seconds;
      pieces_.push_back({from, film, one.speed});
    }
    film += (one.until - from) / one.speed;
  }
}

double FilmClock::film_seconds() const {
  return pieces_.back().film_from + (duration_ - pieces_.back().from) / pieces_.back().speed;
}

const FilmClock::Piece& FilmClock::piece_at(double t) const {
  const auto next = std::upper_bound(pieces_.begin() + 1, pieces_.end(), t,
                                     [](double now, const Piece& piece) { return now < piece.from; });
  return *(next - 1);
}

int FilmClock::frame_count() const {
  return chainreel::frame_count(is_plain() ? duration_ : film_seconds() * (1 + kRoundOff), fps_);
}

double FilmClock::time_of_frame(int k) const {
  const double film = frame_time(k, fps_);
  const auto next = std::upper_bound(pieces_.begin() + 1, pieces_.end(), film + kSameInstant,
                                     [](double now, const Piece& piece) { return now < piece.film_from; });
  const Piece& piece = *(next - 1);
  return piece.from + std::max(0.0, film - piece.film_from) * piece.speed;
}

std::vector<double> FilmClock::frame_times() const {
  std::vector<double> times;
  for (int k = 0; k < frame_count(); ++k) times.push_back(time_of_frame(k));
  return times;
}

int FilmClock::frame_at(double t) const {
  const Piece& piece = piece_at(t);  // behind pauses at t
  const double film = piece.film_from + (t - piece.from) / piece.speed;
  return int(std::floor(film * fps_.value() + kSameInstant));
}

double FilmClock::film_time(double t) const {
  const auto standing = std::find_if(pieces_.begin(), pieces_.end(),
                                     [&](const Piece& piece) { return piece.speed == 0 && piece.from == t; });
  if (standing != pieces_.end()) return standing->film_from;
  const Piece& piece = piece_at(t);
  return piece.film_from + (t - piece.from) / piece.speed;
}

double FilmClock::speed_at(double t) const {
  return piece_at(t).speed;
}

double FilmClock::shortest_step() const {
  double slowest = pieces_.front().speed;
  for (const Piece& piece : pieces_)
    if (piece.speed > 0) slowest = std::min(slowest, piece.speed);
  return slowest / fps_.value();
}

std::optional<double> instant_of(const AnnotationEntry& entry, const std::vector<EventEntry>& events,
                                 const EventHits& hits) {
  if (entry.event.empty()) return entry.at;
  for (int k = 0; k < hits.size(); ++k)
    if (events[std::size_t(hits.event[std::size_t(k)])].title() == entry.event) return hits.t[std::size_t(k)];
  return std::nullopt;
}

std::vector<Pause> pauses_of(const std::vector<AnnotationEntry>& entries, const std::vector<EventEntry>& events,
                             const EventHits& hits) {
  std::vector<Pause> pauses;
  for (const AnnotationEntry& entry : entries)
    if (const std::optional<double> at = instant_of(entry, events, hits)) pauses.push_back({*at, entry.hold});
  return pauses;
}

std::vector<Stretch> stretches_of(const std::vector<SlowMotionEntry>& entries,
                                  const std::vector<EventEntry>& events, const EventHits& hits) {
  std::vector<Stretch> stretches;
  for (const SlowMotionEntry& entry : entries) {
    if (entry.event.empty()) {
      stretches.push_back({entry.from, entry.until, entry.speed});
      continue;
    }
    for (int k = 0; k < hits.size(); ++k) {
      const double t = hits.t[std::size_t(k)];
      if (events[std::size_t(hits.event[std::size_t(k)])].title() == entry.event)
        stretches.push_back({t + entry.from, t + entry.until, entry.speed});
    }
  }
  return stretches;
}

}  // namespace chainreel
