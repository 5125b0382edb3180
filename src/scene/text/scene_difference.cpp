#include "scene/text/scene_difference.hpp"

#include <algorithm>
#include <utility>

#include "scene/keys/own_keys.hpp"
#include "scene/yaml_document.hpp"

namespace chainreel {
namespace {

using Leaves = std::vector<std::pair<std::string, std::string>>;  // dotted key, value in one line

bool has_keys(const YAML::Node& node) {
  return node.IsMap() || (node.IsSequence() && std::any_of(node.begin(), node.end(),
                                                           [](const auto& entry) { return entry.IsMap(); }));
}

void add_leaves(const YAML::Node& node, const std::string& key, Leaves& leaves) {
  const std::string above = key.empty() ? "" : key + ".";
  if (node.IsMap() && node.size() > 0) {
    for (const auto& pair : node) add_leaves(pair.second, above + pair.first.Scalar(), leaves);
  } else if (node.IsSequence() && has_keys(node)) {
    for (std::size_t i = 0; i < node.size(); ++i) add_leaves(node[i], above + std::to_string(i + 1), leaves);
  } else {
    leaves.emplace_back(key, flow_text([&](YAML::Emitter& out) { out << node; }));
  }
}

Leaves leaves_of(const std::string& text) {
  Leaves leaves;
  add_leaves(yaml_document_of(text, "", {}).root, "", leaves);
  return leaves;
}

const std::string* find(const Leaves& leaves, const std::string& key) {
  const auto place =
      std::find_if(leaves.begin(), leaves.end(), [&](const auto& leaf) { return leaf.first == key; });
  return place == leaves.end() ? nullptr : &place->second;
}

}  // namespace

std::vector<std::string> explain_scene_texts(const std::string& before, const std::string& after) {
  const Leaves old = leaves_of(before), now = leaves_of(after);
  std::vector<std::string> sentences;
  for (const auto& [key, value] : now) {
    const std::string* was = find(old, key);
    if (was == nullptr || *was != value)
      sentences.push_back(key + ": " + (was == nullptr ? "not given" : *was) + " -> " + value);
  }
  for (const auto& [key, value] : old)
    if (find(now, key) == nullptr) sentences.push_back(key + ": " + value + " -> not given");
  return sentences;
}

}  // namespace chainreel
