// A scene of the gallery with its run, and what its pictures hold.
#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "draw/film/film.hpp"
#include "draw/shapes.hpp"
#include "picture/theme.hpp"
#include "scene/run/prepare.hpp"
#include "scene/text/read_scene.hpp"

namespace chainreel::test {

inline constexpr double kCauseRoundOff = 1e-9;  // of places that are sums of a few numbers of size 1

// A scene of the gallery, or one like it, with its run at 60 frames a second.
struct Cause {
  explicit Cause(const std::string& name, const std::vector<std::string>& overrides = {}, double seconds = 2)
      : scene(read_scene("assets/scenes/" + name + ".yaml", overrides)), simulation(prepare(scene, false)) {
    for (int k = 0; k < int(60 * seconds); ++k) times.push_back(k / 60.0);
    if (scene.chooses_method()) {
      simulation.method = &find_method("rk4");
      simulation.step = 0.001;
    }
    run = simulate(simulation, times);
  }
  Film film() const { return {scene, {{scene, simulation.chain, run, &simulation}}, times, fonts}; }
  double q(int k, std::size_t i) const { return run.q_at(k)[i]; }

  Scene scene;
  Simulation simulation;
  std::vector<double> times;
  Trajectory run;
  Fonts fonts;
};

inline const Theme& light() {
  return light_theme();
}

// Wires and arcs, but not the trail of the end effector.
inline std::vector<Trail> wires(const Picture& picture, Color color) {
  return all_of<Trail>(picture, [&](const Trail& path) { return path.color == color; });
}

inline int torque_heads(const Picture& picture) {
  return int(all_of<Polygon>(picture, [](const Polygon& p) {
               return p.count == 3 && p.paint.fill == light().torque;
             }).size());
}

// In letters that are seen.
inline bool has_words(const Picture& picture, const std::string& words) {
  const auto runs = all_of<GlyphRun>(picture, [](const GlyphRun& run) { return run.color.a > 0; });
  return std::any_of(runs.begin(), runs.end(), [&](const GlyphRun& run) { return run.text.find(words) != std::string::npos; });
}

}  // namespace chainreel::test
