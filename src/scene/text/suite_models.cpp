#include "scene/text/suite_models.hpp"

#include <filesystem>

#include "core/format.hpp"

namespace chainreel {
namespace {

namespace fs = std::filesystem;

std::string nearest_file(const std::string& wanted) {
  std::vector<std::string> names;
  std::error_code ignored;
  const fs::path folder = fs::path(wanted).parent_path();
  for (const auto& entry : fs::directory_iterator(folder.empty() ? fs::path(".") : folder, ignored))
    if (names.size() < 1000) names.push_back(entry.path().filename().string());
  return did_you_mean(fs::path(wanted).filename().string(), names);
}

}  // namespace

std::vector<std::string> SuiteModels::called(const std::string& key) const {
  std::vector<std::string> files;
  for (const auto& [named, file] : list_)
    if (key == named || fs::path(key).lexically_normal() == fs::path(named).lexically_normal()) return {file};
  for (const auto& [named, file] : list_)
    if (key.ends_with(".urdf") && key == fs::path(named).filename()) files.push_back(file);
  return files;
}

std::string SuiteModels::names() const {
  std::vector<std::string> names;
  for (const auto& [named, file] : list_) names.push_back(named);
  return joined(names);
}

std::map<std::string, std::string> end_effectors_of(Fields& root, const SuiteModels& models) {
  std::map<std::string, std::string> found;
  if (!root.has("end_effector")) return found;
  const YAML::Node node = root.find("end_effector");
  if (!node.IsMap()) return found;
  const std::string like = "end_effector: {arm.urdf: tool}";
  if (node.size() == 0) root.problem_at("end_effector", "'end_effector' must be a link, or name one of each model: " + like);
  for (const auto& pair : node) {
    const std::string& key = pair.first.Scalar();
    const std::vector<std::string> own = models.called(key);
    const Place place = root.place_of(pair.first, key);
    if (own.size() > 1)
      root.problems().add("'" + key + "' could be any of " + joined(own) + ": name it as `model:` does", place);
    else if (own.empty())
      root.problems().add("'end_effector." + key + "' is no model of this suite: " + (models.size() == 0 ? "it has none" : "it has " + models.names()), place);
    else if (!pair.second.IsScalar() || pair.second.Scalar().empty())
      root.problems().add("'end_effector." + key + "' must be the name of a link: " + like, place);
    else
      found[own.front()] = pair.second.Scalar();
  }
  return found;
}

void add_problems(const Error& error, ProblemList& problems) {
  if (error.code() != ExitCode::bad_input && error.code() != ExitCode::usage) throw error;
  for (const Problem& problem : error.problems()) problems.add(problem.message, problem.place);
}

bool require_file_of_suite(const std::string& named, const std::string& path, const Place& place, ProblemList& problems) {
  std::error_code ignored;
  if (fs::is_regular_file(path, ignored)) return true;
  problems.add("there is no file '" + named + "' (looked for " + path + "):" + nearest_file(path) +
                   " Paths are relative to the suite's file.",
               place);
  return false;
}

std::vector<std::pair<std::string, Place>> texts_of(const YamlDocument& document, const YAML::Node& node, const std::string& key,
                                                    const std::string& like, ProblemList& problems) {
  std::vector<std::pair<std::string, Place>> texts;
  const auto add = [&](const YAML::Node& one) {
    if (one.IsScalar() && !one.Scalar().empty())
      texts.emplace_back(one.Scalar(), document.place_of(one, key));
    else
      problems.add("'" + key + "' must be one or a list: " + like, document.place_of(one, key));
  };
  if (!node.IsSequence())
    add(node);
  else if (node.size() == 0)
    problems.add("'" + key + "' is an empty list: " + like, document.place_of(node, key));
  else
    for (const YAML::Node& one : node) add(one);
  return texts;
}

}  // namespace chainreel
