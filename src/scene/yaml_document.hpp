// A YAML file as a node tree, with what is dangerous or ambiguous refused first: aliases and anchors, nesting
// deeper than 32, files over 1 MiB, duplicate keys, several documents. Internal to this floor: the only
// header with yaml-cpp.
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

// Throws Error (usage) where there is no '=' or no key.
Override parse_override(const std::string& text);

struct YamlDocument {
  YAML::Node root;
  std::string file;
  std::vector<Override> overrides;

  // Where a node stands; `key` is its dotted path, so that overridden values name the command line.
  Place place_of(const YAML::Node& node, const std::string& key) const;
};

YamlDocument load_yaml(const std::string& path, const std::vector<Override>& overrides);

}  // namespace chainreel
