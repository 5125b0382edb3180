// Instants of a motion that single pictures show: which they are, and where they stand among the frames.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/film/runs.hpp"

namespace chainreel {

// Sorted, among those of the frames; `added` are those that were none of them.
struct Instants {
  std::vector<double> times, added;
  std::vector<int> frames;  // of each that is asked for
};
Instants instants_of(const PreparedFilm& film, const FilmClock& clock, const std::vector<double>& asked);

// How many frames the whole film has as `render` shows it. `added`: instants among those of the runs that are
// none of its frames.
int frames_of_film(const Runs& runs, const std::vector<double>& added);

// The one that says most: when the last event happened, which may lie between two frames or behind the last
// one; else the middle of the longest run.
double telling_instant(const Runs& runs);

// The first time that the event of this name happens, in any panel; nothing where it does not come.
std::optional<double> first_time_of(const Runs& runs, const std::string& event);

}  // namespace chainreel
