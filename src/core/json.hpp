// The one JSON type; keys keep the order in which they were written.
#pragma once

#include <nlohmann/json.hpp>

namespace chainreel {

using Json = nlohmann::ordered_json;

}  // namespace chainreel
