// The one JSON type; keys keep the order in which they were written.
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>

namespace chainreel {

using Json = nlohmann::ordered_json;

// Deeper than anything that this program writes; the type's own functions recurse.
inline constexpr int kDeepestJson = 200;

// A text of others; a discarded value (is_discarded(); no object, no array) where it is no JSON or nested deeper.
Json parse_json(std::string_view text);

// A key that a report always has is null where there is nothing to say.
template <class T>
Json or_null(const std::optional<T>& value) {
  return value ? Json(*value) : Json(nullptr);
}
inline Json or_null(const std::string& words) { return words.empty() ? Json(nullptr) : Json(words); }

}  // namespace chainreel
