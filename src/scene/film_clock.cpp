#include "scene/film_clock.hpp"

#include <algorithm>
#include <cmath>

namespace chainreel {
namespace {

constexpr double kSameInstant = 1e-9;  // s of the film: a frame this close before a change stands on it
constexpr double kRoundOff = 1e-12;    // of a sum of stretches: half a frame is half a frame

// The slowest of those that hold at `t`; one of speed 1 where there is none.
Stretch slowest_of(const std::vector<Stretch>& stretches, double t) {
  const Stretch* slowest = nullptr;
  for (const Stretch& one : stretches)
    if (one.from <= t && t < one.until && (slowest == nullptr || one.speed < slowest->speed)) slowest = &one;
  return slowest != nullptr ? *slowest : Stretch{};
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
    Stretch one = slowest_of(stretches, bounds[i]);
    one.from = bounds[i];
    one.until = bounds[i + 1];
    if (!all.empty() && all.back().speed == one.speed)
      all.back().until = one.until;
    else
      all.push_back(std::move(one));
  }
  return all;
}

}  // namespace

double FilmClock::Piece::speed_at(double t) const {
  return gain == 0 ? speed : std::sqrt(std::max(0.0, speed * speed + 2 * gain * (t - from)));
}

// (speed_at(t) - speed) / gain without its cancellation.
double FilmClock::Piece::film_time(double t) const {
  return film_from + (gain == 0 ? (t - from) / speed : 2 * (t - from) / (speed + speed_at(t)));
}

double FilmClock::Piece::time_at(double film) const {
  const double since = std::max(0.0, film - film_from);
  return from + since * speed + gain / 2 * since * since;
}

// The film's time is not yet in them.
std::vector<FilmClock::Piece> FilmClock::pieces_of(const Stretch& one, double duration) {
  const double ease = std::min(one.ease, (one.until - one.from) / 2);
  if (!(ease > 0)) return {{one.from, 0, one.speed}};
  const double gain = (1 - one.speed * one.speed) / (2 * ease);
  std::vector<Piece> pieces;
  double from = one.from;
  if (one.from > 0) {
    pieces.push_back({from, 0, 1, -gain});
    from += ease;
  }
  pieces.push_back({from, 0, one.speed});
  if (one.until < duration) pieces.push_back({one.until - ease, 0, one.speed, gain});
  return pieces;
}

FilmClock::FilmClock(double duration, FrameRate fps, const std::vector<Stretch>& stretches, std::vector<Pause> pauses)
    : duration_(duration), fps_(fps) {
  std::erase_if(pauses, [&](const Pause& pause) {
    return !(pause.seconds > 0 && pause.at >= 0 && pause.at <= duration);
  });
  std::stable_sort(pauses.begin(), pauses.end(), [](const Pause& a, const Pause& b) { return a.at < b.at; });
  double film = 0;
  auto pause = pauses.begin();
  std::vector<Piece> all;
  for (const Stretch& one : merged(stretches, duration)) {
    for (const Piece& piece : pieces_of(one, duration)) all.push_back(piece);
    if (one.speed != 1) slow_.push_back(one);
  }
  if (!all.empty()) pieces_.clear();
  for (std::size_t i = 0; i < all.size(); ++i) {
    Piece piece = all[i];
    const double until = i + 1 < all.size() ? all[i + 1].from : duration;
    piece.film_from = film;
    pieces_.push_back(piece);
    for (; pause != pauses.end() && (pause->at < until || until >= duration); ++pause) {
      const double stands = piece.film_time(pause->at);
      pieces_.push_back({pause->at, stands, 0});
      piece = {pause->at, stands + pause->seconds, piece.speed_at(pause->at), piece.gain};
      pieces_.push_back(piece);
    }
    film = piece.film_time(until);
  }
}

double FilmClock::film_seconds() const {
  return pieces_.back().film_time(duration_);
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
  return (next - 1)->time_at(film);
}

std::vector<double> FilmClock::frame_times() const {
  std::vector<double> times;
  for (int k = 0; k < frame_count(); ++k) times.push_back(time_of_frame(k));
  return times;
}

int FilmClock::frame_at(double t) const {
  const double film = piece_at(t).film_time(t);  // behind pauses at t
  return int(std::floor(film * fps_.value() + kSameInstant));
}

double FilmClock::film_time(double t) const {
  const auto standing = std::find_if(pieces_.begin(), pieces_.end(),
                                     [&](const Piece& piece) { return piece.speed == 0 && piece.from == t; });
  if (standing != pieces_.end()) return standing->film_from;
  return piece_at(t).film_time(t);
}

double FilmClock::speed_at(double t) const {
  return piece_at(t).speed_at(t);
}

const Stretch* FilmClock::stretch_at(double t) const {
  for (const Stretch& one : slow_)
    if (one.from <= t && t < one.until) return &one;
  return nullptr;
}

double FilmClock::shortest_step() const {
  double slowest = pieces_.front().speed;
  for (const Piece& piece : pieces_)
    if (piece.speed > 0) slowest = std::min(slowest, piece.speed);
  for (const Stretch& one : slow_) slowest = std::min(slowest, one.speed);
  return slowest / fps_.value();
}

std::optional<double> instant_of(const AnnotationEntry& entry, const std::vector<RunEvents>& panels) {
  if (entry.event.empty()) return entry.at;
  const auto panel = std::size_t(entry.panel - 1);
  if (panel >= panels.size()) return std::nullopt;
  const auto& [entries, hits] = panels[panel];
  for (int k = 0; k < hits->size(); ++k)
    if ((*entries)[std::size_t(hits->event[std::size_t(k)])].title() == entry.event) return hits->t[std::size_t(k)];
  return std::nullopt;
}

std::vector<Pause> pauses_of(const std::vector<AnnotationEntry>& entries, const std::vector<RunEvents>& panels) {
  std::vector<Pause> pauses;
  for (const AnnotationEntry& entry : entries)
    if (const std::optional<double> at = instant_of(entry, panels)) pauses.push_back({*at, entry.hold});
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
