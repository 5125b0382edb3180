#include "app/works/outputs.hpp"

#include <algorithm>
#include <filesystem>

#include "app/cli/streams.hpp"
#include "app/report/motion_table.hpp"
#include "app/report/sidecar.hpp"
#include "core/format.hpp"

namespace chainreel {
namespace fs = std::filesystem;

SequencePlace place_of_sequence(const std::string& path) {
  const fs::path file(path);
  const std::string name = file.stem().string();
  return {file.parent_path().string(), name.substr(0, name.size() - 6)};
}

std::string base_of(const Target& target) {
  if (!target.format->is_sequence) return fs::path(target.path).replace_extension().string();
  SequencePlace place = place_of_sequence(target.path);
  while (place.stem.ends_with('_')) place.stem.pop_back();
  return (fs::path(place.folder) / (place.stem.empty() ? "frames" : place.stem)).string();
}

std::vector<Output> open_outputs(const std::vector<Target>& targets, std::size_t panels, bool overwrite,
                                 bool is_part) {
  std::vector<Output> outputs;
  for (const Target& target : targets) {
    Output output{target, {}, {}};
    if (target.is_implied) require_own_sidecar(target.path, overwrite);
    if (target.format->is_sequence) {
      const SequencePlace place = place_of_sequence(target.path);
      output.folder = std::make_unique<OutputFolder>(place.folder, place.stem, ".png", overwrite, is_part);
    } else if (target.format->shows == Shows::table) {
      for (std::size_t i = 0; i < panels; ++i)
        output.files.push_back(std::make_unique<OutputFile>(panel_table_path(target.path, i, panels == 1), overwrite));
    } else {
      output.files.push_back(std::make_unique<OutputFile>(target.path, overwrite));
    }
    outputs.push_back(std::move(output));
  }
  return outputs;
}

std::vector<std::string> leave_foreign_frames(std::vector<Output>& outputs, int frames) {
  std::vector<std::string> notes;
  for (Output& output : outputs) {
    if (!output.folder) continue;
    const std::size_t known = frames_told_at(base_of(output.target) + ".json", output.target.path);
    const std::vector<std::string> left = output.folder->leave_from(std::max(long(frames), long(known)));
    if (!left.empty())
      notes.push_back("named like further frames of " + output.target.path + ", but none of its: " + shortened(joined(left), 200) + (left.size() == 1 ? " is" : " are") + " left");
  }
  return notes;
}

std::vector<std::string> commit(std::vector<Output>& outputs) {
  std::vector<std::string> paths;
  for (Output& output : outputs) {
    for (auto& file : output.files) {
      file->commit();
      paths.push_back(file->path());
    }
    if (!output.folder) continue;
    output.folder->commit();
    paths.push_back(output.target.path);
  }
  return paths;
}

void keep_partial(std::vector<Output>& outputs) {
  for (Output& output : outputs)
    if (!output.shows(Shows::still))
      for (auto& file : output.files) keep_and_tell(*file);
}

}  // namespace chainreel
