// A table whose rows are computed for hours: they are kept in a hidden file beside it as they come, in their order, so that a
// run of the program that was ended goes on behind the last whole row. It bears its name when all are there.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <iosfwd>
#include <map>
#include <mutex>
#include <string>

namespace chainreel {

inline constexpr std::uintmax_t kLargestGrown = std::uintmax_t(1) << 32;  // bytes, to be read again
inline const std::string kHashOfRows = "# sha256: ";
// The last line of the table whose lines before it `path` has, with its end.
std::string line_of_hash(const std::string& path);
// Throws Error (exit 3) where the last line of the table at `path` is not the hash of those above it.
void require_hash_of_rows(const std::string& path);

class GrowingTable {
 public:
  // `head`: the lines above the rows, which say all that they depend on; rows under another head are not taken. A table with
  // fewer than `rows` of them is none that is finished. Each begins with its number, the first with `first`: where one does not, rows
  // are taken up to there. Throws Error (exit 6) as OutputFile does, and where another process is at it.
  GrowingTable(const std::string& path, const std::string& head, std::size_t first, std::size_t rows, bool overwrite);
  ~GrowingTable();
  GrowingTable(const GrowingTable&) = delete;
  GrowingTable& operator=(const GrowingTable&) = delete;

  // How many rows were there already, of a table that has this name or is still hidden.
  std::size_t rows_before() const { return before_; }
  bool is_finished() const { return finished_; }
  // Calls `look` with each of those.
  void for_each_before(const std::function<void(const std::string& row)>& look) const;

  // Row lines number `piece`, counted from 0 in this run of the program, in any order and from any thread. Throws Error
  // (exit 6).
  void take(std::size_t piece, std::string lines);
  // All rows are there, and a last line tells the hash of all above it, so that whoever joins parts or goes on sees that they are
  // whole and nobody else's. `file_of`: the bytes that the table becomes, else it stays as it is; a table that became something
  // else is none that is known to be finished.
  void commit(const std::function<std::string(const std::string& csv)>& file_of = nullptr);

 private:
  void append(const std::string& text);
  // What the hidden file becomes.
  void write_table(std::ostream& table) const;

  std::string path_, hidden_;
  std::string hash_;  // of the rows so far
  std::size_t head_size_ = 0;
  std::size_t before_ = 0;
  bool finished_ = false, overwrite_ = false;
  int file_ = -1;
  std::mutex lock_;
  std::map<std::size_t, std::string> waiting_;
  std::size_t next_ = 0;
};

}  // namespace chainreel
