#include "scene/text/scene_difference.hpp"

#include <algorithm>

#include "core/change_words.hpp"
#include "core/error.hpp"
#include "core/format.hpp"
#include "scene/keys/own_keys.hpp"
#include "scene/yaml_document.hpp"

namespace chainreel {
namespace {

std::string text_of_node(const YAML::Node& node) {
  if (!node.IsDefined()) return "left out";
  return node.IsScalar() ? node.Scalar() : flow_text([&](YAML::Emitter& out) { out << node; });
}

bool holds_mappings(const YAML::Node& list) {
  return std::any_of(list.begin(), list.end(), [](const auto& entry) { return entry.IsMap(); });
}

// "without trail, with ellipse"; "" where both hold the same, if not as often.
std::string members_text(const YAML::Node& before, const YAML::Node& after) {
  std::vector<std::string> changes;
  const auto add = [&](const char* word, const YAML::Node& these, const YAML::Node& those) {
    for (const auto& one : these) {
      const std::string text = text_of_node(one);
      if (std::none_of(those.begin(), those.end(),
                       [&](const auto& other) { return text_of_node(other) == text; }))
        changes.push_back(word + text);
    }
  };
  add("without ", before, after);
  add("with ", after, before);
  return joined(changes);
}

class SceneComparison {
 public:
  // Either may be undefined, which says that the key is left out.
  void compare(const std::string& key, const YAML::Node& before, const YAML::Node& after) {
    if ((before.IsMap() || !before.IsDefined()) && (after.IsMap() || !after.IsDefined()))
      compare_mappings(key, before, after);
    else if (before.IsSequence() && after.IsSequence())
      compare_lists(key, before, after);
    else
      compare_values(key, text_of_node(before), text_of_node(after));
  }

  std::vector<std::string> take() { return std::move(sentences_); }

 private:
  // Operator [] gives what throws at the next question where there is no such key.
  static YAML::Node value_in(const YAML::Node& mapping, const std::string& key) {
    for (const auto& pair : mapping)
      if (pair.first.Scalar() == key) return pair.second;
    return YAML::Node(YAML::NodeType::Undefined);
  }

  void compare_mappings(const std::string& key, const YAML::Node& before, const YAML::Node& after) {
    const std::string above = key.empty() ? "" : key + ".";
    const std::size_t told = sentences_.size();
    for (const auto& pair : after)
      compare(above + pair.first.Scalar(), value_in(before, pair.first.Scalar()), pair.second);
    for (const auto& pair : before)
      if (!value_in(after, pair.first.Scalar()).IsDefined())
        compare(above + pair.first.Scalar(), pair.second, YAML::Node(YAML::NodeType::Undefined));
    if (before.IsDefined() != after.IsDefined() && sentences_.size() == told)  // an empty one
      compare_values(key, text_of_node(before), text_of_node(after));
  }

  void compare_lists(const std::string& key, const YAML::Node& before, const YAML::Node& after) {
    const std::size_t most = std::max(before.size(), after.size());
    if (before.size() == after.size() || holds_mappings(before) || holds_mappings(after)) {
      const auto entry = [](const YAML::Node& list, std::size_t i) {
        return i < list.size() ? list[i] : YAML::Node(YAML::NodeType::Undefined);
      };
      for (std::size_t i = 0; i < most; ++i) {
        const YAML::Node old = entry(before, i), now = entry(after, i);
        if (old.IsDefined() && now.IsDefined())
          compare(key + "." + std::to_string(i + 1), old, now);
        else
          sentences_.push_back(key + ": " +
                               (now.IsDefined() ? "with " + text_of_node(now) : "without " + text_of_node(old)));
      }
      return;
    }
    const std::string members = members_text(before, after);
    if (!members.empty() && before.size() > 0 && after.size() > 0)
      sentences_.push_back(key + ": " + members);
    else
      compare_values(key, text_of_node(before), text_of_node(after));
  }

  void compare_values(const std::string& key, const std::string& before, const std::string& after) {
    if (before == after) return;
    const std::optional<double> old = parse_number(before), now = parse_number(after);
    if (old && now) {
      if (*old != *now) sentences_.push_back(key + " " + change_text(*old, *now, ""));
      return;
    }
    const bool are_words = (before + after).find_first_of(" ,:") == std::string::npos;
    sentences_.push_back(key + (are_words ? " " : ": ") + change_text(before, after));
  }

  std::vector<std::string> sentences_;
};

constexpr char kValue[] = "value";

// What stands below a key `value`; undefined: nothing.
YAML::Node value_node(const std::string& text) {
  if (text.empty()) return YAML::Node(YAML::NodeType::Undefined);
  return yaml_document_of(std::string(kValue) + ": " + text, "", {}).root[kValue];
}

}  // namespace

std::vector<std::string> explain_scene_texts(const std::string& before, const std::string& after) {
  SceneComparison comparison;
  comparison.compare("", yaml_document_of(before, "", {}).root, yaml_document_of(after, "", {}).root);
  return comparison.take();
}

std::vector<std::string> key_changes(const std::string& key, const std::string& before,
                                     const std::string& after) {
  if (before == after) return {};
  SceneComparison comparison;
  try {
    comparison.compare(key, value_node(before), value_node(after));
  } catch (const Error&) {
    // Of a record that was touched by hand: no YAML, but still another text.
    return {key + ": " + change_text(before, after)};
  }
  return comparison.take();
}

}  // namespace chainreel
