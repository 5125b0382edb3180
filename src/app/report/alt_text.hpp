// A film in words, for those who cannot see it.
#pragma once

#include <string>

#include "app/film/prepared.hpp"
#include "app/film/runs.hpp"

namespace chainreel {

// One sentence: what moves, for how long, under what.
std::string sentence_of(const PreparedFilm& film, const Json& audit);

// The sentence, scene, duration, units, and what happens when; from the film's audit.
std::string alt_text(const PreparedFilm& film, const Json& audit);

// Captions in SRT, one an event of the runs, at the times of the film, none behind its end; "" where there is no event.
std::string captions(const PreparedFilm& film, const FilmClock& clock, const Json& audit);

}  // namespace chainreel
