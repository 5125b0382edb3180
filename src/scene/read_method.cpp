#include "scene/read_method.hpp"

#include "core/format.hpp"
#include "integrate/method.hpp"

namespace chainreel {
namespace {

void read_number(Fields& fields, const std::string& key, std::optional<double>& value,
                 const std::string& message) {
  if (!fields.has(key)) return;
  double number = 1;
  fields.read(key, number);
  if (!(number > 0)) fields.problem_at(key, message);
  value = number;
}

void read_accuracy(Fields& fields, Scene& scene) {
  if (!fields.has("accuracy")) return;
  std::string text;
  fields.read("accuracy", text);
  try {
    scene.accuracy = parse_accuracy(text);
  } catch (const Error& error) {
    fields.problem_at("accuracy", "'accuracy': " + error.problems().front().message);
  }
  if (scene.method != "auto")
    fields.problem_at("accuracy",
               "'accuracy' is what `method: auto` chooses by; with method " + scene.method +
                   " it means nothing: leave one of the two out");
}

void refuse_with_auto(Fields& fields) {
  for (const char* key : {"step", "tolerance", "order"})
    if (fields.has(key))
      fields.problem_at(key,
                 "'" + std::string(key) + "' is chosen by `method: auto`: name a method, or leave '" + key +
                     "' out");
}

void check_options(Fields& fields, const Scene& scene, const Method& method) {
  if (scene.tolerance && !method.adaptive)
    fields.problem_at("tolerance", method.name + " takes no tolerance: its step is fixed, see 'step'");
  if (scene.tolerance && scene.step)
    fields.problem_at("tolerance",
               "'step' and 'tolerance' exclude each other: a fixed step meets no tolerance");
  if (!scene.order) return;
  if (method.highest_order == 0)
    fields.problem_at("order", method.name + " has one order only, " + std::to_string(method.order));
  else if (*scene.order < method.lowest_order || *scene.order > method.highest_order)
    fields.problem_at("order",
               "'order' of " + method.name + " must lie between " + std::to_string(method.lowest_order) +
                   " and " + std::to_string(method.highest_order));
}

}  // namespace

void read_method(Fields& fields, Scene& scene) {
  fields.read("method", scene.method);
  read_number(fields, "step", scene.step, "'step' must be above 0 s");
  if (scene.step && *scene.step > scene.duration && scene.duration > 0)
    fields.problem_at("step", "'step' is longer than the duration");
  read_number(fields, "tolerance", scene.tolerance, "'tolerance' must be above 0");
  if (scene.tolerance && *scene.tolerance > 0 && *scene.tolerance < kLeastTolerance)
    fields.problem_at("tolerance",
               "'tolerance' is below the rounding of doubles, which no step can meet: take " +
                   format_shortest(kLeastTolerance) + " or more");
  if (fields.has("order")) fields.read("order", scene.order.emplace());
  read_accuracy(fields, scene);
  if (scene.method == "auto") return refuse_with_auto(fields);
  try {
    check_options(fields, scene, find_method(scene.method));
  } catch (const Error& error) {
    fields.problem_at("method", error.problems().front().message);
  }
}

}  // namespace chainreel
