// `compare:` the panels of a film, each the scene with what it changes. Internal.
#pragma once

#include <functional>

#include "scene/keys/fields.hpp"

namespace chainreel {

bool is_comparison(const YamlDocument& document);

// Reads a document of one panel; throws Error with its problems.
using PanelReader = std::function<Scene(const YamlDocument& document)>;

// What --set says is set by each panel itself: it would change nothing.
class OverruledError : public Error {
 public:
  using Error::Error;
};

// The whole scene with its panels in Scene::compare. Throws Error with the problems of all panels, each once, OverruledError where
// there are none but that.
Scene read_comparison(const YamlDocument& document, const PanelReader& read_panel);

}  // namespace chainreel
