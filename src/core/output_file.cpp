#include "core/output_file.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <set>
#include <utility>

#include "core/error.hpp"
#include "core/input_file.hpp"

namespace chainreel {
namespace fs = std::filesystem;
namespace {

bool lies_below_out(const fs::path& path) {
  std::error_code ignored;
  for (const fs::path& part : fs::weakly_canonical(path, ignored).parent_path())
    if (part == "out") return true;
  return false;
}

fs::path folder_of(const fs::path& path) {
  return path.has_parent_path() ? path.parent_path() : fs::path(".");
}

// Renaming over a link would replace the link and leave the file, be that there already or not.
std::string behind_links(const std::string& path) {
  constexpr int kMostLinks = 40;  // as the kernel has it; a ring of links is refused where it is opened
  std::error_code code;
  fs::path file(path);
  for (int k = 0; k < kMostLinks && fs::is_symlink(file, code); ++k) file = file.parent_path() / fs::read_symlink(file, code);
  return file.string();
}

const char* kind_of(mode_t mode) {
  if (S_ISDIR(mode)) return "is a folder: name a file inside it";
  if (S_ISCHR(mode) || S_ISBLK(mode)) return "is a device, no file: name a file";
  if (S_ISFIFO(mode)) return "is a pipe, no file: name a file";
  return "is a socket, no file: name a file";
}

[[noreturn]] void is_there(const std::string& path) {
  throw Error(ExitCode::file, "exists already: give --force to overwrite it, or another name", {path});
}

}  // namespace

void require_replaceable(const std::string& path) {
  struct stat facts = {};
  if (stat(path.c_str(), &facts) != 0) {
    if (errno == ENOENT || errno == ENOTDIR) return;  // nothing there
    throw Error(ExitCode::file, std::string("cannot be written (") + std::strerror(errno) + ")", {path});
  }
  if (!S_ISREG(facts.st_mode)) throw Error(ExitCode::file, kind_of(facts.st_mode), {path});
  if (const std::string input = noted_input(path); !input.empty())
    throw Error(ExitCode::file,
                "is read by this very command" + (input == path ? "" : " (as " + input + ")") +
                    ": an output never replaces an input; name another file",
                {path});
}

void refuse_dash(const std::string& path) {
  if (path == "-" || path.starts_with("-/"))
    throw Error(ExitCode::usage, "-o " + path + ": this goes into a file, not to standard output: name one, like -o out/result");
  if (path.empty()) throw Error(ExitCode::usage, "-o names no file");
}

void refuse_twice(const std::vector<std::string>& paths) {
  std::set<std::string> seen;
  for (const std::string& path : paths)
    if (!seen.insert(fs::path(path).lexically_normal().string()).second)
      throw Error(ExitCode::usage, "-o " + path + " is named twice");
}

OutputFile::OutputFile(std::string path, bool overwrite) : path_(std::move(path)), target_(behind_links(path_)) {
  refuse_dash(path_);
  require_replaceable(path_);
  replace_ = overwrite || lies_below_out(target_);
  std::error_code code;
  if (!replace_ && fs::exists(target_, code)) is_there(path_);
  const fs::path folder = folder_of(target_);
  // A folder that is named is made; where a link points is somebody else's.
  if (target_ != path_ && !fs::is_directory(folder, code))
    throw Error(ExitCode::file, "is a link to " + target_ + ", whose folder is not there: make it, or name another file", {path_});
  fs::create_directories(folder, code);
  if (!fs::is_directory(folder, code))
    throw Error(ExitCode::file, "cannot make this folder; choose another", {folder.string()});
  remove_leftovers(folder.string());
  temporary_ = std::make_unique<TemporaryFile>(TemporaryFile::Kind::coming_file, folder.string(),
                                               fs::path(target_).extension().string(), path_);
}

void OutputFile::rename_to(const std::string& target, bool replace) {
  require_replaceable(target);  // much may have happened since the start
  temporary_->sync();
  const std::string& from = temporary_path();
  int result = 0;
  if (replace) {
    result = std::rename(from.c_str(), target.c_str());
  } else {
    result = renameat2(AT_FDCWD, from.c_str(), AT_FDCWD, target.c_str(), RENAME_NOREPLACE);
    if (result != 0 && (errno == EINVAL || errno == ENOSYS)) {  // not known to this file system
      std::error_code ignored;
      if (fs::exists(target, ignored)) is_there(target);
      result = std::rename(from.c_str(), target.c_str());
    }
  }
  if (result != 0 && errno == EEXIST) is_there(target);
  if (result != 0)
    throw Error(ExitCode::file, std::string("cannot be given its name: ") + std::strerror(errno), {target});
  temporary_->let_go();
  sync_folder(folder_of(target).string(), target);
}

void OutputFile::commit() {
  rename_to(target_, replace_);
}

std::string OutputFile::keep_as_partial() {
  const fs::path path(target_);
  const std::string partial = (path.parent_path() / (path.stem().string() + ".partial" + path.extension().string())).string();
  rename_to(partial, true);
  return partial;
}

void write_temporary(const OutputFile& output, std::string_view text) {
  std::ofstream stream(output.temporary_path(), std::ios::binary);
  stream.write(text.data(), static_cast<std::streamsize>(text.size()));
  stream.close();
  if (!stream) throw Error(ExitCode::file, "could not be written whole: is the disk full?", {output.path()});
}

void write_whole(OutputFile& output, std::string_view text) {
  write_temporary(output, text);
  output.commit();
}

void write_text_file(const std::string& path, std::string_view text, bool overwrite) {
  OutputFile output(path, overwrite);
  write_whole(output, text);
}

namespace {

// Renames that are undone, the last first, unless all of them succeeded.
class Moves {
 public:
  void move(const fs::path& from, const fs::path& to) {
    done_.emplace_back(from, to);  // takes memory: before anything has moved
    if (std::rename(from.c_str(), to.c_str()) == 0) return;
    const int reason = errno;
    done_.pop_back();
    throw Error(ExitCode::file, std::string("cannot be given its name: ") + std::strerror(reason), {to.string()});
  }

  // False where something could not be brought back. Takes no memory.
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

OutputFolder::OutputFolder(std::string folder, std::string stem, std::string ending, bool overwrite, bool is_part)
    : folder_(std::move(folder)), stem_(std::move(stem)), ending_(std::move(ending)), overwrite_(overwrite) {
  if (folder_.empty()) folder_ = ".";
  refuse_dash(folder_ + "/");
  std::error_code code;
  fs::create_directories(folder_, code);
  if (!fs::is_directory(folder_, code))
    throw Error(ExitCode::file, "cannot make this folder; choose another", {folder_});
  remove_leftovers(folder_);
  if (!is_part) require_ours_replaceable();
  temporary_ = std::make_unique<TemporaryFile>(TemporaryFile::Kind::coming_folder, folder_, "", folder_);
}

void OutputFolder::require_ours_replaceable() const {
  const std::vector<std::string> old = names_of_ours();
  for (const std::string& name : old) require_replaceable((fs::path(folder_) / name).string());
  if (!old.empty())
    const OutputFile allowed((fs::path(folder_) / old.front()).string(), overwrite_);  // throws where it is not
}

void OutputFolder::keep_to(int first, int behind) {
  first_ = first;
  behind_ = behind;
  require_ours_replaceable();
}

std::vector<std::string> OutputFolder::leave_from(long number) {
  std::vector<std::string> all = names_of_ours();
  behind_ = std::min(behind_, number);
  std::erase_if(all, [this](const std::string& name) { return is_ours(name); });
  return all;
}

bool OutputFolder::is_ours(const std::string& name) const {
  if (!name.starts_with(stem_) || !name.ends_with(ending_)) return false;
  if (name.size() < stem_.size() + 6 + ending_.size()) return false;
  const std::string digits = name.substr(stem_.size(), name.size() - stem_.size() - ending_.size());
  if (!std::all_of(digits.begin(), digits.end(), [](unsigned char c) { return std::isdigit(c) != 0; })) return false;
  const double number = std::strtod(digits.c_str(), nullptr);  // of any length
  return number >= double(first_) && number < double(behind_);
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
  } catch (...) {  // no memory
    if (!moves.undo()) former.let_go();
    throw;
  }
  sync_folder(folder_, folder_);
}

}  // namespace chainreel
