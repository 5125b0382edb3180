// One picture out of the film of a scene: same camera, same scales, whatever the instant.
#pragma once

#include <string>
#include <vector>

#include "app/film/clip_memory.hpp"
#include "app/film/prepared.hpp"
#include "app/film/runs.hpp"

namespace chainreel {

struct Moment {
  double at = 0;  // s
  Picture picture;
  std::string title;  // of the page, with what it says of the run
  ClipMemory memory;
  std::vector<std::string> warnings;  // what speaks against the runs
};

// Throws Error (exit 5) where a run does not come that far or does not end as the scene expects; what fails
// after the instant does not spoil its picture.
Moment moment_at(const PreparedFilm& film, double at, const Fonts& fonts);

// The moment that says most: when the last event happened, else the middle of the longest run.
Moment telling_moment(const PreparedFilm& film, const Fonts& fonts);

}  // namespace chainreel
