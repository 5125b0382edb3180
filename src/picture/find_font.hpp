// Font files by the name of their family. Internal.
#pragma once

#include <string>

struct FT_LibraryRec_;

namespace chainreel {

enum class WantedFace { regular, bold, math };

// The file of a family's upright face that is nearest to the wanted weight and to normal width; of equals the one whose
// path is first. Throws Error (exit 4) with names alike where there is none.
std::string find_font(FT_LibraryRec_* library, const std::string& family, WantedFace wanted);

}  // namespace chainreel
