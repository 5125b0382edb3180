// What a render writes: which kinds of files, and where.
#pragma once

#include <string>
#include <vector>

#include "app/film/clip_memory.hpp"
#include "app/film/formats.hpp"
#include "core/image.hpp"
#include "picture/picture.hpp"
#include "picture/text.hpp"
#include "scene/scene.hpp"

namespace chainreel {

struct Target {
  const OutputFormat* format = nullptr;
  std::string path;  // of a sequence, its first picture: FOLDER/NAME_000000.png
  bool is_implied = false;  // no -o names the file itself
};

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

// One picture as pixels, and as a file.

// One picture as pixels.
Image rasterise(const Picture& picture, int width, int height, const Fonts& fonts);
// Throws Error (usage) unless the path's ending is a picture's.
const OutputFormat& picture_format_of(const std::string& path);
// ... and as a file that appears whole or not at all: .png, .svg or .pdf. Vector pages have the proportions of the
// pixels, and a height that suits a sheet of paper.
void write_picture(const Picture& picture, int width, int height, const Fonts& fonts, const std::string& path,
                   bool overwrite, const ClipMemory& memory = {});

}  // namespace chainreel
