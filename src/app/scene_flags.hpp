// Keys of a scene that have a flag of their own: --theme dark says what --set theme=dark does. What a flag says is in
// overrides_of(CommonOptions), so a command takes a group of flags by one line where it is registered.
#pragma once

#include <map>
#include <span>
#include <string>
#include <vector>

#include "app/command_line.hpp"

namespace chainreel {

struct SceneFlag {
  const char* flag;  // "--theme"
  const char* key;   // dotted, of the scene: "theme"
  const char* help;
};

// Of what is written: films and clips alone.
inline constexpr SceneFlag kOutputFlags[] = {
    {"--preset", "video.preset", "video.preset: slides, web, overlay, doc, frames or still"},
    {"--crf", "video.crf", "video.crf: quality of films, 0 the best"},
    {"--hold", "hold", "hold: seconds of the end frames, like \"{first: 1, last: 2}\""},
};
// Of how a page looks: every picture.
inline constexpr SceneFlag kLookFlags[] = {
    {"--theme", "theme", "theme: light or dark"},
    {"--text-scale", "text_scale", "text_scale: 0.5 to 3, larger for small pictures"},
};
// Of a scene's page: films and snapshots of scenes.
inline constexpr SceneFlag kPageFlags[] = {
    {"--layout", "layout", "layout: scene, scene-right, scene-below, compare, grid, ghost or transparent"},
};

// Of the view: every picture of a chain.
inline constexpr SceneFlag kViewFlags[] = {
    {"--azimuth", "camera.azimuth", "camera.azimuth: about the vertical, like 35deg"},
    {"--elevation", "camera.elevation", "camera.elevation: above the horizon, like 20deg"},
    {"--distance", "camera.distance", "camera.distance: of the eye from the middle in m, or parallel"},
    {"--fit", "camera.fit", "camera.fit: motion, or the part shown in m: \"[left, bottom, right, top]\""},
    {"--links", "links", "links: auto, plain (bars), visual or collision (the model's shapes)"},
    {"--mesh-up", "mesh_up", "mesh_up: rviz or file, whose up Collada meshes follow"},
};

// What the command line says of the keys, by key; keys that it leaves out hold "".
using FlagValues = std::map<std::string, std::string>;

// `values` must outlive the command.
void add_scene_flags(Command& command, FlagValues& values, std::span<const SceneFlag> flags);
// Appends "theme=dark" for each flag that was given.
void add_overrides(const FlagValues& values, std::vector<std::string>& overrides);

// The same two keys where there is no scene to read them. Throw Error (usage) naming the flag.
std::string theme_of(const FlagValues& values);
double text_scale_of(const FlagValues& values);

}  // namespace chainreel
