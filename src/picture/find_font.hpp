// Font files by the name of their family. Internal.
#pragma once

#include <string>
#include <vector>

struct FT_LibraryRec_;

namespace chainreel {

enum class WantedFace { regular, bold, math };

// A face among those of a file: collections (.ttc) have several.
struct FontFile {
  std::string file;
  int index = 0;
};

// An upright face that can be drawn at any size.
struct InstalledFace {
  FontFile at;
  std::string family;
  int weight = 400, width = 5;  // OpenType's: regular is 400, bold 700, normal width 5
};

// Where fonts are installed, the user's own folder among them.
std::vector<std::string> font_folders();

// All upright faces there, in the order of their paths, so that the order in which a file system lists names means nothing.
std::vector<InstalledFace> installed_faces(FT_LibraryRec_* library, const std::vector<std::string>& folders);

// The file of a family's upright face that is nearest to the wanted weight and to normal width; of equals the one whose
// path is first. Throws Error (exit 4) with names alike where there is none.
FontFile find_font(FT_LibraryRec_* library, const std::string& family, WantedFace wanted);

}  // namespace chainreel
