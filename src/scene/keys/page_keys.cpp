// The keys draw, camera.fit, layout and compare.
#include <algorithm>

#include "scene/keys/own_keys.hpp"
#include "sim/doubts.hpp"

namespace chainreel {
namespace {

constexpr std::size_t kMostInGhost = 4;  // outlines that one can still tell apart

// Why so many panels cannot stand in the layout; "": they can.
std::string layout_problem(PageLayout layout, std::size_t panels) {
  const std::string name = "layout '" + to_string(layout) + "' ";
  if (is_of_panels(layout) != (panels > 1))
    return name + (panels == 1 ? "needs `compare:` with its panels" : "shows one panel: take compare, grid or ghost");
  if (layout == PageLayout::compare && panels != 2)
    return name + "shows two panels, not " + std::to_string(panels) + ": take grid";
  if (layout == PageLayout::ghost && panels > kMostInGhost)
    return name + "draws up to " + std::to_string(kMostInGhost) + " variants over one another, not " +
           std::to_string(panels) + ": compare fewer, or take grid";
  return "";
}

}  // namespace

KeyText told_draw() {
  static const std::vector<std::string> edits = [] {
    std::vector<std::string> all;
    for (const Name& layer : layer_names())
      for (const char* sign : {"+", "-"}) all.push_back(sign + std::string(layer.name));
    return all;
  }();
  static const std::vector<Name> edit_names = [] {
    std::vector<Name> names;
    for (const std::string& edit : edits) names.push_back({edit.c_str(), ""});
    return names;
  }();
  return told_list("draw", told_either("", {told_word("", layer_names(), ""), told_word("", edit_names, "")}, ""),
                   "the layers of the picture; entries +name and -name edit the default ones");
}

KeyText told_acknowledge() {
  return told_list("acknowledge", told_word("", doubt_names(), ""),
                   "warnings that the scene is about, not printed but in reports: " + joined(words_of(doubt_names())));
}

void read_acknowledge(Fields& fields, Scene& scene) {
  if (!fields.read("acknowledge", scene.acknowledge)) return;
  for (const std::string& kind : scene.acknowledge)
    if (!index_of_name(doubt_names(), kind))
      fields.problem_at("acknowledge", "'acknowledge': " + misnamed(doubt_names(), kind));
}

std::string acknowledge_text(const Scene& scene) {
  if (scene.acknowledge.empty()) return "";
  return flow_text([&](YAML::Emitter& out) { emit_list(out, scene.acknowledge, [](const std::string& kind) { return kind; }); });
}

// A plain list replaces the default layers; entries `+name` and `-name` edit them.
void read_draw(Fields& fields, Scene& scene) {
  std::vector<std::string> entries;
  fields.read("draw", entries);
  if (entries.empty()) {
    if (fields.find("draw").IsDefined()) scene.draw.clear();
    return;
  }
  const auto edits = std::count_if(entries.begin(), entries.end(), [](const std::string& entry) {
    return entry.starts_with('+') || entry.starts_with('-');
  });
  if (edits != 0 && edits != long(entries.size()))
    fields.problem_at("draw", "'draw' either lists layers or edits the default ones with +name and -name; do not mix the two");
  if (edits == 0) scene.draw.clear();
  scene.named_layers.clear();
  for (const std::string& entry : entries) {
    const bool remove = entry.starts_with('-');
    const std::string name = remove || entry.starts_with('+') ? entry.substr(1) : entry;
    if (!index_of_name(layer_names(), name))
      fields.problem_at("draw", "unknown layer '" + name + "' in 'draw':" + did_you_mean(name, words_of(layer_names())) +
                                 " `chainreel help layers` lists all.");
    std::erase(scene.draw, name);
    if (remove) continue;
    scene.draw.push_back(name);
    scene.named_layers.push_back(name);
  }
}

std::string draw_text(const Scene& scene) {
  return flow_text([&](YAML::Emitter& out) { emit_list(out, scene.draw, [](const std::string& name) { return name; }); });
}

KeyText told_fit() {
  static constexpr Name motion[] = {{"motion", "all of it"}};
  return told_either("camera.fit",
                     {told_word("", motion, ""), told_list("", told("", KeyForm::number, ""),
                                                           "left, bottom, right, top: m right and up of the world's origin")},
                     "the part that is shown: motion, or [left, bottom, right, top] in metres")
      .in("m");
}

void read_fit(Fields& camera, Scene& scene) {
  const YAML::Node node = camera.find("fit");
  if (!node.IsDefined() || (node.IsScalar() && node.Scalar() == "motion")) return;
  if (!node.IsSequence() || node.size() != 4)
    return camera.problem_at("fit", "'" + camera.path("fit") +
                                        "' must be motion, or the part that is shown in metres: fit: [left, bottom, right, top]");
  std::vector<double> edges;
  if (!camera.read("fit", edges)) return;
  if (!(edges[0] < edges[2]) || !(edges[1] < edges[3]))
    return camera.problem_at("fit", "'" + camera.path("fit") +
                                        "' must grow from left to right and from bottom to top: fit: [-1, -2, 1, 0.5]");
  scene.camera.fit = {edges[0], edges[1], edges[2], edges[3]};
}

// What the scene leaves to the film stays left to it.
std::string fit_text(const Scene& scene) {
  const auto& fit = scene.camera.fit;
  return fit ? flow_text([&](YAML::Emitter& out) { emit_numbers(out, {fit->begin(), fit->end()}); }) : "";
}

KeyText told_layout() {
  return told_word("layout", names_of(PageLayout{}), "where things stand on the page");
}

void read_layout(Fields& fields, Scene& scene) {
  const std::size_t panels = std::max<std::size_t>(1, scene.compare.size());
  scene.layout = panels == 1 ? PageLayout::automatic : panels == 2 ? PageLayout::compare : PageLayout::grid;
  PageLayout layout{};
  if (!fields.read("layout", layout)) return;
  if (const std::string problem = layout_problem(layout, panels); !problem.empty())
    return fields.problem_at("layout", problem);
  scene.layout = layout;
}

std::string layout_text(const Scene& scene) {
  return to_string(scene.layout);
}

// An entry's keys are those of a scene that are no page's, see schema.cpp.
KeyText told_compare() {
  return told_list("compare", told_record("", {}, "the keys that the panel changes, also dotted; `title` if the made-up one does not do"),
                   "two to twelve variants of the scene, a panel each");
}

}  // namespace chainreel
