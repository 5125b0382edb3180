#include "core/output_file.hpp"

#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>

#include "core/error.hpp"

namespace chainreel {
namespace fs = std::filesystem;
namespace {

bool lies_below_out(const fs::path& path) {
  std::error_code ignored;
  for (const fs::path& part : fs::weakly_canonical(path, ignored).parent_path())
    if (part == "out") return true;
  return false;
}

// The ending stays last, so that writers which go by it (muxers) see the right one.
fs::path with_mark(const fs::path& path, const std::string& mark) {
  return path.parent_path() / (path.stem().string() + mark + path.extension().string());
}

}  // namespace

OutputFile::OutputFile(std::string path, bool overwrite) : path_(std::move(path)) {
  const fs::path target(path_);
  std::error_code code;
  if (fs::is_directory(target, code))
    throw Error(ExitCode::file, "is a folder: name a file inside it", {path_});
  if (fs::exists(target, code) && !overwrite && !lies_below_out(target))
    throw Error(ExitCode::file, "exists already: give --force to overwrite it, or another name with -o",
                {path_});
  const fs::path folder = target.has_parent_path() ? target.parent_path() : fs::path(".");
  fs::create_directories(folder, code);
  if (!fs::is_directory(folder))
    throw Error(ExitCode::file, "cannot make this folder; choose another with -o", {folder.string()});
  temporary_path_ = with_mark(target, "." + std::to_string(getpid()) + ".tmp").string();
  std::ofstream probe(temporary_path_, std::ios::binary);
  if (!probe) {
    throw Error(ExitCode::file,
                std::string("cannot be written (") + std::strerror(errno) + "); choose another place with -o",
                {path_});
  }
}

OutputFile::~OutputFile() {
  std::error_code ignored;
  if (!done_) fs::remove(temporary_path_, ignored);
}

void OutputFile::rename_to(const std::string& target) {
  std::error_code code;
  fs::rename(temporary_path_, target, code);
  if (code)
    throw Error(ExitCode::file, "cannot be renamed from " + temporary_path_ + ": " + code.message(),
                {target});
  done_ = true;
}

void OutputFile::commit() {
  rename_to(path_);
}

void OutputFile::keep_as_partial() {
  rename_to(with_mark(path_, ".partial").string());
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
