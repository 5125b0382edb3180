// Slow motion that a film has by itself: where a link turns too fast for the eye, and about events.
//
// What asks for it: spans of frames, those of the scene's own speed, at which a link turns by more than `turn` until
// the next frame, and the first instant of each event, or at which constraints lose rank, or a limit ended the run; of all panels, but for runs
// that did not come to the end they should have, which decide on nothing.
//
// Each is shown slowed down from `around` before it until `around` behind it, half of which the speed takes to change.
// Of what lies nearer to one another than twice `around`, one stretch is made: the speed does not swing. A film never
// becomes longer than longest_film says: whoever asks for some seconds gets about these. Events come first, those that fit, what ends the motion before all others, then turns in the order of
// time; the first that does not fit is cut where the room ends, and no others follow, so that a motion that is fast
// throughout is seen slowly where it begins to be.
#pragma once

#include <string>
#include <vector>

#include "model/chain.hpp"
#include "scene/film_clock.hpp"

namespace chainreel {

// s. By itself two seconds more than a motion of up to six seconds, which let a short one be twice as long and no longer; longer
// ones are as long as they are. By numbers of the scene's own twice as long.
double longest_film(double motion, bool is_asked = false);

// A part of the motion that asks for slow motion, s.
struct Haste {
  double from = 0, until = 0;
  bool is_turn = false;             // of a link
  std::vector<std::string> events;  // and limits, by name
};

// What a run has to say; its trajectory is sampled at frames, and maybe at its end.
std::vector<Haste> fast_turns(const Chain& chain, const Trajectory& run, double turn, FrameRate fps);
// `change_points`: s, rising, at which its constraints lose rank.
std::vector<Haste> notable_instants(const Scene& scene, const Trajectory& run, const std::vector<double>& change_points = {});

// Whether anything of this kind can be found in a run: where nothing turns and nothing happens, none need be looked at.
bool may_be_hasty(const Scene& scene, const Chain& chain);

// The stretches of a motion that ends at `end`, s; in the order of time, apart from one another.
std::vector<Stretch> stretches_by(const SlowMotionRule& rule, double end, const std::vector<Haste>& events,
                                  const std::vector<Haste>& turns);

}  // namespace chainreel
