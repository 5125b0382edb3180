// A film in words, for those who cannot see it.
#pragma once

#include <string>

#include "app/film/clip_memory.hpp"
#include "app/report/run_report.hpp"

namespace chainreel {

// What a film remembers: the effective scene, and the audit without what differs from one rendering to the
// next.
ClipMemory memory_of(const FilmReport& report);

// One sentence: what moves, for how long, under what.
std::string sentence_of(const FilmReport& report);

// How long a clip is: small ones have frames of their own.
struct ClipLength {
  int frames = 0;
  double seconds = 0;
};
// The sentence, what moves in each further panel, scene, duration, units, and what happens when.
std::string alt_text(const FilmReport& report, const ClipLength& clip);

// Captions in SRT, one an event of the runs, at the times of the film, none behind its end; "" where there is no event.
std::string captions(const FilmReport& report);

}  // namespace chainreel
