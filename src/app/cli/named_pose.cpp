#include "app/cli/named_pose.hpp"

#include <algorithm>
#include <filesystem>
#include <vector>

#include "core/error.hpp"
#include "core/format.hpp"
#include "expr/expression.hpp"
#include "model/srdf.hpp"

namespace chainreel {
namespace {

namespace fs = std::filesystem;

// Of this robot, in an order that does not depend on the file system.
std::vector<SrdfFile> srdfs_of(const Chain& chain, const fs::path& model) {
  std::error_code code;
  const fs::path folder = fs::absolute(model, code).parent_path();
  std::vector<fs::path> paths;
  for (const fs::path& place : {folder, folder.parent_path() / "srdf"})
    for (fs::directory_iterator entry(place, code), end; !code && entry != end; entry.increment(code))
      if (entry->path().extension() == ".srdf") paths.push_back(entry->path());
  std::sort(paths.begin(), paths.end());
  std::vector<SrdfFile> files;
  for (const fs::path& path : paths)
    if (SrdfFile file = read_srdf(path.string()); file.robot == chain.name) files.push_back(std::move(file));
  return files;
}

bool follows(const Chain& chain, const std::string& joint) {
  return std::any_of(chain.bodies.begin() + 1, chain.bodies.end(), [&](const Body& body) { return body.joint.name == joint; });
}

std::string text_of(const Chain& chain, const SrdfState& state, const std::string& where) {
  const std::vector<std::string> names = position_names(chain);
  std::string text;
  for (const SrdfValue& value : state.joints) {
    const bool is_there = std::find(names.begin(), names.end(), value.joint) != names.end();
    if (!is_there && follows(chain, value.joint)) continue;  // its leader says where it is
    if (!is_there || value.values.size() != 1)
      throw Error(ExitCode::usage, where + ": the state '" + state.name + "' gives " + std::to_string(value.values.size()) + " numbers to '" +
                                       value.joint + "', which is no joint of one freedom of " + chain.name);
    text += (text.empty() ? "" : ",") + value.joint + "=" + format_shortest(value.values.front());
  }
  return text;
}

}  // namespace

std::string named_pose_text(const Chain& chain, const std::string& model, const std::string& text, const std::string& what) {
  const bool is_name = is_variable_name(text) && text != "pi";
  if (!is_name || model.empty()) return text;
  std::vector<std::string> known;
  std::string where;
  for (const SrdfFile& file : srdfs_of(chain, model)) {
    where = file.path;
    for (const SrdfState& state : file.states) {
      if (state.name == text) return text_of(chain, state, file.path);
      known.push_back(state.name);
    }
  }
  if (known.empty()) return text;
  throw Error(ExitCode::usage, what + " " + text + ": " + where + " has no state of this name:" + did_you_mean(text, known) + " It has " + joined(known));
}

}  // namespace chainreel
