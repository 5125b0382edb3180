// Aliases (*name) and merge keys (<<) of a YAML text, written out. Internal to this floor.
//
// The library lets an alias share its node with the anchor, so that a change of one (`--set`, a panel's key) changes the other,
// and knows no merge keys. A text that has them is therefore written once more without them, a line a value, and read again.
#pragma once

#include <yaml-cpp/yaml.h>

#include <string>
#include <vector>

namespace chainreel {

inline constexpr int kDeepestNesting = 32;

struct ExpandedYaml {
  std::string text;
  std::vector<YAML::Mark> marks;  // where each line's value stands in the text as it was: of an alias, where it was anchored
};

// Throws Error, with `file` and the place, for an alias within its own anchor, for what is too deep (exit 3) or too much (exit 7,
// before it is built), for a merge key without a mapping; YAML::Exception where the text is no YAML.
ExpandedYaml expand_aliases(const std::string& text, const std::string& file);

// Whether a plain key `<<` stands there, as the parser tells of scalars.
bool is_merge_key(const std::string& tag, const std::string& value);

}  // namespace chainreel
