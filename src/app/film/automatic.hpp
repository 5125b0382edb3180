// `method: auto` at work, and what it says about its choice.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "app/film/prepared.hpp"
#include "core/json.hpp"
#include "sim/doubts.hpp"

namespace chainreel {

// Fills in method and step where the scene leaves them to the program; else does nothing. Throws Error (numerical) at
// the scene's `accuracy` where that cannot be had, and the signal's.
// `between`: s, of the instants that are asked for; 0: those of frames.
void choose_automatically(PreparedScene& prepared, bool quiet, double between = 0);
// choose_method, with a line on standard error from the first second on unless it is to be quiet.
Choice choose_with_progress(Simulation& simulation, const Scene& scene, std::span<const double> times, bool quiet);

// One sentence: the choice, a bound of its error and its price; until when that holds, and what happens there.
std::string choice_text(const Choice& choice, const Accuracy& accuracy);
// That of a run until `end`, s, less is promised than was asked for.
std::optional<Doubt> doubt_of_choice(const Choice& choice, const Accuracy& accuracy, double end);

// "NAME: what speaks against the scene", and what was changed of it when it was made ready; what several panels say, once.
std::vector<std::string> doubt_lines(std::span<const PreparedScene> panels);
std::vector<std::string> notice_lines(std::span<const PreparedScene> panels);
// On standard error: the first as warnings, however quiet, and the second.
void say_notices(std::span<const PreparedScene> panels, bool quiet);
inline void say_notices(const PreparedScene& prepared, bool quiet) { say_notices(std::span(&prepared, 1), quiet); }
// The same, and of each that sentence, unless there was nothing to choose or all is to be quiet.
void say_choice(std::span<const PreparedScene> panels, bool quiet);
inline void say_choice(const PreparedScene& prepared, bool quiet) { say_choice(std::span(&prepared, 1), quiet); }

// The same as JSON, and with `tried` every candidate.
Json choice_report(const Choice& choice, const Accuracy& accuracy, bool tried);

}  // namespace chainreel
