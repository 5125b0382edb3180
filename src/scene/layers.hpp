// What a picture is made of: the layers that `draw:` names, in one list.
#pragma once

#include <string>
#include <vector>

namespace chainreel {

// What a layer asks of a scene before it can be drawn.
enum class LayerNeeds {
  nothing,
  end_effector,  // there is one: it is left out of models with several ends
  words,         // a page with room for words: it is left out of transparent pictures
};

// In painter's order, what lies below first: the layer, its name in `draw:`, its place among those that are drawn by
// default (0: it is not), and what it needs. Several that lie at several depths may have one name. Those without a
// name are always there. Layer x is made by make_layer_x, which src/draw/layers has.
#define CHAINREEL_LAYERS(ROW)                                    \
  ROW(ground, "ground", 6, nothing)                              \
  ROW(chain_base, "chain", 1, nothing)                           \
  ROW(ghosts, "ghosts", 0, nothing)                              \
  ROW(shadow, "shadow", 0, nothing)                              \
  ROW(chain_rails, "chain", 0, nothing)                          \
  ROW(trail, "trail", 2, end_effector)                           \
  ROW(chain_links, "chain", 0, nothing)                          \
  ROW(ellipse, "ellipse", 0, end_effector)                       \
  ROW(foot, "chain", 0, nothing)                                 \
  ROW(frames, "frames", 0, nothing)                              \
  ROW(com, "com", 0, nothing)                                    \
  ROW(gravity, "gravity", 0, nothing)                            \
  ROW(torque, "torque", 0, nothing)                              \
  ROW(velocity, "velocity", 0, end_effector)                     \
  ROW(constraint_force, "constraint_force", 0, nothing)          \
  ROW(mark_labels, "", 0, nothing)                               \
  ROW(chain_tip, "chain", 0, nothing)                            \
  ROW(mass_matrix, "mass_matrix", 0, nothing)                    \
  ROW(outlined_trail, "trail", 0, end_effector)                  \
  ROW(outlined_chain, "chain", 0, nothing)                       \
  ROW(title, "title", 4, words)                                  \
  ROW(torque_label, "torque_label", 5, words)                    \
  ROW(equation, "equation", 0, words)                            \
  ROW(legend, "legend", 0, words)                                \
  ROW(scale_bar, "scale_bar", 0, words)                          \
  ROW(time, "time", 3, words)                                    \
  ROW(speed, "", 0, words)

struct LayerRow {
  const char* name;
  int by_default;
  LayerNeeds needs;
};
inline constexpr LayerRow kLayerRows[] = {
#define CHAINREEL_LAYER_ROW(layer, name, by_default, needs) {name, by_default, LayerNeeds::needs},
    CHAINREEL_LAYERS(CHAINREEL_LAYER_ROW)
#undef CHAINREEL_LAYER_ROW
};

// The layers that `draw:` may name, each once.
const std::vector<std::string>& layer_names();
// Those that are drawn where a scene names none.
const std::vector<std::string>& default_layers();
// Whether a layer of this name has this need.
bool layer_needs(const std::string& name, LayerNeeds needs);

}  // namespace chainreel
