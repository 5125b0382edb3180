// `method: auto` at work, and what it says about its choice.
#pragma once

#include <string>
#include <vector>

#include "app/film/prepared.hpp"
#include "core/json.hpp"

namespace chainreel {

// Fills in method and step where the scene leaves them to the program; else does nothing. Throws Error (numerical) at
// the scene's `accuracy` where that cannot be had, and the signal's.
void choose_automatically(PreparedScene& prepared, bool quiet);
// choose_method, with a line on standard error from the first second on unless it is to be quiet.
Choice choose_with_progress(Simulation& simulation, const Scene& scene, std::span<const double> times, bool quiet);

// One sentence: the choice, a bound of its error and its price; until when that holds, and what happens there.
std::string choice_text(const Choice& choice, const Accuracy& accuracy);

// "NAME: what speaks against the scene", a line each.
std::vector<std::string> doubt_lines(const PreparedScene& prepared);
// On standard error: these as warnings, however quiet; and what was changed of the scene when it was made ready.
void say_notices(const PreparedScene& prepared, bool quiet);
// The same, and that sentence, unless there was nothing to choose or all is to be quiet.
void say_choice(const PreparedScene& prepared, bool quiet);

// The same as JSON, and with `tried` every candidate.
Json choice_report(const Choice& choice, const Accuracy& accuracy, bool tried);

}  // namespace chainreel
