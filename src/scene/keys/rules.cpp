// What two keys of a scene say together.
#include <algorithm>
#include <cmath>

#include "integrate/method.hpp"
#include "scene/film_clock.hpp"
#include "scene/keys/own_keys.hpp"

namespace chainreel {
namespace {

// Keys that go with a method. Where the command line names another one, those of the file that do not go with it are left
// out, which is said; what the command line itself says is never passed over.
class MethodKeys {
 public:
  MethodKeys(Fields& fields, Scene& scene) : fields_(fields), scene_(scene), is_replaced_(fields.is_of_command_line("method")) {}

  // True where the key was left out; else it is a problem.
  bool leave_out(const std::string& key, const std::string& problem) {
    if (!is_replaced_ || fields_.is_of_command_line(key)) {
      fields_.problem_at(key, problem);
      return false;
    }
    if (key == "step") scene_.step.reset();
    if (key == "tolerance") scene_.tolerance.reset();
    if (key == "order") scene_.order.reset();
    if (key == "accuracy") scene_.accuracy = Accuracy{};
    scene_.notices.push_back("'" + key + "' of the scene is left out: it does not go with method " + scene_.method +
                             " of the command line");
    return true;
  }

  bool stands_in_the_file(const std::string& key) const { return !fields_.is_of_command_line(key); }

 private:
  Fields& fields_;
  Scene& scene_;
  bool is_replaced_;
};

void check_method_options(MethodKeys& keys, const Scene& scene, const Method& method) {
  if (scene.tolerance && !method.adaptive)
    keys.leave_out("tolerance", method.name + " takes no tolerance: its step is fixed, see 'step'");
  if (scene.tolerance && scene.step)
    // Of the two that one stays which the command line says.
    keys.leave_out(keys.stands_in_the_file("step") && !keys.stands_in_the_file("tolerance") ? "step" : "tolerance",
                   "'step' and 'tolerance' exclude each other: a fixed step meets no tolerance");
  if (!scene.order) return;
  if (method.highest_order == 0)
    keys.leave_out("order", method.name + " has one order only, " + std::to_string(method.order));
  else if (*scene.order < method.lowest_order || *scene.order > method.highest_order)
    keys.leave_out("order", "'order' of " + method.name + " must lie between " + std::to_string(method.lowest_order) + " and " +
                                std::to_string(method.highest_order));
}

void check_method_keys(Fields& fields, Scene& scene) {
  if (scene.step && *scene.step > scene.duration && scene.duration > 0)
    fields.problem_at("step", "'step' is longer than the duration");
  MethodKeys keys(fields, scene);
  if (scene.chooses_method() && fields.document().is_for_methods) return;
  if (scene.chooses_method()) {
    for (const std::string key : {"step", "tolerance", "order"})
      if (fields.has(key))
        keys.leave_out(key, "'" + key + "' is chosen by `method: auto`: name a method, or leave '" + key + "' out");
    return;
  }
  if (fields.has("accuracy"))
    keys.leave_out("accuracy", "'accuracy' is what `method: auto` chooses by; with method " + scene.method +
                                   " it means nothing: leave one of the two out");
  try {
    check_method_options(keys, scene, find_method(scene.method));
  } catch (const Error& error) {
    fields.problem_at("method", error.problems().front().message);
  }
}

// What would be computed, tied or cut means nothing where all is shown as it was.
void check_motion(Fields& fields, const Scene& scene) {
  if (!scene.motion) return;
  std::vector<std::string> vain;
  for (const std::string key : kKeysOfRuns) {
    if (key == "limit" && scene.limit == LimitPolicy::report) continue;
    if (key == "expect" && scene.expect != Outcome::diverge) continue;  // limits are asked of what was recorded, too
    if (fields.has(key)) vain.push_back(key);
  }
  if (!vain.empty()) {
    std::string remedy;
    for (const std::string& key : vain) remedy += (remedy.empty() ? "" : " ") + ("--set " + key + "=");
    fields.problem_at(vain.front(), "'motion' shows what was recorded, and nothing is computed: beside it " + joined(vain) +
                                        (vain.size() == 1 ? " means" : " mean") + " nothing; leave " +
                                        (vain.size() == 1 ? "it" : "them") + " out (" + remedy + ")");
  }
  if (scene.base == RootLink::floating)
    fields.problem_at("base", "'motion' tells the places of joints, and a floating base has none: leave `base: floating` out");
}

// Where a load is, of none, would mean nothing.
void check_payload(Fields& fields, const Scene& scene) {
  const YAML::Node payload = fields.find("payload");
  if (payload.IsMap() && payload.size() > 0 && !payload["mass"].IsDefined() && scene.payload.mass == 0)
    fields.problem_at("payload", "'payload' says where a load is, and not how heavy: give payload.mass, kg");
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
  if (scene.motion && !fields.has("duration") && (frames > kMostFrames || frames < 0.5))
    return fields.problem_at("motion", "the motion " + scene.motion->csv + " lasts " + format_shortest(scene.duration) +
                                           " s, which makes no film: is '" + scene.motion->columns.time.name +
                                           "' told in another unit? Name it in the table's header or in `columns`, like '" +
                                           scene.motion->columns.time.name + " [ms]' or [ns]");
  if (frames > kMostFrames) fields.problem_at("duration", "'duration' is longer than ten million frames");
  if (frames < 0.5 && scene.duration > 0)
    fields.problem_at("duration", "'duration' is shorter than half a frame, of which neither a film nor a table has anything: take " +
                                       (1 / scene.duration <= kMostFps ? "video.fps=" + std::to_string(long(std::ceil(1 / scene.duration))) + " for one"
                                                                       : "a longer one"));
}

}  // namespace

void check_together(Fields& fields, Scene& scene) {
  if (!scene.motion) check_method_keys(fields, scene);
  check_motion(fields, scene);
  check_payload(fields, scene);
  check_foot(fields, scene);
  find_forces(fields, scene);
  check_baumgarte(fields, scene);
  check_sides(fields, scene);
  check_frames(fields, scene);
}

}  // namespace chainreel
