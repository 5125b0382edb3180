// What a render writes: which kinds of files, and where.
#pragma once

#include <string>
#include <vector>

#include "scene/scene.hpp"

namespace chainreel {

enum class TargetKind { mp4, webm, mov, gif, apng, sequence, png, svg, pdf, csv };

struct Target {
  TargetKind kind = TargetKind::mp4;
  std::string path;  // of a sequence, its first picture: FOLDER/NAME_000000.png
  bool is_implied = false;  // no -o names the file itself
};

// Shows motion: a film, a small clip or a sequence of pictures.
bool is_clip(TargetKind kind);
bool is_still(TargetKind kind);  // png, svg, pdf

// By the path's ending; a .png whose name ends in 000000 is a sequence. Throws Error (usage) naming the
// endings.
Target target_of(const std::string& path);

// Endings and numbers of -o are right for that many scenes. Throws Error (usage).
void check_outputs(const std::vector<std::string>& outputs, std::size_t scenes);

// What one scene of several becomes: files as named, or what its preset writes into the folder (`out` where
// none is named). Throws Error (usage) where a target cannot show what the scene asks for.
std::vector<Target> targets_of(const std::vector<std::string>& outputs, std::size_t scenes,
                               const Scene& scene);

// Every path that these targets write, sequences by their folder and stem: where two are the same, something
// would be lost.
std::vector<std::string> paths_of(const std::vector<Target>& targets);

}  // namespace chainreel
