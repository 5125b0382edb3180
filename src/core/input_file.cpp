#include "core/input_file.hpp"

#include <sys/stat.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <map>
#include <mutex>
#include <optional>
#include <utility>

#include "core/error.hpp"

namespace chainreel {
namespace {

using FileId = std::pair<dev_t, ino_t>;

struct Inputs {
  std::mutex mutex;
  std::map<FileId, std::string> names;
};

Inputs& inputs() {
  static Inputs all;
  return all;
}

}  // namespace

void require_plain_file(const std::string& path, std::uintmax_t largest) {
  struct stat facts = {};
  if (stat(path.c_str(), &facts) != 0) {
    const bool missing = errno == ENOENT || errno == ENOTDIR;
    throw Error(ExitCode::bad_input,
                missing ? "there is no such file" : std::string("cannot be read: ") + std::strerror(errno), {path});
  }
  if (!S_ISREG(facts.st_mode)) throw Error(ExitCode::bad_input, "is not a file", {path});
  if (std::uintmax_t(facts.st_size) > largest)
    throw Error(ExitCode::limit, "is larger than " + std::to_string(largest >> 20) + " MiB", {path});
}

std::string read_plain_file(const std::string& path, std::uintmax_t largest) {
  require_plain_file(path, largest);
  errno = 0;
  std::ifstream stream(path, std::ios::binary);
  std::string bytes;
  if (stream) bytes.assign(std::istreambuf_iterator<char>(stream), {});
  if (!stream || stream.bad())
    throw Error(ExitCode::bad_input,
                std::string("cannot be read") + (errno != 0 ? std::string(": ") + std::strerror(errno) : ""), {path});
  return bytes;
}

namespace {

std::optional<std::string>& held_text() {
  static std::optional<std::string> text;
  return text;
}

}  // namespace

void hold_standard_input(std::string text) {
  held_text() = std::move(text);
}

const std::string* standard_input_at(const std::string& path) {
  return held_text() && path == kStandardInput ? &*held_text() : nullptr;
}

void note_input(const std::string& path) {
  struct stat facts = {};
  if (stat(path.c_str(), &facts) != 0) return;
  const std::lock_guard lock(inputs().mutex);
  inputs().names[{facts.st_dev, facts.st_ino}] = path;
}

std::string noted_input(const std::string& path) {
  struct stat facts = {};
  if (stat(path.c_str(), &facts) != 0) return "";
  const std::lock_guard lock(inputs().mutex);
  const auto found = inputs().names.find({facts.st_dev, facts.st_ino});
  if (found == inputs().names.end()) return "";
  // Another file may have the number of an input that is gone.
  struct stat input = {};
  const bool is_there = stat(found->second.c_str(), &input) == 0;
  return is_there && input.st_dev == facts.st_dev && input.st_ino == facts.st_ino ? found->second : "";
}

std::vector<std::string> noted_inputs() {
  const std::lock_guard lock(inputs().mutex);
  std::vector<std::string> names;
  for (const auto& [id, name] : inputs().names) names.push_back(name);
  std::sort(names.begin(), names.end());
  return names;
}

}  // namespace chainreel
