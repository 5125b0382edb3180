// The files of a film while they are being made: nothing is begun before all of them can be written, nothing bears its name
// before all are whole.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "app/film/target.hpp"
#include "core/output_file.hpp"

namespace chainreel {

// One target on its way: where it is written.
struct Output {
  Target target;
  std::vector<std::unique_ptr<OutputFile>> files;  // one, or a table a panel, or none of a sequence
  std::unique_ptr<OutputFolder> folder;            // of a sequence

  bool shows(Shows what) const { return target.format->shows == what; }
  const std::string& temporary_path() const { return files.front()->temporary_path(); }
};

struct SequencePlace {
  std::string folder, stem;  // stem: all before the six digits
};
SequencePlace place_of_sequence(const std::string& path);

// What sidecars of a target are named after.
std::string base_of(const Target& target);

// `is_part`: sequences hold frames of others, too. Throws Error (exit 6) where one of them cannot be written.
std::vector<Output> open_outputs(const std::vector<Target>& targets, std::size_t panels, bool overwrite, bool is_part);

// Files that are named like further frames of a sequence, and of which no audit of it tells, are somebody's and stay, which is what the
// notes say. Before commit().
std::vector<std::string> leave_foreign_frames(std::vector<Output>& outputs, int frames);

// Gives all of them their names, and tells these in the order of the targets.
std::vector<std::string> commit(std::vector<Output>& outputs);
// Films and tables of a run that failed, as far as they came, under a .partial name.
void keep_partial(std::vector<Output>& outputs);

}  // namespace chainreel
