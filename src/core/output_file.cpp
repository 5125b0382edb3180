#include "core/output_file.hpp"

#include <fcntl.h>
#include <sys/stat.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>

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

// Renaming over a link would replace the link and leave the file.
std::string behind_links(const std::string& path) {
  std::error_code code;
  const fs::path file = fs::canonical(path, code);
  return code ? path : fs::is_symlink(path, code) ? file.string() : path;
}

const char* kind_of(mode_t mode) {
  if (S_ISDIR(mode)) return "is a folder: name a file inside it";
  if (S_ISCHR(mode) || S_ISBLK(mode)) return "is a device, no file: name a file with -o";
  if (S_ISFIFO(mode)) return "is a pipe, no file: name a file with -o";
  return "is a socket, no file: name a file with -o";
}

[[noreturn]] void is_there(const std::string& path) {
  throw Error(ExitCode::file, "exists already: give --force to overwrite it, or another name with -o", {path});
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
                    ": an output never replaces an input; name another file with -o",
                {path});
}

OutputFile::OutputFile(std::string path, bool overwrite) : path_(std::move(path)), target_(behind_links(path_)) {
  require_replaceable(path_);
  replace_ = overwrite || lies_below_out(target_);
  std::error_code code;
  if (!replace_ && fs::exists(target_, code)) is_there(path_);
  const fs::path folder = folder_of(target_);
  fs::create_directories(folder, code);
  if (!fs::is_directory(folder, code))
    throw Error(ExitCode::file, "cannot make this folder; choose another with -o", {folder.string()});
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

void OutputFile::keep_as_partial() {
  const fs::path path(target_);
  rename_to((path.parent_path() / (path.stem().string() + ".partial" + path.extension().string())).string(), true);
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

void write_partial(OutputFile& output, std::string_view text) {
  write_temporary(output, text);
  output.keep_as_partial();
}

void write_text_file(const std::string& path, std::string_view text, bool overwrite) {
  OutputFile output(path, overwrite);
  write_whole(output, text);
}

}  // namespace chainreel
