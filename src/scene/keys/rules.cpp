// What two keys of a scene say together.
#include "integrate/method.hpp"
#include "scene/film_clock.hpp"
#include "scene/keys/own_keys.hpp"

namespace chainreel {
namespace {

void check_method_options(Fields& fields, const Scene& scene, const Method& method) {
  if (scene.tolerance && !method.adaptive)
    fields.problem_at("tolerance", method.name + " takes no tolerance: its step is fixed, see 'step'");
  if (scene.tolerance && scene.step)
    fields.problem_at("tolerance", "'step' and 'tolerance' exclude each other: a fixed step meets no tolerance");
  if (!scene.order) return;
  if (method.highest_order == 0)
    fields.problem_at("order", method.name + " has one order only, " + std::to_string(method.order));
  else if (*scene.order < method.lowest_order || *scene.order > method.highest_order)
    fields.problem_at("order", "'order' of " + method.name + " must lie between " +
                                   std::to_string(method.lowest_order) + " and " +
                                   std::to_string(method.highest_order));
}

void check_method_keys(Fields& fields, const Scene& scene) {
  if (scene.step && *scene.step > scene.duration && scene.duration > 0)
    fields.problem_at("step", "'step' is longer than the duration");
  if (scene.chooses_method()) {
    for (const char* key : {"step", "tolerance", "order"})
      if (fields.has(key))
        fields.problem_at(key, "'" + std::string(key) + "' is chosen by `method: auto`: name a method, or leave '" +
                                   key + "' out");
    return;
  }
  if (fields.has("accuracy"))
    fields.problem_at("accuracy", "'accuracy' is what `method: auto` chooses by; with method " + scene.method +
                                      " it means nothing: leave one of the two out");
  try {
    check_method_options(fields, scene, find_method(scene.method));
  } catch (const Error& error) {
    fields.problem_at("method", error.problems().front().message);
  }
}

void check_foot(Fields& fields, Scene& scene) {
  if (!fields.find("foot").IsMap()) return;
  if (!scene.foot) scene.foot.emplace();
  if (!(scene.foot->heel < scene.foot->toe))
    fields.problem_at("foot", "'foot' needs a heel below its toe, m along the ground: foot: {heel: -0.06, toe: 0.19}");
}

void check_baumgarte(Fields& fields, const Scene& scene) {
  if (fields.find("baumgarte").IsMap() && scene.stabilize != Stabilization::baumgarte)
    fields.problem_at("baumgarte", "'baumgarte' means nothing with stabilize: " + to_string(scene.stabilize) +
                                       ": write `stabilize: baumgarte`, or leave it out");
}

void check_sides(Fields& fields, const Scene& scene) {
  const YAML::Node node = fields.find("video");
  if (!node.IsMap()) return;
  Fields video(fields.document(), node, "video", fields.problems());
  for (const auto& [key, side] : {std::pair{"width", scene.video.width}, std::pair{"height", scene.video.height}})
    if (side % 2 != 0)
      video.problem_at(key, "'video." + std::string(key) + "' is odd: H.264 with 4:2:0 colour needs even sides, take " +
                                std::to_string(side - 1) + " or " + std::to_string(side + 1));
}

void check_frames(Fields& fields, const Scene& scene) {
  const double frames = scene.duration * scene.video.fps.value();
  if (frames > kMostFrames) fields.problem_at("duration", "'duration' is longer than ten million frames");
  if (frames < 0.5 && scene.duration > 0)
    fields.problem_at("duration", "'duration' is shorter than half a frame: the film would be empty");
}

}  // namespace

void check_together(Fields& fields, Scene& scene) {
  check_method_keys(fields, scene);
  check_foot(fields, scene);
  check_baumgarte(fields, scene);
  check_sides(fields, scene);
  check_frames(fields, scene);
}

}  // namespace chainreel
