// What stands above a picture: the scene's title with what it leaves open.
#pragma once

#include <string>
#include <vector>

#include "scene/scene.hpp"
#include "sim/simulate.hpp"

namespace chainreel {

// The title, in it `{fall}` replaced by the time of the fall and `{F}` by the parameter of that name, but for formulas between dollar
// signs; and behind it the parameters that the command line gave and the title does not tell. Of a run that does not fall it says so, or that a real foot
// would have tipped. `simulation`: may be null.
std::string title_of(const Scene& scene, const Simulation* simulation, const Trajectory& trajectory);

// Words that a film says elsewhere, likewise.
std::string filled_words(const std::string& words, const Scene& scene, const Trajectory& trajectory);

// The title above a comparison, whose panels have the values: what it leaves open is an ellipsis.
std::string title_of_page(const Scene& page);

// The title of what several runs of a scene are shown in, as of a chart over methods: parameters have their values, what a run would
// tell is an ellipsis. The scene's name where it has no title.
std::string title_over_runs(const Scene& scene);

// Of words in braces that stay as they are, a sentence each without end mark.
std::vector<std::string> title_notices(const Scene& scene);

}  // namespace chainreel
