// What the encoding libraries on this machine are and can do: for `doctor` and the audit beside a film.
#pragma once

#include <string>
#include <vector>

namespace chainreel {

struct LibraryVersion {
  std::string name;
  std::string version;
};

// The libraries that were found at run time, which are not always those that were compiled against. Pictures are written
// without FFmpeg's, which are not even opened for them.
enum class Writes { pictures, films };
std::vector<LibraryVersion> encode_library_versions(Writes writes = Writes::films);

// Which builds of the libraries behind FFmpeg's encode films: "libx264.so.164 5f1c..", by their build ids, as these libraries tell no
// version that names all that bytes hang on.
std::vector<std::string> encoder_builds();

// The encoders that are there, of those that the program cares for.
std::vector<std::string> available_encoders();

}  // namespace chainreel
