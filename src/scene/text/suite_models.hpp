// What a suite names: files that are there, and keys under which each of its models has something of its own. Internal to suite.cpp.
#pragma once

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "core/error.hpp"
#include "scene/keys/fields.hpp"

namespace chainreel {

// The models of a suite, as it names them, and their files.
class SuiteModels {
 public:
  void add(const std::string& named, const std::string& file) { list_.emplace_back(named, file); }
  std::size_t size() const { return list_.size(); }
  // The files that a key means: of the model that the suite names so, else of those whose file has that name. None: it is no model's.
  std::vector<std::string> called(const std::string& key) const;
  // "a.urdf and b.urdf"
  std::string names() const;

 private:
  std::vector<std::pair<std::string, std::string>> list_;
};

// `end_effector: {arm.urdf: tool, two.urdf: tip}`: by the file of the model; empty where it is one for all.
std::map<std::string, std::string> end_effectors_of(Fields& root, const SuiteModels& models);

// One text or a list of texts, each with its place.
std::vector<std::pair<std::string, Place>> texts_of(const YamlDocument& document, const YAML::Node& node, const std::string& key,
                                                    const std::string& like, ProblemList& problems);
// Whether the file at `path` is there; where not, adds a problem that names the nearest.
bool require_file_of_suite(const std::string& named, const std::string& path, const Place& place, ProblemList& problems);
// What is wrong with an input is one of its problems; a limit or a signal ends the reading.
void add_problems(const Error& error, ProblemList& problems);

}  // namespace chainreel
