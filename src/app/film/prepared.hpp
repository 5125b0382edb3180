// Station two of a film: a scene (what is asked) becomes a prepared film (checked, its models loaded, its methods chosen),
// from which every command that runs a scene starts.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "draw/robot/body_shapes.hpp"
#include "scene/scene.hpp"
#include "sim/choice/choose_method.hpp"
#include "sim/simulate.hpp"

namespace chainreel {

// A scene with everything resolved that a run needs.
struct PreparedScene {
  Scene scene;  // the effective one
  Simulation simulation;
  std::optional<Choice> choice;  // of `method: auto`
  std::shared_ptr<const BodyShapes> shapes;  // drawn instead of bars; none where no picture is asked for
};

// A scene with its panels: one, itself, unless it compares several.
struct PreparedFilm {
  Scene scene;  // the effective one; its `compare` holds the panels' scenes
  std::vector<PreparedScene> panels;
  bool quiet = true;  // nothing is said while its runs are computed
  // Of pictures whose panels show one motion by several methods, and plot it: that motion by two methods far more exact than is
  // seen, of which one confirms the other; else none.
  std::vector<Simulation> references{};
};

// The most links that a panel draws as bars, in colours of the theme.
std::size_t bars_of(const PreparedFilm& film);

// `quiet`: says nothing while a method is chosen.
PreparedFilm load_film(const std::string& path, const std::vector<std::string>& overrides, bool meshes = true,
                       bool quiet = true);
// The same of a scene that has been read. `torque` drives the joints of every panel: Error (usage) where one has its own.
// `between`: s, of the instants by which `auto` judges; 0: those of frames.
PreparedFilm film_of(Scene scene, bool meshes = true, bool quiet = true, const std::optional<OwnTorque>& torque = {}, double between = 0);
// For who measures methods over the whole duration: no event acts, which is said among the scene's notices.
void leave_events_out(PreparedScene& prepared);
// For commands that run one motion with methods of their own, over its whole duration: events do not act, and no method is
// chosen where the scene names none. Of a scene that compares several, `panel` from 1, or 0 where they differ by their methods
// alone; else throws Error. What is to be known of the scene is said.
PreparedScene load_motion(const std::string& path, const std::vector<std::string>& overrides, int panel, bool quiet);

// 0, 1/fps, 2/fps, ...: one a frame of a film without slow motion.
std::vector<double> frame_times(const Scene& scene);
// 0, between, 2 between, ..: whole parts of a second are divided by, so that 3 ms are 0.003. Of more than `most` some, evenly.
std::vector<double> instants_every(double between, double duration, double most);

}  // namespace chainreel
