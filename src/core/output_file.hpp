// Nothing half-written ever bears the final name: an output is written to a temporary file in the same folder
// and renamed when it is complete.
#pragma once

#include <string>
#include <string_view>

namespace chainreel {

class OutputFile {
 public:
  // Makes the folders that are missing. Throws Error (exit 6) where the folder cannot be written, or where
  // `path` exists, `overwrite` is false and the file does not lie below a folder named `out`.
  explicit OutputFile(std::string path, bool overwrite);
  ~OutputFile();  // removes the temporary file unless committed
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;

  const std::string& path() const { return path_; }
  const std::string& temporary_path() const { return temporary_path_; }  // write here, then commit()
  void commit();                                                         // throws Error (exit 6)
  void keep_as_partial();  // a run that failed: keep what there is as `path` with .partial before its ending

 private:
  void rename_to(const std::string& target);

  std::string path_;
  std::string temporary_path_;
  bool done_ = false;
};

// Writes the whole text to the temporary file. Throws Error (exit 6) where the disk does not take it all.
void write_temporary(const OutputFile& output, std::string_view text);
// Writes the whole text, then commits or keeps it as partial. Throws Error (exit 6) where the disk does not
// take it all.
void write_whole(OutputFile& output, std::string_view text);
void write_partial(OutputFile& output, std::string_view text);
// Writes a whole text in one go through an OutputFile.
void write_text_file(const std::string& path, std::string_view text, bool overwrite);

}  // namespace chainreel
