// The one JSON type; keys keep the order in which they were written.
#pragma once

#include <nlohmann/json.hpp>
#include <string_view>

namespace chainreel {

using Json = nlohmann::ordered_json;

// Deeper than anything that this program writes; the type's own functions recurse.
inline constexpr int kDeepestJson = 200;

// A text of others; a discarded value (is_discarded(); no object, no array) where it is no JSON or nested deeper.
Json parse_json(std::string_view text);

}  // namespace chainreel
