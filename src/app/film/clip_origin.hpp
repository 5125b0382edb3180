// Where the paths start that a clip or picture remembers: in the folder of the scene or model that it shows.
// The file does not say where that is, so that it is the same wherever it was made; the folder is found again
// by what lies in it.
#pragma once

#include <string>
#include <vector>

#include "app/film/clip_memory.hpp"

namespace chainreel {

// A text of what a clip says, "" where there is none: it was maybe not written by this program, so that everything is looked at before
// it is taken.
std::string word_of(const Json& json, const char* key);

// What a program of the user's drove it with, "the Python function f", by its audit: of all panels the first; "" of others.
std::string torque_function_in(const Json& audit);

// Where the path begins of a word of a command that names a file: behind the = of --package NAME=FOLDER. `before`: the word before it.
std::size_t begin_of_path(const std::string& word, const std::string& before);

// The model or scene of a figure that remembers what it said; "" of others.
std::string first_file_of(const Json& figure);

struct WantedFile {
  std::string path;    // relative to the folder that is sought
  std::string sha256;  // "": any
};

struct ClipOrigin {
  std::string folder;  // "": the working folder
  bool is_found = false;
  std::vector<std::string> changed;  // as found from the working folder: files that are others now
  std::vector<std::string> missing;  // as remembered
};

// Looks in the working folder, then in that of the clip, in a few above and in those below both, nearest first; of folders
// that hold all files, one that holds them unchanged wins over others but the working folder. `given` is the only one
// looked at unless it is "".
ClipOrigin find_origin(const std::string& clip, const std::vector<WantedFile>& wanted,
                       const std::string& given);

// In a picture's audit and a figure: its scene or model came with the program, and not from a folder of the user's.
inline constexpr const char* kShipped = "shipped";

// The folder nearest to the clip that holds the file `first` and all others, whatever has become of them, so that a change of what lies beside it is
// not missed for a copy elsewhere; others may come with the program. `shipped`: of what came with the program itself.
ClipOrigin find_nearest(const std::string& clip, const std::string& first, const std::vector<WantedFile>& wanted, bool shipped);

// What a memory needs beside it: relative paths of its scene, or of its figure's words, with the hashes that
// its audit tells.
std::vector<WantedFile> files_wanted_by(const ClipMemory& memory);

// The figure with paths as found from the working folder.
Json figure_from(const Json& figure, const ClipOrigin& origin);

}  // namespace chainreel
