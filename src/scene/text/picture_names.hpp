// Names of pictures that become names of files.
#pragma once

#include <map>
#include <string>

#include "core/error.hpp"

namespace chainreel {

// A text that may have a picture's name in front: home=0,90deg.
struct NamedText {
  std::string name;  // "": none was given
  std::string text;
};
// Throws Error (usage) where the name is missing.
NamedText named_text(const std::string& text);

// Letters, digits and . _ - + stay, and what is no ASCII; all else becomes _, as does a . or - at the
// beginning, so that no file is hidden or read as a flag. Never empty.
std::string file_name_of(const std::string& name);

// Those that were given; no two may be the same file, not even where capitals do not count.
class PictureNames {
 public:
  // Adds a problem that names both places where the name, or one that differs in capitals alone, was given
  // before, or where it is too long for a file.
  void add(const std::string& name, const Place& place, ProblemList& problems);

 private:
  struct Given {
    std::string name;
    Place place;
  };
  std::map<std::string, Given> given_;  // by their small letters
};

}  // namespace chainreel
