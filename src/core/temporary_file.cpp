#include "core/temporary_file.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/random.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <map>
#include <mutex>
#include <set>

#include "core/error.hpp"

namespace chainreel {
namespace fs = std::filesystem;
namespace {

constexpr const char* kPrefix = ".chainreel-";
constexpr const char* kComing = ".tmp";
constexpr const char* kFormer = ".old";
constexpr int kTries = 100;  // of names that nobody has

std::string random_name() {
  std::uint64_t number = 0;
  if (getrandom(&number, sizeof number, 0) != sizeof number) number = std::uint64_t(getpid());
  constexpr char kSigns[] = "0123456789abcdefghijklmnopqrstuv";
  std::string name;
  for (int i = 0; i < 12; ++i, number >>= 5) name += kSigns[number & 31];
  return name;
}

bool is_same_file(int file, const std::string& path) {
  struct stat open = {}, named = {};
  return fstat(file, &open) == 0 && lstat(path.c_str(), &named) == 0 && open.st_dev == named.st_dev &&
         open.st_ino == named.st_ino;
}

struct FinalNames {
  std::mutex mutex;
  std::map<std::string, std::string> names;  // temporary to final
};

FinalNames& final_names() {
  static FinalNames all;
  return all;
}

class OpenFile {
 public:
  explicit OpenFile(int file) : file_(file) {}
  ~OpenFile() {
    if (file_ >= 0) close(file_);
  }
  OpenFile(const OpenFile&) = delete;
  OpenFile& operator=(const OpenFile&) = delete;
  int number() const { return file_; }

 private:
  int file_;
};

// Moves back what is in the folder, then takes the folder away if nothing is left in it.
void bring_back(const fs::path& former) {
  std::error_code code;
  for (const fs::directory_entry& entry : fs::directory_iterator(former, code)) {
    std::error_code ignored;
    fs::rename(entry.path(), former.parent_path() / entry.path().filename(), ignored);
  }
  fs::remove(former, code);
}

void tidy_up(const fs::path& path) {
  const std::string name = path.filename().string();
  const std::string mark = path.stem().extension() == kComing ? kComing : path.extension().string();
  if (!name.starts_with(kPrefix) || (mark != kComing && mark != kFormer)) return;
  const OpenFile file(open(path.c_str(), O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC));
  struct stat facts = {};
  if (file.number() < 0 || fstat(file.number(), &facts) != 0 || facts.st_uid != geteuid()) return;
  // Who makes such a file holds its lock until his end.
  if (flock(file.number(), LOCK_EX | LOCK_NB) != 0 || !is_same_file(file.number(), path.string())) return;
  std::error_code ignored;
  if (mark == kFormer && S_ISDIR(facts.st_mode))
    bring_back(path);
  else if (mark == kComing)
    fs::remove_all(path, ignored);
}

}  // namespace

TemporaryFile::TemporaryFile(Kind kind, const std::string& folder, const std::string& ending, const std::string& target,
                             const std::string& remedy)
    : kind_(kind), target_(target) {
  errno = 0;
  for (int i = 0; i < kTries && file_ < 0; ++i) {
    path_ = (fs::path(folder) /
             (kPrefix + random_name() + (kind == Kind::former_folder ? kFormer : kComing) + ending))
                .string();
    // Before the file is there: where memory is short, nothing must fail behind that.
    {
      const std::lock_guard lock(final_names().mutex);
      final_names().names[path_] = target;
    }
    if (kind == Kind::coming_file)
      file_ = open(path_.c_str(), O_RDWR | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0666);
    else if (mkdir(path_.c_str(), 0777) == 0)
      file_ = open(path_.c_str(), O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC);
    if (file_ < 0 && errno != EEXIST) break;
    if (file_ >= 0) lock_new();
  }
  if (file_ < 0)
    throw Error(ExitCode::file, std::string("cannot be written (") + std::strerror(errno) + "); " + remedy, {target});
}

// Between its making and its lock another process may have taken it for a leftover: then the next name is tried. Where
// the file system knows no locks, nobody removes leftovers either.
void TemporaryFile::lock_new() {
  if (flock(file_, LOCK_EX | LOCK_NB) == 0 && is_same_file(file_, path_)) return;
  if (errno == ENOSYS || errno == EOPNOTSUPP || errno == ENOLCK || errno == EINVAL) return;
  close(file_);
  file_ = -1;
  errno = EEXIST;
}

TemporaryFile::~TemporaryFile() {
  if (file_ >= 0) close(file_);
  if (path_.empty()) return;
  std::error_code ignored;
  if (kind_ == Kind::coming_file)
    fs::remove(path_, ignored);  // to remove all of a folder takes a free file number
  else
    fs::remove_all(path_, ignored);
}

void TemporaryFile::let_go() {
  {
    const std::lock_guard lock(final_names().mutex);
    final_names().names.erase(path_);
  }
  path_.clear();
  if (file_ >= 0) close(file_);
  file_ = -1;
}

void TemporaryFile::sync() const {
  if (!is_same_file(file_, path_))
    throw Error(ExitCode::file, "was not written: somebody took its temporary file " + path_ + " away", {target_});
  if (fsync(file_) != 0 && errno != EINVAL && errno != ENOTSUP && errno != EROFS)
    throw Error(ExitCode::file, std::string("could not be written whole (") + std::strerror(errno) + ")", {target_});
}

void sync_folder(const std::string& folder, const std::string& target) {
  const OpenFile file(open(folder.empty() ? "." : folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  if (file.number() < 0) return;  // a folder may be written to and not be read
  if (fsync(file.number()) != 0 && errno != EINVAL && errno != ENOTSUP && errno != EROFS)
    throw Error(ExitCode::file, std::string("is written, but the disk did not take its name (") + std::strerror(errno) + ")",
                {target});
}

void remove_leftovers(const std::string& folder) {
  static std::mutex mutex;
  static std::set<std::string> seen;
  std::error_code code;
  const std::lock_guard lock(mutex);
  if (!seen.insert(fs::weakly_canonical(folder, code).string()).second) return;
  std::vector<fs::path> found;  // first all names: what comes back changes the folder
  for (fs::directory_iterator entry(folder, code), end; !code && entry != end; entry.increment(code))
    if (entry->path().filename().string().starts_with(kPrefix)) found.push_back(entry->path());
  for (const fs::path& path : found) tidy_up(path);
}

void remove_unfinished() noexcept {
  FinalNames& all = final_names();
  const std::unique_lock lock(all.mutex, std::try_to_lock);
  if (!lock.owns_lock()) return;  // by this very thread, maybe; the next run finds them
  for (const auto& [temporary, target] : all.names) {
    const fs::path path(temporary);
    if (path.extension() == kFormer) continue;
    std::error_code ignored;
    fs::remove_all(path, ignored);
  }
}

std::string with_final_names(std::string text) {
  const std::lock_guard lock(final_names().mutex);
  for (const auto& [temporary, target] : final_names().names)
    for (std::size_t at = 0; (at = text.find(temporary, at)) != std::string::npos; at += target.size())
      text.replace(at, temporary.size(), target);
  return text;
}

}  // namespace chainreel
