#include "scene/scene.hpp"

namespace chainreel {

const std::vector<std::string>& layer_names() {
  static const std::vector<std::string> names{"chain",        "trail",   "time",      "title",
                                              "torque_label", "ellipse", "scale_bar", "legend"};
  return names;
}

Place Scene::place_of(const std::string& key) const {
  const auto place = places.find(key);
  return place == places.end() ? Place{file, 0, 0} : place->second;
}

}  // namespace chainreel
