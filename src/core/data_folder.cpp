#include "core/data_folder.hpp"

#include <dlfcn.h>
#include <sys/auxv.h>

#include <algorithm>
#include <filesystem>

#include "core/error.hpp"

namespace chainreel {
namespace {

namespace fs = std::filesystem;

bool is_file(const fs::path& path) {
  std::error_code ignored;
  return fs::is_regular_file(path, ignored);
}

// The file that holds this code, where it is a library that another program has loaded.
fs::path library_file() {
  Dl_info info = {};
  const bool is_known = dladdr(reinterpret_cast<const void*>(&data_folder), &info) != 0 && info.dli_fname != nullptr;
  return is_known && info.dli_fname[0] == '/' ? fs::path(info.dli_fname) : fs::path();
}

}  // namespace

fs::path program_file() {
  std::error_code code;
  const fs::path link = fs::read_symlink("/proc/self/exe", code);
  if (!code) return link;
  const auto called = reinterpret_cast<const char*>(getauxval(AT_EXECFN));
  return called == nullptr ? fs::path() : fs::canonical(called, code);
}

std::string data_folder() {
  std::error_code code;
  // Of an installed program, of one in its build tree, of what is installed in libexec/chainreel, or built as a library, and
  // of what is installed in lib/python3/dist-packages/chainreel.
  for (const fs::path& file : {library_file(), program_file()})
    for (const char* way : {"../share", "share", "../../share", "../../../../share"}) {
      if (file.empty()) continue;
      const fs::path share = (file.parent_path() / way).lexically_normal();
      const fs::path folder = share / "chainreel";
      if (fs::is_directory(folder / "assets/scenes", code)) return folder.string();
    }
  return "";
}

namespace {

std::vector<std::string> names_in(const char* folder, const char* ending, bool with_ending) {
  std::vector<std::string> names;
  std::error_code code;
  for (fs::directory_iterator entry(fs::path(data_folder()) / folder, code), end; !code && entry != end; entry.increment(code))
    if (entry->path().extension() == ending)
      names.push_back(with_ending ? entry->path().filename().string() : entry->path().stem().string());
  std::sort(names.begin(), names.end());
  return names;
}

// Of scenes and models, as they may be given.
std::vector<std::string> shipped_names() {
  std::vector<std::string> names = shipped_scenes();
  for (std::string& model : names_in("models", ".urdf", true)) names.push_back(std::move(model));
  return names;
}

}  // namespace

std::vector<std::string> shipped_scenes() {
  return names_in("assets/scenes", ".yaml", false);
}

std::string shipped_file(const std::string& name) {
  const std::string folder = data_folder();
  if (folder.empty() || name.empty() || name.find('/') != std::string::npos || name.front() == '.') return "";
  const fs::path scene = fs::path(folder) / "assets/scenes" / name, model = fs::path(folder) / "models" / name;
  for (const fs::path& path : {scene, fs::path(scene.string() + ".yaml"), model})
    if (is_file(path)) return path.string();
  return "";
}

namespace {

constexpr const char* kInputFolders[] = {"models", "assets/styles"};

}  // namespace

std::string shipped_input(const std::string& name) {
  if (name.empty() || name.find('/') != std::string::npos || name.front() == '.') return "";
  const std::string folder = data_folder();
  for (const char* inner : kInputFolders)
    if (const fs::path path = fs::path(folder) / inner / name; !folder.empty() && is_file(path)) return path.string();
  return "";
}

std::string name_of_shipped(const std::string& path) {
  if (path.find('/') == std::string::npos) return "";
  const std::string name = fs::path(path).filename().string();
  std::string shipped = shipped_input(name);
  if (shipped.empty()) shipped = shipped_file(name);
  return !shipped.empty() && fs::path(path).lexically_normal() == fs::path(shipped).lexically_normal() ? name : "";
}

std::string near_shipped_models(const std::string& name) {
  const std::vector<std::string> names = names_in("models", ".urdf", true);
  const std::string near = did_you_mean(name, names);
  if (!near.empty() || names.empty()) return near;
  std::string all;
  for (const std::string& one : names) all += (all.empty() ? " They are " : ", ") + one;
  return all;
}

std::string found_file(const std::string& named, const std::string& ending) {
  std::error_code ignored;
  if (fs::exists(named, ignored)) return named;
  for (const std::string& name : {named, named + ending})
    if (const std::string shipped = shipped_file(name); !shipped.empty()) return shipped;
  const bool is_word = named.find('/') == std::string::npos;
  if (const std::string near = is_word ? did_you_mean(named, shipped_names()) : ""; !near.empty())
    throw Error(ExitCode::bad_input, "there is no such file here, and none of that name comes with the program:" + near, {named});
  return named;
}

std::string found_elsewhere(const std::string& named, const std::string& found) {
  if (named == found || fs::path(named).extension().empty()) return "";
  return not_there(named, "here", found);
}

std::string not_there(const std::string& named, const std::string& where, const std::string& found) {
  return "there is no file " + named + " " + where + ": the program's own is taken, " + found;
}

}  // namespace chainreel
