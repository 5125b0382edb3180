// A YAML file as a node tree, aliases and merge keys written out, with what is dangerous or ambiguous refused first: nesting
// deeper than 32, files over 1 MiB, aliases of aliases without end, duplicate keys, several documents. Internal to this floor.
#pragma once

#include <yaml-cpp/yaml.h>

#include <map>
#include <string>
#include <vector>

#include "core/error.hpp"

namespace chainreel {

// One `--set key=value` of the command line; the key may be dotted, the value is YAML.
struct Override {
  std::string key;
  std::string value;
};

// "--set key=value", as errors name it.
std::string name_of(const Override& one);

// Throws Error (usage) where there is no '=' or no key.
Override parse_override(const std::string& text);

// Whence the value at a dotted path came that was put there after reading.
struct Origin {
  std::string key;
  Place place;
  bool command_line = true;  // else from elsewhere in the file: what lies below has places of its own
};

struct YamlDocument {
  YAML::Node root;
  std::string file;
  std::string text;  // of the file
  std::vector<Override> overrides;
  std::vector<Origin> origins;
  bool is_panel = false;  // one of several on the page
  std::vector<YAML::Mark> marks{};  // of the lines that nodes count, where aliases were written out; else empty
  bool is_for_methods = false;  // read by a command with methods of its own: see MethodsOf

  // Where a node stands; `key` is its dotted path, so that overridden values name the command line.
  Place place_of(const YAML::Node& node, const std::string& key) const;

  // Whether --set put it there, or what it lies in.
  bool is_of_command_line(const std::string& key) const;
  // Whether that is this one, in whole or in part: what it lists may have been set anew since.
  bool holds(const Override& one) const;

  // The last one of those at the key or above it; null where the file has what stands there.
  const Origin* origin_of(const std::string& key) const;

  // Where each key stands, by its dotted path, as deep as mappings lie in mappings.
  std::map<std::string, Place> places() const;
};

// Words of a block (`title: >` or `|`) in one line: line breaks and tabs are spaces, none at its end.
std::string in_one_line(std::string words);

inline constexpr const char* kNoScene = "holds no scene: write `model: {links: [0.5, 0.4]}` and what else it needs, or let `chainreel init my_arm` write one";

// `lacking`: what is said of a file without keys.
YamlDocument load_yaml(const std::string& path, const std::vector<Override>& overrides,
                       const std::string& lacking = kNoScene);
// The same of a text that stands in no file; `file` is where paths start and what errors name.
YamlDocument yaml_document_of(const std::string& text, const std::string& file,
                              const std::vector<Override>& overrides, const std::string& lacking = kNoScene);
// Puts other values in the place of those that the document was read with: the same keys in the same order.
void replace_overrides(YamlDocument& document, const std::vector<Override>& overrides);

// Keys of a comparison that are none of its panels'.
inline constexpr const char* kKeysOfPage[] = {"title", "layout", "compare"};

// Keys of what is computed, tied or cut, which mean nothing where a recorded motion is shown as it was: a panel that shows one does not have those of its
// page, which are for the others.
inline constexpr const char* kKeysOfRuns[] = {"start", "torque", "push", "constraints", "stabilize", "baumgarte", "contact_force", "method", "step",
                                              "tolerance", "order", "accuracy", "limit", "expect"};

// The document that entry `index` (from 0) of `compare:` stands for: the file's keys without those, changed by the entry's own, which may be dotted. The entry is a mapping.
YamlDocument panel_document(const YamlDocument& whole, std::size_t index);

}  // namespace chainreel
