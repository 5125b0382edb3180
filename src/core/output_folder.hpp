// Many files of one output, STEM000000.png and so on: they lie in a hidden folder until all are whole.
#pragma once

#include <string>

namespace chainreel {

class OutputFolder {
 public:
  // Files of `folder` whose names are `stem`, six or more digits and `ending` are this output's. Makes the
  // folders that are missing. Throws Error (exit 6) where the folder cannot be written, or where there are
  // such files, `overwrite` is false and the folder does not lie in or below one named `out`.
  OutputFolder(std::string folder, std::string stem, std::string ending, bool overwrite);
  ~OutputFolder();  // removes the hidden folder
  OutputFolder(const OutputFolder&) = delete;
  OutputFolder& operator=(const OutputFolder&) = delete;

  const std::string& temporary_folder() const { return temporary_; }
  void commit();  // replaces the old files by the new ones; throws Error (exit 6)

 private:
  bool is_ours(const std::string& name) const;

  std::string folder_, stem_, ending_, temporary_;
};

}  // namespace chainreel
