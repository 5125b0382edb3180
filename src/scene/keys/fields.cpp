#include "scene/keys/fields.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "core/data_folder.hpp"
#include "core/format.hpp"
#include "scene/quantity.hpp"

namespace chainreel {

std::string beside(const std::string& scene, const std::string& named) {
  const std::filesystem::path target(named);
  if (target.is_absolute()) return named;
  return (std::filesystem::path(scene).parent_path() / target).lexically_normal().string();
}

std::string input_beside(const std::string& scene, const std::string& named) {
  const std::string own = beside(scene, named);
  std::error_code ignored;
  if (std::filesystem::exists(own, ignored)) return own;
  const std::string shipped = shipped_input(named);
  return shipped.empty() ? own : shipped;
}

Fields::Fields(const YamlDocument& document, const YAML::Node& map, std::string prefix, ProblemList& problems)
    : document_(&document), map_(map), prefix_(std::move(prefix)), problems_(&problems) {}

bool Fields::has(const std::string& key) {
  const YAML::Node node = find(key);
  return node.IsDefined() && !node.IsNull();
}

void Fields::problem_at(const std::string& key, const std::string& message) {
  const YAML::Node node = find(key);
  problems().add(message, node.IsDefined() ? place_of(node, key) : Place{document_->file, 0, 0});
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
  if (node.IsScalar()) return in_one_line(node.Scalar());
  problems_->add("'" + path(key) + "' must be " + wanted, place_of(node, key));
  return std::nullopt;
}

std::optional<double> Fields::number(const YAML::Node& node, const std::string& key) {
  const std::optional<std::string> text = scalar(node, key, "a number");
  if (!text) return std::nullopt;
  try {
    return parse_quantity(*text, place_of(node, key), unit_);
  } catch (const Error& error) {
    for (const Problem& problem : error.problems())
      problems_->add("'" + path(key) + "': " + problem.message, problem.place);
    return std::nullopt;
  }
}

bool Fields::read(const std::string& key, std::string& value) {
  const YAML::Node node = find(key);
  if (!node.IsDefined()) return false;
  const auto text = scalar(node, key, "text");
  if (text) value = *text;
  return text.has_value();
}

bool Fields::read_seconds(const std::string& key, double& value) {
  const YAML::Node node = find(key);
  if (!node.IsDefined()) return false;
  try {
    value = parse_quantity(node.IsScalar() ? node.Scalar() : "", {}, "s");
    return true;
  } catch (const Error&) {
    problem_at(key, "'" + path(key) + "' is " + (node.IsScalar() ? "'" + node.Scalar() + "'" : "no number") +
                        ", but seconds are wanted, like 1.5s");
    return false;
  }
}

bool Fields::read(const std::string& key, double& value) {
  const YAML::Node node = find(key);
  if (!node.IsDefined()) return false;
  const auto one = number(node, key);
  if (one) value = *one;
  return one.has_value();
}

bool Fields::read(const std::string& key, int& value) {
  const YAML::Node node = find(key);
  if (!node.IsDefined()) return false;
  const auto one = number(node, key);
  if (!one) return false;
  const bool is_whole = *one == std::floor(*one) && std::abs(*one) <= 1e9;
  if (is_whole)
    value = int(*one);
  else
    problems_->add("'" + path(key) + "' must be a whole number", place_of(node, key));
  return is_whole;
}

bool Fields::read(const std::string& key, bool& value) {
  const YAML::Node node = find(key);
  if (!node.IsDefined()) return false;
  const auto text = scalar(node, key, "true or false");
  if (!text) return false;
  const bool is_truth = *text == "true" || *text == "false";
  if (is_truth)
    value = *text == "true";
  else
    problems_->add("'" + path(key) + "' must be true or false", place_of(node, key));
  return is_truth;
}

std::string Fields::paths_start(const std::string& key) const {
  return document_->is_of_command_line(path(key)) ? "paths of --set are looked for from the working folder, then from the scene's"
                                                  : "paths are relative to the scene file";
}

bool Fields::read_path(const std::string& key, std::string& value) {
  if (!read(key, value)) return false;
  if (value.empty()) return true;
  // What the command line names lies where it is typed; else it is meant as in the file.
  std::error_code ignored;
  const bool is_here = document_->is_of_command_line(path(key)) && std::filesystem::is_regular_file(value, ignored);
  if (!is_here) value = input_beside(document_->file, value);
  return true;
}

std::optional<std::size_t> Fields::read_word(const std::string& key, std::span<const Name> words) {
  const YAML::Node node = find(key);
  if (!node.IsDefined()) return std::nullopt;
  const auto text = scalar(node, key, "a word: " + alternatives(words));
  if (!text) return std::nullopt;
  const std::optional<std::size_t> index = index_of_name(words, *text);
  if (!index) problems_->add("'" + path(key) + "' " + misnamed(words, *text), place_of(node, key));
  return index;
}

bool Fields::read(const std::string& key, Accuracy& value) {
  std::string text;
  if (!has(key) || !read(key, text)) return false;
  try {
    value = parse_accuracy(text);
    return true;
  } catch (const Error& error) {
    problem_at(key, "'" + path(key) + "': " + error.problems().front().message);
    return false;
  }
}

bool Fields::read(const std::string& key, FrameRate& value) {
  const YAML::Node node = find(key);
  if (!node.IsDefined()) return false;
  const auto text = scalar(node, key, "frames per second, like 60 or 30000/1001");
  if (!text) return false;
  const std::size_t slash = text->find('/');
  const auto num = parse_number(text->substr(0, slash));
  const auto den =
      slash == std::string::npos ? std::optional<double>(1) : parse_number(text->substr(slash + 1));
  // A decimal rate is kept to a thousandth: 23.976 is 23976/1000.
  const double scale = num && *num != std::floor(*num) ? 1000 : 1;
  const bool good = num && den && *num > 0 && *den >= 1 && *den <= 1e5 && *num * scale <= kMostFps &&
                    *den == std::floor(*den) && *num * scale == std::round(*num * scale);
  if (good)
    value = {int(*num * scale), int(*den * scale)};
  else
    problems_->add("'" + path(key) + "' must be a rate like 60, 29.97 or 30000/1001", place_of(node, key));
  return good;
}

bool Fields::read(const std::string& key, std::vector<double>& value) {
  const YAML::Node node = find(key);
  if (!node.IsDefined()) return false;
  if (!node.IsSequence()) {
    problems_->add("'" + path(key) + "' must be a list of numbers: [0, 90deg]", place_of(node, key));
    return false;
  }
  value.clear();
  for (std::size_t i = 0; i < node.size(); ++i)
    if (const auto one = number(node[i], key + "." + std::to_string(i + 1))) value.push_back(*one);
  return value.size() == node.size();
}

bool Fields::read_some(const std::string& key, std::vector<double>& value) {
  return read_entries(key, value, nullptr);
}

bool Fields::read_some(const std::string& key, std::vector<double>& value, std::vector<JointNumbers>& of_joints) {
  return read_entries(key, value, &of_joints);
}

bool Fields::read_entries(const std::string& key, std::vector<double>& value, std::vector<JointNumbers>* of_joints) {
  const YAML::Node node = find(key);
  if (of_joints != nullptr && node.IsMap() && node.size() == 0) return true;
  if (!node.IsMap() || node.size() == 0) return read(key, value);
  constexpr double kMostEntries = 1000;  // more than chains have
  std::vector<double> some;
  bool is_good = true;
  for (const auto& pair : node) {
    const std::string& index = pair.first.Scalar();
    const std::string entry = key + "." + index;
    const std::optional<double> at = parse_number(index);
    if (!at && of_joints != nullptr) {
      is_good &= read_joint(index, pair.second, entry, *of_joints);
      continue;
    }
    if (!at || *at < 1 || *at > kMostEntries || *at != std::floor(*at)) {
      problems_->add({"'" + path(key) + "' is a list, whose entries are counted from 1: '" + index + "' is none", place_of(pair.second, entry), true});
      is_good = false;
      continue;
    }
    some.resize(std::max(some.size(), std::size_t(*at)), std::nan(""));
    const std::optional<double> one = number(pair.second, entry);
    if (one) some[std::size_t(*at) - 1] = *one;
    is_good &= one.has_value();
  }
  some.push_back(std::nan(""));
  if (is_good) value = std::move(some);
  return is_good;
}

bool Fields::read_joint(const std::string& joint, const YAML::Node& node, const std::string& key, std::vector<JointNumbers>& of_joints) {
  if (node.IsMap()) {
    bool is_good = true;
    for (const auto& pair : node)
      is_good &= read_joint(joint + "." + pair.first.Scalar(), pair.second, key + "." + pair.first.Scalar(), of_joints);
    return is_good;
  }
  JointNumbers read{joint, {}, {}, place_of(node, key)};
  const bool is_list = node.IsSequence();
  const std::size_t count = is_list ? node.size() : 1;
  for (std::size_t i = 0; i < count; ++i) {
    const YAML::Node entry = is_list ? node[i] : node;
    if (const auto one = number(entry, is_list ? key + "." + std::to_string(i + 1) : key)) {
      read.values.push_back(*one);
      read.written.push_back(entry.Scalar());
    }
  }
  const bool is_good = read.values.size() == count;
  of_joints.push_back(std::move(read));
  return is_good;
}

bool Fields::read_some(const std::string& key, std::optional<Eigen::Vector3d>& value) {
  const YAML::Node node = find(key);
  if (!node.IsMap() || node.size() == 0) return read(key, value);
  std::vector<double> some;
  if (!read_some(key, some)) return false;
  if (some.size() > 4) {
    problems_->add("'" + path(key) + "' has three numbers, world x y z: there is no '" + std::to_string(some.size() - 1) + "'", place_of(node, key));
    return false;
  }
  some.resize(3, std::nan(""));
  value = Eigen::Vector3d(some[0], some[1], some[2]);
  return true;
}

bool Fields::read(const std::string& key, Eigen::Vector3d& value) {
  const YAML::Node node = find(key);
  if (!node.IsDefined()) return false;
  if (node.IsMap() && node.size() > 0) {
    std::optional<Eigen::Vector3d> some;
    if (!read_some(key, some)) return false;
    for (int i = 0; i < 3; ++i)
      if (!std::isnan((*some)[i])) value[i] = (*some)[i];
    return true;
  }
  if (!node.IsSequence() || node.size() != 3) {
    problems_->add("'" + path(key) + "' must be three numbers, x y z: " + (key == "gravity" ? "[0, -9.81, 0]" : "[0.1, 0, 0]"), place_of(node, key));
    return false;
  }
  std::vector<double> numbers;
  if (!read(key, numbers)) return false;
  value = Eigen::Vector3d(numbers[0], numbers[1], numbers[2]);
  return true;
}

bool Fields::read(const std::string& key, std::vector<std::string>& value) {
  const YAML::Node node = find(key);
  if (!node.IsDefined()) return false;
  if (!node.IsSequence()) {
    problems_->add("'" + path(key) + "' must be a list of names: [chain, trail]", place_of(node, key));
    return false;
  }
  value.clear();
  for (std::size_t i = 0; i < node.size(); ++i)
    if (const auto one = scalar(node[i], key + "." + std::to_string(i + 1), "a name")) value.push_back(*one);
  return value.size() == node.size();
}

std::optional<Fields> Fields::section(const std::string& key, const std::string& what_it_holds) {
  const YAML::Node node = find(key);
  if (!node.IsDefined()) return std::nullopt;
  if (node.IsMap()) return Fields(*document_, node, path(key), *problems_);
  problems_->add("'" + path(key) + "' must hold " + what_it_holds, place_of(node, key));
  return std::nullopt;
}

void Fields::finish(const std::string& topic) {
  for (const auto& pair : map_) {
    const std::string& key = pair.first.Scalar();
    if (std::find(known_.begin(), known_.end(), key) != known_.end()) continue;
    constexpr std::size_t kFewKeys = 12;
    const std::string others =
        known_.size() > kFewKeys ? " `chainreel help " + topic + "` tells of all keys." : " The keys here are " + joined(known_) + ".";
    problems_->add({"unknown key '" + path(key) + "':" + did_you_mean(key, known_) + others, place_of(pair.first, key), true});
  }
}

bool Fields::is_of_command_line(const std::string& key) const {
  return std::ranges::any_of(document_->origins, [&](const Origin& one) {
    return one.command_line && (one.key == key || one.key.starts_with(key + "."));
  });
}

}  // namespace chainreel
