// What panels differ in, in words: of lists their elements, with symbols and units, as they were written. Internal to this shelf.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "scene/scene.hpp"
#include "scene/text/panels.hpp"
#include "scene/text/title_values.hpp"
#include "scene/text/write_scene.hpp"

namespace chainreel {

// How a list is called: "$q$" and "$q_#$" with a place for the index; "@" in the first is a place for the value, else it stands behind "=".
struct ListName {
  std::string whole, element;
  bool has_axes = false;  // whose elements are of x, y and z
};
// "$q_2$ = 30\u00B0" of each: the elements in which they differ, or all of it where all differ, or where they are not equally long.
// A single value, for all alike, has no index.
std::vector<std::string> words_of_lists(const ListName& name, const std::vector<std::vector<TitleValue>>& all);

// The unit of an element: of a coordinate ("q", "qd", "qdd", "tau"), or itself.
std::string unit_at(const std::string& unit, std::size_t index, const CoordinateUnits& units);

// What a list says of each panel, of starts, torques, gravity and a payload's place. Empty where that cannot be said so. `entries`: one a panel, or null.
std::vector<std::string> words_by_element(const std::vector<const Scene*>& panels, const std::vector<const SceneEntry*>& entries,
                                          const CoordinateUnits& units);

}  // namespace chainreel
