// Readers of single values: each adds to the list of problems what is wrong with its node and goes on.
// Internal.
#pragma once

#include <optional>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "core/frame_rate.hpp"
#include "core/names.hpp"
#include "scene/scene.hpp"
#include "scene/yaml_document.hpp"

namespace chainreel {

inline constexpr double kMostFps = 1e6;  // frames/s

// A path that the scene names, as found from the working folder: relative to the scene file unless absolute.
std::string beside(const std::string& scene, const std::string& named);
// The same, or where no such file lies there that of this name which comes with the program, if there is one.
std::string input_beside(const std::string& scene, const std::string& named);

// The keys of one mapping: every key must be asked for once before finish().
class Fields {
 public:
  // `prefix` is the dotted path of the mapping, "" for the root.
  Fields(const YamlDocument& document, const YAML::Node& map, std::string prefix, ProblemList& problems);

  // The node of a key, or an undefined one. Remembers that the key is known.
  YAML::Node find(const std::string& key);
  Place place_of(const YAML::Node& node, const std::string& key) const;
  bool has(const std::string& key);  // null counts as absent: `--set step=null`
  void problem_at(const std::string& key, const std::string& message);
  std::string path(const std::string& key) const { return prefix_.empty() ? key : prefix_ + "." + key; }

  // Each leaves `value` alone where the key is absent or wrong, and then returns false.
  bool read(const std::string& key, std::string& value);
  bool read(const std::string& key, double& value);
  bool read(const std::string& key, int& value);
  bool read(const std::string& key, bool& value);
  bool read(const std::string& key, FrameRate& value);
  bool read(const std::string& key, Accuracy& value);
  bool read(const std::string& key, std::vector<double>& value);  // numbers, `90deg`, `pi/2`
  bool read(const std::string& key, Eigen::Vector3d& value);
  // The same, or single ones by their indices from 1, {2: 90deg}, as `--set start.q.2=90deg` makes where there is no list: those
  // that are left out are NaN, which stand for the default.
  bool read_some(const std::string& key, std::vector<double>& value);  // behind them one more NaN, as their count is not known
  // The same, or by the names of joints, {elbow: 90deg, base: [0, 0, 1]}, or {base: {z: 1}} as --set makes of base.z.
  bool read_some(const std::string& key, std::vector<double>& value, std::vector<JointNumbers>& of_joints);
  bool read_some(const std::string& key, std::optional<Eigen::Vector3d>& value);
  bool read(const std::string& key, std::vector<std::string>& value);
  bool read_seconds(const std::string& key, double& value);       // `1.5`, `1.5s` or `1.5 s`
  std::string paths_start(const std::string& key) const;  // in words, for a path that leads nowhere
  bool read_path(const std::string& key, std::string& value);  // relative to the scene file; of --set first to the working folder
  std::optional<std::size_t> read_word(const std::string& key, std::span<const Name> words);  // its index
  template <Named Enum>
  bool read(const std::string& key, Enum& value) {
    const std::optional<std::size_t> index = read_word(key, names_of(Enum{}));
    if (index) value = Enum(*index);
    return index.has_value();
  }
  // Null counts as absent, so that `--set step=null` takes a key away.
  template <class T>
  bool read(const std::string& key, std::optional<T>& value) {
    T one{};
    if (!has(key) || !read(key, one)) return false;
    value = one;
    return true;
  }
  // The mapping below a key; none where it is absent, or no mapping, which is a problem that says what it holds.
  std::optional<Fields> section(const std::string& key, const std::string& what_it_holds);

  // Unknown keys are problems that name the nearest known one.
  void finish(const std::string& topic = "scene");

  // Numbers that are read from now on are told in this unit; "": in any.
  void measure_in(std::string unit) { unit_ = std::move(unit); }

  ProblemList& problems() { return *problems_; }
  const YamlDocument& document() const { return *document_; }
  // Whether the command line says this key, or one below it.
  bool is_of_command_line(const std::string& key) const;
  // Whether the command line makes the motion of the file shorter, by which what `key` has there may begin too late.
  bool cuts_short(const std::string& key) const { return is_of_command_line("duration") && !is_of_command_line(key); }

 private:
  std::optional<std::string> scalar(const YAML::Node& node, const std::string& key,
                                    const std::string& wanted);
  std::optional<double> number(const YAML::Node& node, const std::string& key);
  bool read_entries(const std::string& key, std::vector<double>& value, std::vector<JointNumbers>* of_joints);
  bool read_joint(const std::string& joint, const YAML::Node& node, const std::string& key, std::vector<JointNumbers>& of_joints);

  const YamlDocument* document_;
  YAML::Node map_;
  std::string prefix_, unit_;
  ProblemList* problems_;
  std::vector<std::string> known_;
};

}  // namespace chainreel
