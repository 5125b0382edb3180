// Where the stages are joined: scene -> simulation -> trajectory -> film -> pixels.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/film/clip_memory.hpp"
#include "app/film/formats.hpp"
#include "core/image.hpp"
#include "core/json.hpp"
#include "draw/film.hpp"
#include "picture/picture.hpp"
#include "picture/text.hpp"
#include "scene/film_clock.hpp"
#include "scene/scene.hpp"
#include "sim/audit.hpp"
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
};

// `quiet`: says nothing while a method is chosen.
PreparedFilm load_film(const std::string& path, const std::vector<std::string>& overrides, bool meshes = true,
                       bool quiet = true);
// For charts and tables of a single run, which compare whole durations: events do not act. Throws Error where
// the scene compares several.
PreparedScene load_scene(const std::string& path, const std::vector<std::string>& overrides,
                         bool meshes = true, bool quiet = true);

// 0, 1/fps, 2/fps, ...: one a frame of a film without slow motion.
std::vector<double> frame_times(const Scene& scene);
// Which instant each frame shows. Slow motion about events follows those of the first panel, whose run is computed for
// them. Throws Error (exit 7) where the film would be too long, (bad input) where it would be empty.
FilmClock clock_of(const PreparedFilm& film);

// Throws Error (exit 5, or the signal's) unless the run came to the end that the scene expects: finished or
// stopped by a limit, or diverged.
void require_expected_end(const Trajectory& trajectory, const Scene& scene);
// The same for all panels; for a picture of one frame, for those alone that cannot show it or must diverge.
void require_expected_ends(const PreparedFilm& film, const std::vector<Trajectory>& runs,
                           std::optional<int> frame = {});

// "panel 2 (rk4): message"
std::string in_panel(const Scene& scene, std::size_t i, const std::string& message);

// Runs all panels, sampled at `times`. Throws only the signal's Error.
std::vector<Trajectory> simulate_film(const PreparedFilm& film, const std::vector<double>& times);
// The pictures of these runs at the first `frames` of `times`.
Film film_of(const PreparedFilm& film, const std::vector<Trajectory>& runs, const std::vector<double>& times,
             int frames, const Fonts& fonts, const FilmClock& clock = {});

struct StageSeconds {
  double simulate = 0, draw = 0, render = 0, encode = 0, total = 0;
};

// One picture as pixels.
Image rasterise(const Picture& picture, int width, int height, const Fonts& fonts);
// Throws Error (usage) unless the path's ending is a picture's.
const OutputFormat& picture_format_of(const std::string& path);
// ... and as a file that appears whole or not at all: .png, .svg or .pdf. Vector pages have the proportions of the
// pixels, and a height that suits a sheet of paper.
void write_picture(const Picture& picture, int width, int height, const Fonts& fonts, const std::string& path,
                   bool overwrite, const ClipMemory& memory = {});

}  // namespace chainreel
