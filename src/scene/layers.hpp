// What a picture is made of: the layers that `draw:` names, in one list.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "core/names.hpp"

namespace chainreel {

// What a layer asks of a scene before it can be drawn.
enum class LayerNeeds {
  nothing,
  end_effector,  // there is one: it is left out of models with several ends
  way,           // the same, or a free base, whose centre of mass is followed then
  words,         // a page with room for words: it is left out of transparent pictures
};

// In painter's order, what lies below first: the layer, its name in `draw:`, its place among those that are drawn by
// default (0: it is not), what it needs, and what the name means. Several that lie at several depths may have one name,
// of which the first says what it means. Those without a name are always there. Layer x is made by make_layer_x, which
// src/draw/layers has.
// Those by default draw nothing where a scene has nothing of theirs.
#define CHAINREEL_LAYERS(ROW)                                                                               \
  ROW(ground, "ground", 6, nothing, "seen obliquely: a grid on the ground where the robot stands on it")    \
  ROW(g, "g", 11, words, "gravity: a small arrow that says which way it acts, where it does")             \
  ROW(constraints, "constraints", 7, nothing,                                                               \
      "what the robot is tied to: lines and planes with hatching, curves, rods; joints that are held have a square, joints tied to one another a dashed line") \
  ROW(chain_base, "chain", 1, nothing, "the mechanism")                                                     \
  ROW(ellipse_inside, "ellipse", 0, end_effector,                                                            \
      "the effective mass of the end effector, as `ellipse:` says")                                         \
  ROW(target, "target", 10, nothing,                                                                        \
      "of feedback (pd, computed_torque): the pose that it follows in outline; coils from there show PD")   \
  ROW(ghosts, "ghosts", 0, nothing,                                                                         \
      "the chain at six earlier instants of the last second, fainter with age, the older half as outlines") \
  ROW(change_point, "", 0, nothing, "")                                                                     \
  ROW(shadow, "shadow", 13, nothing,                                                                        \
      "seen obliquely: the soft shadow of a light from above, darker where a body touches the ground")      \
  ROW(chain_rails, "chain", 0, nothing, "")                                                                 \
  ROW(trail, "trail", 2, way,                                                                               \
      "the last second of the end effector's way (`style: {trail: all}`: all of it), a dot every 0.1 s; of free robots with several ends that of their centre of mass") \
  ROW(slider_springs, "springs", 8, nothing,                                                                \
      "torques that are linear in a coordinate or a rate as the springs and dampers that they are")         \
  ROW(chain_links, "chain", 0, nothing, "")                                                                 \
  ROW(couplings, "constraints", 0, nothing, "")                                                             \
  ROW(target_pulls, "target", 0, nothing, "")                                                               \
  ROW(joint_springs, "springs", 0, nothing, "")                                                             \
  ROW(limits, "limits", 12, nothing, "the limits of joints that the motion comes near to")                  \
  ROW(angles, "angles", 0, nothing, "the coordinates: of revolute joints arcs, of sliders lengths, from zero on") \
  ROW(ellipse, "ellipse", 0, end_effector, "")                                                              \
  ROW(foot, "chain", 0, nothing, "")                                                                        \
  ROW(fall_level, "", 0, words, "")                                                                         \
  ROW(frames, "frames", 0, nothing, "axes of the links' frames (y has one cross tick, z two)")              \
  ROW(gravity, "gravity", 0, nothing, "the weight of each link at its centre of mass")                      \
  ROW(torque, "torque", 9, nothing,                                                                         \
      "where any acts: arcs at revolute joints, arrows beside the rails of sliders; a ring where one rests") \
  ROW(push, "push", 14, nothing, "what pushes from outside: an arrow where and while it acts")                \
  ROW(velocity, "velocity", 0, end_effector, "velocity of the end effector")                                \
  ROW(constraint_force, "constraint_force", 15, nothing, "dashed: what constraints exert on the robot, -lambda of their rows") \
  ROW(center_over_foot, "chain", 0, nothing, "")                                                            \
  ROW(com, "com", 0, nothing, "the centre of mass of the whole chain")                                      \
  ROW(annotations, "", 0, nothing, "")                                                                      \
  ROW(mark_labels, "", 0, nothing, "")                                                                      \
  ROW(chain_tip, "chain", 0, nothing, "")                                                                   \
  ROW(mass_matrix, "mass_matrix", 0, nothing, "M(q) as a live heat map, with numbers up to 4 x 4")          \
  ROW(outlined_trail, "trail", 0, way, "")                                                         \
  ROW(outlined_chain, "chain", 0, nothing, "")                                                              \
  ROW(title, "title", 4, words, "the title above it")                                                       \
  ROW(torque_label, "torque_label", 5, words, "the torques in words")                                       \
  ROW(equation, "equation", 0, words, "the equation of motion, symbols in the colours of their vectors")    \
  ROW(legend, "legend", 0, words, "the names of vectors and of the ellipse")                                \
  ROW(scale_bar, "scale_bar", 0, words, "one metre, or a round part of it")                                 \
  ROW(time, "time", 3, words, "the time below the scene, and the speed where it is not 1")                  \
  ROW(speed, "", 0, words, "")

struct LayerRow {
  const char* name;
  int by_default;
  LayerNeeds needs;
  const char* meaning;
};
inline constexpr LayerRow kLayerRows[] = {
#define CHAINREEL_LAYER_ROW(layer, name, by_default, needs, meaning) {name, by_default, LayerNeeds::needs, meaning},
    CHAINREEL_LAYERS(CHAINREEL_LAYER_ROW)
#undef CHAINREEL_LAYER_ROW
};

// The layers that `draw:` may name, each once, and what they are; first those that are drawn by default.
std::span<const Name> layer_names();
// Those that are drawn where a scene names none.
const std::vector<std::string>& default_layers();
// The same where several panels share the page: without those that small panels have no room for.
const std::vector<std::string>& default_layers_of_panels();
// Whether a layer of this name has this need.
bool layer_needs(const std::string& name, LayerNeeds needs);

}  // namespace chainreel
