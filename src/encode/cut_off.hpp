// Whether a file was cut off since it was written, as by a copy that did not end: what it says of itself stands before its pictures.
#pragma once

#include <string>

namespace chainreel {

// By the lengths that MP4, MOV and WebM tell, and by how PNG, APNG and SVG end; false of all else, and where there is no file.
bool is_cut_off(const std::string& path);

}  // namespace chainreel
