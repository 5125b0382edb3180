// Many files of one output, STEM000000.png and so on: they lie in a hidden folder until all are whole, and replace the
// former ones together or not at all.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "core/temporary_file.hpp"

namespace chainreel {

class OutputFolder {
 public:
  // Files of `folder` whose names are `stem`, six or more digits and `ending` are this output's. Makes the
  // folders that are missing. Throws Error (exit 6) where the folder cannot be written, or where there are
  // such files, `overwrite` is false and the folder does not lie in or below one named `out`; also where such a name
  // belongs to a folder, a device or an input of this run.
  OutputFolder(std::string folder, std::string stem, std::string ending, bool overwrite);
  OutputFolder(const OutputFolder&) = delete;
  OutputFolder& operator=(const OutputFolder&) = delete;

  const std::string& temporary_folder() const { return temporary_->path(); }
  // Replaces the old files by the new ones; throws Error (exit 6) where that failed and the old ones are as they were.
  void commit();

 private:
  bool is_ours(const std::string& name) const;
  std::vector<std::string> names_of_ours() const;

  std::string folder_, stem_, ending_;
  std::unique_ptr<TemporaryFile> temporary_;
};

}  // namespace chainreel
