#include "scene/fields.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "core/format.hpp"
#include "scene/quantity.hpp"

namespace chainreel {

std::string beside(const std::string& scene, const std::string& named) {
  const std::filesystem::path target(named);
  if (target.is_absolute()) return named;
  return (std::filesystem::path(scene).parent_path() / target).lexically_normal().string();
}

Fields::Fields(const YamlDocument& document, const YAML::Node& map, std::string prefix, ProblemList& problems)
    : document_(&document), map_(map), prefix_(std::move(prefix)), problems_(&problems) {}

bool Fields::has(const std::string& key) {
  const YAML::Node node = find(key);
  return node.IsDefined() && !node.IsNull();
}

void Fields::problem_at(const std::string& key, const std::string& message) {
  problems().add(message, place_of(find(key), key));
}

YAML::Node Fields::find(const std::string& key) {
  if (std::find(known_.begin(), known_.end(), key) == known_.end()) known_.push_back(key);
  for (const auto& pair : map_)
    if (pair.first.Scalar() == key) return pair.second;
  return YAML::Node(YAML::NodeType::Undefined);
}

Place Fields::place_of(const YAML::Node& node, const std::string& key) const {
  return document_->place_of(node, path(key));
}

std::optional<std::string> Fields::scalar(const YAML::Node& node, const std::string& key,
                                          const std::string& wanted) {
  if (node.IsScalar()) return node.Scalar();
  problems_->add("'" + path(key) + "' must be " + wanted, place_of(node, key));
  return std::nullopt;
}

std::optional<double> Fields::number(const YAML::Node& node, const std::string& key) {
  const std::optional<std::string> text = scalar(node, key, "a number");
  if (!text) return std::nullopt;
  try {
    return parse_quantity(*text, place_of(node, key));
  } catch (const Error& error) {
    for (const Problem& problem : error.problems())
      problems_->add("'" + path(key) + "': " + problem.message, problem.place);
    return std::nullopt;
  }
}

void Fields::read(const std::string& key, std::string& value) {
  const YAML::Node node = find(key);
  if (!node.IsDefined()) return;
  if (const auto text = scalar(node, key, "text")) value = *text;
}

void Fields::read(const std::string& key, double& value) {
  const YAML::Node node = find(key);
  if (!node.IsDefined()) return;
  if (const auto one = number(node, key)) value = *one;
}

void Fields::read(const std::string& key, int& value) {
  const YAML::Node node = find(key);
  if (!node.IsDefined()) return;
  const auto one = number(node, key);
  if (!one) return;
  if (*one != std::floor(*one) || std::abs(*one) > 1e9)
    problems_->add("'" + path(key) + "' must be a whole number", place_of(node, key));
  else
    value = int(*one);
}

void Fields::read(const std::string& key, bool& value) {
  const YAML::Node node = find(key);
  if (!node.IsDefined()) return;
  const auto text = scalar(node, key, "true or false");
  if (!text) return;
  if (*text != "true" && *text != "false")
    problems_->add("'" + path(key) + "' must be true or false", place_of(node, key));
  else
    value = *text == "true";
}

void Fields::read_path(const std::string& key, std::string& value) {
  read(key, value);
  if (!value.empty()) value = beside(document_->file, value);
}

void Fields::read(const std::string& key, FrameRate& value) {
  const YAML::Node node = find(key);
  if (!node.IsDefined()) return;
  const auto text = scalar(node, key, "frames per second, like 60 or 30000/1001");
  if (!text) return;
  const std::size_t slash = text->find('/');
  const auto num = parse_number(text->substr(0, slash));
  const auto den =
      slash == std::string::npos ? std::optional<double>(1) : parse_number(text->substr(slash + 1));
  // A decimal rate is kept to a thousandth: 23.976 is 23976/1000.
  const double scale = num && *num != std::floor(*num) ? 1000 : 1;
  const bool good = num && den && *num > 0 && *den >= 1 && *den <= 1e5 && *num * scale <= 1e6 &&
                    *den == std::floor(*den) && *num * scale == std::round(*num * scale);
  if (!good)
    problems_->add("'" + path(key) + "' must be a rate like 60, 29.97 or 30000/1001", place_of(node, key));
  else
    value = {int(*num * scale), int(*den * scale)};
}

void Fields::read(const std::string& key, std::vector<double>& value) {
  const YAML::Node node = find(key);
  if (!node.IsDefined()) return;
  if (!node.IsSequence()) {
    problems_->add("'" + path(key) + "' must be a list of numbers: [0, 90deg]", place_of(node, key));
    return;
  }
  value.clear();
  for (std::size_t i = 0; i < node.size(); ++i)
    if (const auto one = number(node[i], key + "." + std::to_string(i + 1))) value.push_back(*one);
}

void Fields::read(const std::string& key, std::optional<Eigen::Vector3d>& value) {
  const YAML::Node node = find(key);
  if (!node.IsDefined()) return;
  std::vector<double> numbers;
  if (node.IsSequence() && node.size() == 3)
    for (std::size_t i = 0; i < 3; ++i)
      if (const auto one = number(node[i], key + "." + std::to_string(i + 1))) numbers.push_back(*one);
  if (!node.IsSequence() || node.size() != 3)
    problems_->add("'" + path(key) + "' must be three numbers, world x y z: [0, -9.81, 0]",
                   place_of(node, key));
  else if (numbers.size() == 3)
    value = Eigen::Vector3d(numbers[0], numbers[1], numbers[2]);
}

void Fields::read(const std::string& key, std::vector<std::string>& value) {
  const YAML::Node node = find(key);
  if (!node.IsDefined()) return;
  if (!node.IsSequence()) {
    problems_->add("'" + path(key) + "' must be a list of names: [chain, trail]", place_of(node, key));
    return;
  }
  value.clear();
  for (std::size_t i = 0; i < node.size(); ++i)
    if (const auto one = scalar(node[i], key + "." + std::to_string(i + 1), "a name")) value.push_back(*one);
}

void Fields::finish() {
  for (const auto& pair : map_) {
    const std::string& key = pair.first.Scalar();
    if (std::find(known_.begin(), known_.end(), key) != known_.end()) continue;
    std::string known;
    for (const std::string& one : known_) known += (known.empty() ? "" : ", ") + one;
    problems_->add(
        "unknown key '" + path(key) + "':" + did_you_mean(key, known_) + " The keys here are " + known + ".",
        place_of(pair.first, key));
  }
}

}  // namespace chainreel
