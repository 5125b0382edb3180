// What is being written: a hidden file or folder of a random name, locked for as long as its process lives. By the lock,
// what a killed process left behind is told from what another one still writes.
#pragma once

#include <string>

namespace chainreel {

class TemporaryFile {
 public:
  // `coming` is written, and goes unless it is renamed; `former` is a folder that holds what is being replaced, and
  // comes back where its process dies.
  enum class Kind { coming_file, coming_folder, former_folder };

  // Made anew in `folder`, which is there; `ending` (".mp4") stays last, for writers that go by it. Follows no link and
  // opens no file that is there. Throws Error (exit 6) that names `target`, for which it is made, and what can be done.
  TemporaryFile(Kind kind, const std::string& folder, const std::string& ending, const std::string& target,
                const std::string& remedy = "choose another place for it");
  ~TemporaryFile();  // removes it, with all in it, unless it was let go
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;

  const std::string& path() const { return path_; }
  // Throws Error (exit 6) naming the target where the path leads no longer to what was made, or where the disk does not
  // take the bytes.
  void sync() const;
  void let_go();  // it has been renamed, or is to stay

 private:
  void lock_new();

  Kind kind_;
  std::string path_, target_;
  int file_ = -1;
};

// Hands a folder's list of names to the disk. Throws Error (exit 6) naming `target`.
void sync_folder(const std::string& folder, const std::string& target);

// Removes from a folder, once in each process, what killed processes of this user left there, and brings back what they
// were about to replace.
void remove_leftovers(const std::string& folder);

// Removes all files and folders of this process that are being written, where it ends without unwinding.
void remove_unfinished() noexcept;

// The text with the names of temporary files replaced by those that they were made for: libraries that write tell
// their trouble by the name they were given.
std::string with_final_names(std::string text);

}  // namespace chainreel
