#include "core/output_folder.hpp"

#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <utility>
#include <vector>

#include "core/error.hpp"
#include "core/output_file.hpp"

namespace chainreel {
namespace fs = std::filesystem;

OutputFolder::OutputFolder(std::string folder, std::string stem, std::string ending, bool overwrite)
    : folder_(std::move(folder)), stem_(std::move(stem)), ending_(std::move(ending)) {
  if (folder_.empty()) folder_ = ".";
  std::error_code code;
  fs::create_directories(folder_, code);
  if (!fs::is_directory(folder_))
    throw Error(ExitCode::file, "cannot make this folder; choose another with -o", {folder_});
  for (const fs::directory_entry& entry : fs::directory_iterator(folder_)) {
    if (!is_ours(entry.path().filename().string())) continue;
    const OutputFile allowed(entry.path().string(), overwrite);  // throws where it may not be overwritten
    break;
  }
  temporary_ = (fs::path(folder_) / ("." + stem_ + std::to_string(getpid()) + ".tmp")).string();
  fs::remove_all(temporary_, code);
  if (!fs::create_directory(temporary_, code))
    throw Error(ExitCode::file, "cannot be written (" + code.message() + "); choose another place with -o",
                {folder_});
}

OutputFolder::~OutputFolder() {
  std::error_code ignored;
  fs::remove_all(temporary_, ignored);
}

bool OutputFolder::is_ours(const std::string& name) const {
  if (!name.starts_with(stem_) || !name.ends_with(ending_)) return false;
  if (name.size() < stem_.size() + 6 + ending_.size()) return false;
  return std::all_of(name.begin() + std::ptrdiff_t(stem_.size()), name.end() - std::ptrdiff_t(ending_.size()),
                     [](unsigned char c) { return std::isdigit(c) != 0; });
}

void OutputFolder::commit() {
  std::vector<fs::path> old, fresh;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder_))
    if (is_ours(entry.path().filename().string())) old.push_back(entry.path());
  for (const fs::directory_entry& entry : fs::directory_iterator(temporary_)) fresh.push_back(entry.path());
  std::error_code code;
  for (const fs::path& path : old) fs::remove(path, code);
  for (const fs::path& path : fresh) {
    const fs::path target = fs::path(folder_) / path.filename();
    fs::rename(path, target, code);
    if (code)
      throw Error(ExitCode::file, "cannot be renamed from " + path.string() + ": " + code.message(),
                  {target.string()});
  }
}

}  // namespace chainreel
