// What the encoding libraries on this machine are and can do: for `doctor` and the audit beside a film.
#pragma once

#include <string>
#include <vector>

namespace chainreel {

struct LibraryVersion {
  std::string name;
  std::string version;
};

// The libraries that were found at run time, which are not always those that were compiled against.
std::vector<LibraryVersion> encode_library_versions();

// Of the encoders that the program cares for, those that are there.
std::vector<std::string> available_encoders();

}  // namespace chainreel
