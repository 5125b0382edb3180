// Which instant of the motion each frame of a film shows, where `slow_motion:` lets parts of it pass slower
// or faster.
//
// Film time is the integral of dt / speed over the motion. Frame k shows the instant that its own film time k / fps
// belongs to: a change of speed takes effect on the first frame at or after it, and nothing is repeated but where
// `annotate:` lets the motion stand still, a piece of speed 0. Where a stretch has an ease, the speed changes evenly in
// film time over that part of the motion at either end, so that speed^2 is linear in the motion's time there.
// Without stretches frame k shows k / fps to the last bit.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/frame_rate.hpp"
#include "scene/scene.hpp"
#include "sim/system/trajectory.hpp"

namespace chainreel {

inline constexpr double kSlowest = 0.001, kFastest = 1000;
inline constexpr double kMostFrames = 1e7;  // of a film: beyond, the scene is a mistake

// A part of the motion at one speed; s.
struct Stretch {
  double from = 0, until = 0;
  double speed = 1;
  // Within either end, s of the motion, on which the speed comes from 1 and goes back to it; not at the ends of the motion.
  double ease = 0;
  std::string cause = {};  // why the film has it by itself; "": the scene asks for it
  friend bool operator==(const Stretch&, const Stretch&) = default;
};

// An instant at which the motion stands still, and for how long; s.
struct Pause {
  double at = 0, seconds = 0;
};

class FilmClock {
 public:
  FilmClock() = default;  // speed 1 all the time; has no frames
  // Stretches and pauses in any order, as far as they lie within [0, duration]; where stretches overlap the slowest
  // holds, and pauses at one instant add up. Stretches with an ease overlap no others.
  FilmClock(double duration, FrameRate fps, const std::vector<Stretch>& stretches = {}, std::vector<Pause> pauses = {});

  bool is_plain() const { return slow_.empty() && pieces_.size() == 1; }
  // What is not shown at speed 1, in the order of time, without overlaps.
  const std::vector<Stretch>& stretches() const { return slow_; }

  double film_seconds() const;
  int frame_count() const;                  // round(film_seconds() * fps)
  double time_of_frame(int k) const;        // of the motion, s
  std::vector<double> frame_times() const;  // of all frames
  // The frame that stands when the motion is at t: the last one that is not later.
  int frame_at(double t) const;

  double film_time(double t) const;  // when the film comes to instant t of the motion, s
  double speed_at(double t) const;   // a stretch holds from its first instant on, and no more at its last
  // The one that holds at t; null where the motion passes at its own speed.
  const Stretch* stretch_at(double t) const;
  // How much of the motion lies between the two frames that are closest in it, s.
  double shortest_step() const;

 private:
  // `speed` where it begins, and how that grows, 1/s of the film.
  struct Piece {
    double from = 0, film_from = 0, speed = 1, gain = 0;

    double speed_at(double t) const;
    double film_time(double t) const;
    double time_at(double film) const;
  };
  const Piece& piece_at(double t) const;
  static std::vector<Piece> pieces_of(const Stretch& one, double duration);

  double duration_ = 0;
  FrameRate fps_;
  std::vector<Piece> pieces_{{}};
  std::vector<Stretch> slow_;
};

// The events of a panel's run, and when they happened.
struct RunEvents {
  const std::vector<EventEntry>* entries;
  const EventHits* hits;
};

// The instants at which the entries hold the film; for events the first of theirs in the entry's own one of the `panels`.
std::vector<Pause> pauses_of(const std::vector<AnnotationEntry>& entries, const std::vector<RunEvents>& panels);
// When an entry's words are meant; nothing for those of an event that does not happen in its panel.
std::optional<double> instant_of(const AnnotationEntry& entry, const std::vector<RunEvents>& panels);

// The entries' stretches of the motion: those of an event once for each of its instants among `hits`, whose
// run had the events `events`.
std::vector<Stretch> stretches_of(const std::vector<SlowMotionEntry>& entries,
                                  const std::vector<EventEntry>& events, const EventHits& hits);

}  // namespace chainreel
