#include "app/works/growing_table.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <span>
#include <sstream>
#include <utility>

#include "core/error.hpp"
#include "core/hash.hpp"
#include "core/input_file.hpp"
#include "core/output_file.hpp"

namespace chainreel {
namespace fs = std::filesystem;
namespace {

struct Found {
  bool has_head = false;
  std::size_t rows = 0, bytes = 0;  // of the head and whole rows
};

const std::string kSoFar = "# so far: ";  // in the hidden file, behind each piece: the hash of the one before it and of its rows

std::string so_far(const std::string& before, const std::string& rows) {
  return sha256_of(before + rows);
}

// Whether a file begins with the head.
bool begins_with(std::ifstream& stream, const std::string& head) {
  std::string text(head.size(), '\0');
  stream.read(text.data(), std::streamsize(text.size()));
  return stream && text == head;
}

// Rows begin with their numbers: behind one that does not, none is.
Found look_at(const std::string& path, const std::string& head, std::size_t first) {
  Found found;
  std::error_code code;
  if (!fs::is_regular_file(path, code)) return found;
  std::ifstream stream(path, std::ios::binary);
  if (!begins_with(stream, head)) return found;
  found = {true, 0, head.size()};
  for (std::string line; std::getline(stream, line) && !stream.eof();) {  // a line without its end is half a row
    if (!line.starts_with(std::to_string(first + found.rows) + ",")) break;
    ++found.rows;
    found.bytes += line.size() + 1;
  }
  return found;
}

// Of the hidden file: up to the last piece whose rows are those that were written, whatever a disk that lost power or somebody else did.
struct Kept : Found {
  std::string hash;  // of the last piece
};
Kept look_at_kept(const std::string& path, const std::string& head, std::size_t first) {
  Kept kept;
  std::error_code code;
  if (!fs::is_regular_file(path, code)) return kept;
  std::ifstream stream(path, std::ios::binary);
  if (!begins_with(stream, head)) return kept;
  kept.has_head = true;
  kept.bytes = head.size();
  std::string piece;
  std::size_t rows = 0, bytes = 0;  // of the piece
  for (std::string line; std::getline(stream, line) && !stream.eof();) {
    bytes += line.size() + 1;
    if (!line.starts_with(kSoFar)) {
      if (!line.starts_with(std::to_string(first + kept.rows + rows) + ",")) break;
      piece += line + "\n";
      ++rows;
      continue;
    }
    const std::string hash = so_far(kept.hash, piece);
    if (line != kSoFar + hash) break;
    kept.hash = hash;
    kept.rows += std::exchange(rows, 0);
    kept.bytes += std::exchange(bytes, 0);
    piece.clear();
  }
  return kept;
}

// Of any sweep, maybe of another one.
bool is_table_like(const std::string& path, const std::string& head) {
  std::string text(head.find(':') + 1, '\0');
  std::ifstream stream(path, std::ios::binary);
  stream.read(text.data(), std::streamsize(text.size()));
  text.resize(std::size_t(stream.gcount()));  // its begin may be all that was written
  return head.starts_with(text);
}

// Whether the last line is the hash of those above it.
bool has_hash_of_rows(const std::string& path) {
  std::ifstream stream(path, std::ios::binary);
  Sha256 hash;
  for (std::string line; std::getline(stream, line) && !stream.eof();) {
    if (line.starts_with(kHashOfRows))
      return line == kHashOfRows + hash.finish() && stream.peek() == std::ifstream::traits_type::eof();
    line += '\n';
    hash.add(std::as_bytes(std::span(line)));
  }
  return false;
}

[[noreturn]] void refuse_changed(const std::string& path) {
  throw Error(ExitCode::bad_input, "has been changed or cut off since it was written: compute it again, with --force", {path});
}

// A table that was changed is refused, or computed anew over it.
bool is_whole(const std::string& path, bool overwrite) {
  const bool has_hash = has_hash_of_rows(path);
  if (!has_hash && !overwrite) refuse_changed(path);
  return has_hash;
}

}  // namespace

GrowingTable::GrowingTable(const std::string& path, const std::string& head, std::size_t first, std::size_t rows, bool overwrite)
    : path_(path), hidden_((fs::path(path).parent_path() / ("." + fs::path(path).filename().string() + ".rows")).string()),
      head_size_(head.size()), overwrite_(overwrite) {
  if (const Found whole = look_at(path, head, first); whole.has_head && whole.rows == rows && is_whole(path, overwrite)) {
    finished_ = true;
    before_ = whole.rows;
    // As a process leaves it that was killed between the two.
    if (std::error_code code; look_at_kept(hidden_, head, first).has_head) fs::remove(hidden_, code);
    return;
  }
  { const OutputFile allowed(path, overwrite); }  // throws where it is not, before anything is computed
  file_ = open(hidden_.c_str(), O_RDWR | O_CREAT | O_NOFOLLOW | O_CLOEXEC, 0666);
  if (file_ < 0) throw Error(ExitCode::file, std::string("cannot be written (") + std::strerror(errno) + ")", {path});
  if (flock(file_, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK) {
    close(file_);
    throw Error(ExitCode::file, "is being computed by another process", {path});
  }
  struct stat open_one = {}, named = {};
  if (fstat(file_, &open_one) != 0 || lstat(hidden_.c_str(), &named) != 0 || open_one.st_ino != named.st_ino) {
    close(file_);
    throw Error(ExitCode::file, "was finished by another process at this moment: run the command again", {path});
  }
  if (named.st_size > 0 && !is_table_like(hidden_, head)) {
    close(file_);
    throw Error(ExitCode::file, "lies where rows are kept, and this program did not write it: move it away", {hidden_});
  }
  Kept found = look_at_kept(hidden_, head, first);
  if (found.rows > rows) found = {};  // nobody's
  before_ = found.rows;
  hash_ = found.hash;
  if (ftruncate(file_, off_t(found.bytes)) != 0 || lseek(file_, 0, SEEK_END) < 0) {
    const std::string reason = std::strerror(errno);
    close(file_);
    throw Error(ExitCode::file, "cannot be written (" + reason + ")", {path});
  }
  if (!found.has_head) append(head);
}

GrowingTable::~GrowingTable() {
  if (file_ >= 0) close(file_);
}

void GrowingTable::for_each_before(const std::function<void(const std::string& row)>& look) const {
  std::ifstream stream(finished_ ? path_ : hidden_, std::ios::binary);
  stream.seekg(std::streamoff(head_size_));
  std::string line;
  for (std::size_t k = 0; k < before_ && std::getline(stream, line);) {
    if (line.starts_with(kSoFar)) continue;
    look(line);
    ++k;
  }
}

void GrowingTable::take(std::size_t piece, std::string lines) {
  const std::lock_guard guard(lock_);
  waiting_.emplace(piece, std::move(lines));
  for (; !waiting_.empty() && waiting_.begin()->first == next_; ++next_, waiting_.erase(waiting_.begin())) {
    const std::string& rows = waiting_.begin()->second;
    hash_ = so_far(hash_, rows);
    append(rows + kSoFar + hash_ + "\n");
  }
}

void GrowingTable::append(const std::string& text) {
  for (std::size_t done = 0; done < text.size();) {
    const ssize_t count = write(file_, text.data() + done, text.size() - done);
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0)
      throw Error(ExitCode::file, std::string("could not be written whole (") + std::strerror(count < 0 ? errno : EIO) + ")",
                  {path_});
    done += std::size_t(count);
  }
}

std::string line_of_hash(const std::string& path) {
  std::ifstream rows(path, std::ios::binary);
  return kHashOfRows + hash_of_stream(rows, path).sha256 + "\n";
}

void require_hash_of_rows(const std::string& path) {
  if (!has_hash_of_rows(path)) refuse_changed(path);
}

void GrowingTable::write_table(std::ostream& table) const {
  std::ifstream stream(hidden_, std::ios::binary);
  Sha256 hash;
  for (std::string line; std::getline(stream, line);) {
    if (line.starts_with(kSoFar)) continue;
    line += '\n';
    hash.add(std::as_bytes(std::span(line)));
    table << line;
  }
  table << kHashOfRows << hash.finish() << '\n';
}

void GrowingTable::commit(const std::function<std::string(const std::string& csv)>& file_of) {
  OutputFile output(path_, overwrite_);
  if (file_of) {
    std::ostringstream table;
    write_table(table);
    write_whole(output, file_of(table.str()));
  } else {  // row by row, since a million need not fit into memory
    std::ofstream table(output.temporary_path(), std::ios::binary | std::ios::trunc);
    write_table(table);
    if (!table.flush()) throw Error(ExitCode::file, std::string("could not be written whole (") + std::strerror(errno) + ")", {path_});
    output.commit();
  }
  std::error_code code;
  fs::remove(hidden_, code);
}

}  // namespace chainreel
