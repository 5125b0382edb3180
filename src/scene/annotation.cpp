#include "scene/annotation.hpp"

#include "core/error.hpp"
#include "core/format.hpp"

namespace chainreel {

int find_point(const Chain& chain, const std::string& name) {
  const int link = find_frame(chain, name);
  if (link >= 0) return link;
  for (std::size_t b = 1; b < chain.bodies.size(); ++b)
    if (chain.bodies[b].joint.name == name) return find_frame(chain, chain.bodies[b].name);
  return -1;
}

int find_point(const Chain& chain, const PushEntry& push) {
  return push.frame.empty() ? chain.end_effector : find_point(chain, push.frame);
}

int find_point(const Chain& chain, const Scene& scene, const std::string& name) {
  const auto named = scene.frames.find(name);
  return find_point(chain, named == scene.frames.end() ? name : named->second);
}

double seconds_shown(const AnnotationEntry& entry) {
  constexpr double kAfterPause = 0.1, kStay = 2;  // kStay: of those that do not hold it
  return entry.hold > 0 ? entry.hold + kAfterPause : kStay;
}

std::vector<std::string> point_names(const Chain& chain) {
  std::vector<std::string> names;
  for (const Frame& frame : chain.frames) names.push_back(frame.name);
  for (std::size_t b = 1; b < chain.bodies.size(); ++b) names.push_back(chain.bodies[b].joint.name);
  return names;
}

void check_annotations(const Scene& page, const std::vector<const Scene*>& panels,
                       const std::vector<const Chain*>& chains) {
  ProblemList problems;
  for (std::size_t i = 0; i < page.annotate.size(); ++i) {
    const AnnotationEntry& entry = page.annotate[i];
    const std::string key = "'annotate." + std::to_string(i + 1);
    const auto panel = std::size_t(entry.panel - 1);
    if (entry.panel < 1 || panel >= chains.size()) {
      problems.add(key + ".panel' is " + std::to_string(entry.panel) + ", but the picture has " +
                       (chains.size() == 1 ? "one panel: leave it out" : std::to_string(chains.size()) + ", from 1 on"),
                   entry.place);
      continue;
    }
    if (entry.point.empty() || find_point(*chains[panel], *panels[panel], entry.point) >= 0) continue;
    std::vector<std::string> names = point_names(*chains[panel]);
    for (const auto& [name, wanted] : panels[panel]->frames) names.push_back(name);
    problems.add(key + ".point' names no link, no moving joint and no frame of " + chains[panel]->name + ": '" +
                     entry.point + "';" + did_you_mean(entry.point, names) + " They are " + joined(names) + ".",
                 entry.place);
  }
  problems.throw_if_any();
}

}  // namespace chainreel
