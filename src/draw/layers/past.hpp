// What was: the way of the end effector behind it, and the chain as it stood at earlier instants.
#pragma once

#include <cmath>
#include <set>
#include <vector>

#include "core/frame_rate.hpp"
#include "draw/page/panel.hpp"

namespace chainreel {

// The trail: the last second, or as many as a style says, thinner and fainter with age, with dots every 0.1 s.
inline constexpr double kTrailSeconds = 1.0;
inline constexpr int kTrailDotsPerSecond = 10;
inline constexpr double kTrailOpacity = 0.7, kTrailOpacityOnDark = 0.9;  // where it begins: on dark ground the same is fainter
double trail_opacity(const Theme& theme);
// A trail is no longer on the page than so many times all links together: that of a fast end effector would lie over them loop by loop. One that a
// style lets go back further than a second is as asked, and that of a free robot is how it falls.
inline constexpr double kTrailReaches = 2;
double longest_trail(const Panel& panel);
// The trail as it stands at frame k; `lines`: times its width; `length`: how far it goes back, s; `longest`: on the page.
void draw_trail(Picture& picture, const TipPath& path, int k, Color color, int clip, double lines = 1, double length = kTrailSeconds,
                double opacity = kTrailOpacity, double longest = HUGE_VAL);

// Those whose end effector only goes to and fro on one rail that is drawn, and shows its way: a trail along that would be taken for a rod.
std::set<const StagedRun*> runs_on_rails(const Stage& stage);

// Onion skins: the chain at earlier instants, equally spaced in time, fainter with age.
inline constexpr int kMostGhosts = 6;
inline constexpr int kFilledGhosts = 3;  // those beyond are outlines only
inline constexpr double kFaintestGhost = 0.10, kStrongestGhost = 0.35;
inline constexpr double kGhostSeconds = 1.0;  // all of them together: what the trail of no fast end effector covers, too

// Frames between two ghosts: a whole number of them, so that the spacing is the same everywhere.
int ghost_spacing(FrameRate fps);

struct Ghost {
  int frame = 0;
  double strength = 0;  // of its colours
  bool filled = true;
};
// From the oldest to the youngest. `times` of all frames: an instant that a snapshot has put between them
// does not count.
std::vector<Ghost> ghosts_at(const std::vector<double>& times, int frame, FrameRate fps);

}  // namespace chainreel
