#include "scene/text/read_compare.hpp"

#include <algorithm>

#include "scene/keys/keys.hpp"
#include "scene/keys/own_keys.hpp"
#include "scene/text/scene_paths.hpp"

namespace chainreel {
namespace {

constexpr std::size_t kFewestPanels = 2, kMostPanels = 12;

// Keeps the problems of several readers, those that more than one of them found only once.
class Collected {
 public:
  void add(const Error& error) {
    for (const Problem& problem : error.problems())
      if (seen_.insert(to_string(problem)).second) problems_.push_back(problem);
  }
  void throw_if_any() const {
    if (!problems_.empty()) throw Error(ExitCode::bad_input, problems_);
  }

 private:
  std::set<std::string> seen_;
  std::vector<Problem> problems_;
};

// What can be said of the list before any panel is read.
void check_list(Fields& page, const YAML::Node& list) {
  if (!list.IsSequence() || list.size() < kFewestPanels || list.size() > kMostPanels) {
    page.problems().add(
        "'compare' must be a list of 2 to 12 panels, each with the keys that it changes: compare: [{method: "
        "explicit_euler}, {method: rk4}]",
        page.place_of(list, "compare"));
    return;
  }
  for (std::size_t i = 0; i < list.size(); ++i) {
    const std::string key = "compare." + std::to_string(i + 1);
    if (!list[i].IsMap()) {
      page.problems().add("panel " + std::to_string(i + 1) +
                              " must hold the keys that it changes, like {method: rk4}, or {} for none",
                          page.place_of(list[i], key));
      continue;
    }
    for (const auto& pair : list[i]) {
      const std::string name = pair.first.Scalar(), first = name.substr(0, name.find('.'));
      const std::vector<std::string>& shared = page_keys();
      if (std::find(shared.begin(), shared.end(), first) != shared.end())
        page.problems().add("'" + first + "' belongs to the whole picture: write it beside 'compare'",
                            page.document().place_of(pair.first, key + "." + name));
    }
  }
}

// What --set says of all panels, and each of them says itself, changes nothing.
void require_that_overrides_count(const YamlDocument& document, const std::vector<YamlDocument>& panels) {
  std::vector<Problem> problems;
  for (auto at = document.overrides.begin(); at != document.overrides.end(); ++at) {
    const Override& one = *at;
    // What comes later on the command line holds anyway.
    const auto replaces = [&](const Override& other) { return one.key == other.key || one.key.starts_with(other.key + "."); };
    if (std::any_of(at + 1, document.overrides.end(), replaces)) continue;
    const auto overrules = [&](const YamlDocument& panel) { return !panel.holds(one); };
    const bool is_of_page = std::find(std::begin(kKeysOfPage), std::end(kKeysOfPage), one.key.substr(0, one.key.find('.'))) != std::end(kKeysOfPage);
    if (is_of_page || one.value.empty() || !std::all_of(panels.begin(), panels.end(), overrules)) continue;
    problems.push_back({"'" + one.key + "' is set by each panel of 'compare' itself, so that this changes nothing: change a panel's, as by --set compare.1." +
                            one.key + "=" + one.value,
                        {name_of(one)},
                        true});
  }
  if (!problems.empty()) throw OverruledError(ExitCode::usage, std::move(problems));
}

// Where the page does not say how long it is, all panels are as long as the shortest recorded motion among them.
void share_duration(const YamlDocument& document, std::vector<Scene>& panels) {
  if (document.root["duration"].IsDefined() && !document.root["duration"].IsNull()) return;
  const Scene* shortest = nullptr;
  for (const Scene& panel : panels)
    if (panel.motion && (!shortest || panel.duration < shortest->duration)) shortest = &panel;
  if (!shortest) return;
  const double duration = shortest->duration;
  for (Scene& panel : panels) panel.duration = duration;
}

}  // namespace

bool is_comparison(const YamlDocument& document) {
  return document.root["compare"].IsDefined();
}

Scene read_comparison(const YamlDocument& document, const PanelReader& read_panel) {
  ProblemList own;
  Fields page(document, document.root, "", own);
  const YAML::Node list = page.find("compare");
  check_list(page, list);
  own.throw_if_any();

  std::vector<YamlDocument> documents;
  for (std::size_t i = 0; i < list.size(); ++i) documents.push_back(panel_document(document, i));
  Collected collected;
  std::vector<Scene> panels;
  for (const YamlDocument& panel : documents) {
    try {
      panels.push_back(read_panel(panel));
    } catch (const Error& error) {
      collected.add(error);
    }
  }
  collected.throw_if_any();
  require_that_overrides_count(document, documents);

  for (std::size_t i = 0; i < panels.size(); ++i) panels[i].panel = int(i) + 1;
  share_duration(document, panels);
  // What the page shares is the same in all panels.
  Scene scene = panels.front();
  scene.panel = 0;
  scene.title.clear();
  page.read("title", scene.title);
  scene.places = document.places();
  scene.absolute_paths = absolute_paths_of(document);
  scene.compare = std::move(panels);
  read_layout(page, scene);
  own.throw_if_any();
  return scene;
}

}  // namespace chainreel
