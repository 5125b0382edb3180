#include "scene/scene.hpp"

#include <algorithm>
#include <filesystem>
#include <iterator>
#include <map>

#include "core/format.hpp"

namespace chainreel {

std::span<const Name> layer_names() {
  static const std::vector<Name> names = [] {
    std::vector<LayerRow> rows(std::begin(kLayerRows), std::end(kLayerRows));
    std::erase_if(rows, [](const LayerRow& layer) { return !*layer.meaning; });
    std::stable_sort(rows.begin(), rows.end(), [](const LayerRow& a, const LayerRow& b) {
      return a.by_default > 0 && (b.by_default == 0 || a.by_default < b.by_default);
    });
    std::vector<Name> all;
    for (const LayerRow& layer : rows) all.push_back({layer.name, layer.meaning});
    return all;
  }();
  return names;
}

const std::vector<std::string>& default_layers() {
  static const std::vector<std::string> names = [] {
    std::map<int, std::string> by_place;
    for (const LayerRow& layer : kLayerRows)
      if (layer.by_default > 0) by_place[layer.by_default] = layer.name;
    std::vector<std::string> all;
    for (const auto& [place, name] : by_place) all.push_back(name);
    return all;
  }();
  return names;
}

const std::vector<std::string>& default_layers_of_panels() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> some = default_layers();
    for (const char* name : {"target", "constraint_force"}) std::erase(some, name);
    return some;
  }();
  return names;
}

bool layer_needs(const std::string& name, LayerNeeds needs) {
  return std::any_of(std::begin(kLayerRows), std::end(kLayerRows),
                     [&](const LayerRow& layer) { return layer.name == name && layer.needs == needs; });
}

bool is_ghost_layout(const Scene& page) {
  return page.layout == PageLayout::ghost;
}

bool is_transparent(const Scene& scene) {
  return scene.layout == PageLayout::transparent || scene.video.preset == Preset::overlay;
}

Place Scene::place_of(const std::string& key) const {
  const auto place = places.find(key);
  return place == places.end() ? Place{file, 0, 0} : place->second;
}

void require_single_run(const Scene& scene) {
  if (scene.compare.empty()) return;
  throw Error(ExitCode::bad_input,
              "compares " + std::to_string(scene.compare.size()) +
                  " panels, but a single run is asked for: add `--set compare=` for what they share",
              scene.place_of("compare"));
}

std::size_t chosen_panel(const Scene& scene, int asked) {
  const std::size_t count = std::max<std::size_t>(scene.compare.size(), 1);
  if (asked > int(count))
    throw Error(ExitCode::usage, "--panel " + std::to_string(asked) + ": the scene has " + std::to_string(count) +
                                     (count == 1 ? " panel" : " panels"));
  if (asked == 0 && count > 1)
    throw Error(ExitCode::bad_input,
                "compares " + std::to_string(count) + " panels, but a single run is asked for: choose one, `--panel 1` to `--panel " +
                    std::to_string(count) + "`",
                scene.place_of("compare"));
  return std::size_t(std::max(asked, 1) - 1);
}

void require_computed_run(const Scene& scene, const std::string& command) {
  if (!scene.motion) return;
  throw Error(ExitCode::bad_input,
              "shows a recorded motion, of which nothing is computed by any method: `" + command +
                  "` takes a scene without `motion:`",
              scene.place_of("motion"));
}

std::string method_text(const Scene& scene) {
  if (scene.motion) return "replay of " + std::filesystem::path(scene.motion->csv).filename().string();
  std::string text = scene.method;
  if (scene.order) text += ", order " + std::to_string(*scene.order);
  if (scene.step) text += ", step " + format_shortest(*scene.step) + " s";
  if (scene.tolerance) text += ", tolerance " + format_shortest(*scene.tolerance);
  if (scene.chooses_method()) text += ", accuracy " + to_string(scene.accuracy);
  return text;
}

}  // namespace chainreel
