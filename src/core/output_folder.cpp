#include "core/output_folder.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <utility>

#include "core/error.hpp"
#include "core/output_file.hpp"

namespace chainreel {
namespace fs = std::filesystem;
namespace {

// Renames that are undone, the last first, unless all of them succeeded.
class Moves {
 public:
  void move(const fs::path& from, const fs::path& to) {
    if (std::rename(from.c_str(), to.c_str()) != 0)
      throw Error(ExitCode::file, std::string("cannot be given its name: ") + std::strerror(errno), {to.string()});
    done_.emplace_back(from, to);
  }

  // False where something could not be brought back.
  bool undo() {
    bool all = true;
    for (; !done_.empty(); done_.pop_back())
      all = std::rename(done_.back().second.c_str(), done_.back().first.c_str()) == 0 && all;
    return all;
  }

 private:
  std::vector<std::pair<fs::path, fs::path>> done_;
};

void sync_file(const fs::path& path, const std::string& target) {
  const int file = open(path.c_str(), O_RDONLY | O_NOFOLLOW | O_CLOEXEC);
  const bool good = file >= 0 && fsync(file) == 0;
  const int reason = errno;
  if (file >= 0) close(file);
  if (!good && reason != EINVAL && reason != ENOTSUP)
    throw Error(ExitCode::file, std::string("could not be written whole (") + std::strerror(reason) + ")", {target});
}

}  // namespace

OutputFolder::OutputFolder(std::string folder, std::string stem, std::string ending, bool overwrite)
    : folder_(std::move(folder)), stem_(std::move(stem)), ending_(std::move(ending)) {
  if (folder_.empty()) folder_ = ".";
  std::error_code code;
  fs::create_directories(folder_, code);
  if (!fs::is_directory(folder_, code))
    throw Error(ExitCode::file, "cannot make this folder; choose another with -o", {folder_});
  remove_leftovers(folder_);
  const std::vector<std::string> old = names_of_ours();
  for (const std::string& name : old) require_replaceable((fs::path(folder_) / name).string());
  if (!old.empty())
    const OutputFile allowed((fs::path(folder_) / old.front()).string(), overwrite);  // throws where it is not
  temporary_ = std::make_unique<TemporaryFile>(TemporaryFile::Kind::coming_folder, folder_, "", folder_);
}

bool OutputFolder::is_ours(const std::string& name) const {
  if (!name.starts_with(stem_) || !name.ends_with(ending_)) return false;
  if (name.size() < stem_.size() + 6 + ending_.size()) return false;
  return std::all_of(name.begin() + std::ptrdiff_t(stem_.size()), name.end() - std::ptrdiff_t(ending_.size()),
                     [](unsigned char c) { return std::isdigit(c) != 0; });
}

std::vector<std::string> OutputFolder::names_of_ours() const {
  std::vector<std::string> names;
  std::error_code code;
  for (fs::directory_iterator entry(folder_, code), end; !code && entry != end; entry.increment(code))
    if (is_ours(entry->path().filename().string())) names.push_back(entry->path().filename().string());
  if (code) throw Error(ExitCode::file, "cannot be looked into (" + code.message() + ")", {folder_});
  std::sort(names.begin(), names.end());
  return names;
}

void OutputFolder::commit() {
  const fs::path folder(folder_), coming(temporary_->path());
  std::vector<fs::path> fresh;
  for (const fs::directory_entry& entry : fs::directory_iterator(coming)) fresh.push_back(entry.path().filename());
  std::sort(fresh.begin(), fresh.end());
  for (const fs::path& name : fresh) sync_file(coming / name, (folder / name).string());
  temporary_->sync();
  TemporaryFile former(TemporaryFile::Kind::former_folder, folder_, "", folder_);
  Moves moves;
  try {
    for (const std::string& name : names_of_ours()) {
      require_replaceable((folder / name).string());
      moves.move(folder / name, former.path() / fs::path(name));
    }
    for (const fs::path& name : fresh) moves.move(coming / name, folder / name);
  } catch (const Error& error) {
    if (moves.undo()) throw;
    const std::string place = former.path();
    former.let_go();
    Problem problem = error.problems().front();
    problem.message += "; the former pictures lie in " + place + ", and the next run in this folder brings them back";
    throw Error(ExitCode::file, std::vector<Problem>{problem});
  }
  sync_folder(folder_, folder_);
}

}  // namespace chainreel
