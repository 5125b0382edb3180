// Nothing half-written ever bears the final name: an output is written to a temporary file in the same folder
// and renamed when it is complete.
#pragma once

#include <limits>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "core/temporary_file.hpp"

namespace chainreel {

// A dash stands for standard output, which what goes into a file cannot go to; nobody wants a file or a folder of that
// name. Throws Error (exit 2).
void refuse_dash(const std::string& path);

// Throws Error (exit 2) where two of the paths that -o names are one file, however they are written.
void refuse_twice(const std::vector<std::string>& paths);

class OutputFile {
 public:
  // Makes the folders that are missing; a link to a file stands for that file. Throws Error (exit 6) where the folder
  // cannot be written, where `path` is a folder, device, pipe or socket, where it is an input of this run, and where it
  // exists, `overwrite` is false and the file does not lie below a folder named `out`.
  explicit OutputFile(std::string path, bool overwrite);
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;

  const std::string& path() const { return path_; }
  bool is_done() const { return temporary_->path().empty(); }
  const std::string& temporary_path() const { return temporary_->path(); }  // write here, then commit()
  // Done when the disk has it. Throws Error (exit 6), also where a file has come to `path` since that may not be
  // replaced.
  void commit();
  // A run that failed: keeps what there is as `path` with .partial before its ending, and returns that.
  std::string keep_as_partial();

 private:
  void rename_to(const std::string& target, bool replace);

  std::string path_;    // as named
  std::string target_;  // what it stands for, behind links
  bool replace_;        // a file may stand there
  std::unique_ptr<TemporaryFile> temporary_;  // removed with this, unless renamed
};

// Throws Error (exit 6) where `path` cannot be replaced whatever the user says: it is no plain file, or an input of this
// run.
void require_replaceable(const std::string& path);

// Writes the whole text to the temporary file. Throws Error (exit 6) where the disk does not take it all.
void write_temporary(const OutputFile& output, std::string_view text);
// Writes the whole text, then commits. Throws Error (exit 6) where the disk does not take it all.
void write_whole(OutputFile& output, std::string_view text);
// Writes a whole text in one go through an OutputFile.
void write_text_file(const std::string& path, std::string_view text, bool overwrite);

// Many files of one output, STEM000000.png and so on: they lie in a hidden folder until all are whole, and replace the
// former ones together or not at all.

class OutputFolder {
 public:
  // Files of `folder` whose names are `stem`, six or more digits and `ending` are this output's. Makes the
  // folders that are missing. Throws Error (exit 6) where the folder cannot be written, or where there are
  // such files, `overwrite` is false and the folder does not lie in or below one named `out`; also where such a name
  // belongs to a folder, a device or an input of this run.
  // `is_part`: keep_to() will say which they are, and commit() refuses what may not be replaced.
  OutputFolder(std::string folder, std::string stem, std::string ending, bool overwrite, bool is_part = false);
  OutputFolder(const OutputFolder&) = delete;
  OutputFolder& operator=(const OutputFolder&) = delete;

  // Before commit(): only those numbered first, first + 1, .. behind - 1 are this output's, which is a part of a sequence
  // that others write, too.
  void keep_to(int first, int behind);

  // Likewise: those numbered from there on are not this output's and stay. Returns their names.
  std::vector<std::string> leave_from(long number);

  const std::string& temporary_folder() const { return temporary_->path(); }
  // Replaces the old files by the new ones; throws Error (exit 6) where that failed and the old ones are as they were.
  void commit();

 private:
  bool is_ours(const std::string& name) const;
  std::vector<std::string> names_of_ours() const;

  void require_ours_replaceable() const;

  std::string folder_, stem_, ending_;
  bool overwrite_;
  long first_ = 0, behind_ = std::numeric_limits<long>::max();
  std::unique_ptr<TemporaryFile> temporary_;
};

}  // namespace chainreel
