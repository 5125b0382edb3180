// Films as one page for browsers, with all that is known of them, in one file without a server.
#pragma once

#include <ostream>
#include <string>
#include <vector>

#include "app/gallery_clips.hpp"

namespace chainreel {

// Films are read while they are written, one piece after the other. The same films give the same page. Throws
// Error (exit 3) where one cannot be read any more.
void write_gallery(std::ostream& stream, const std::vector<GalleryClip>& clips, const std::string& title);

}  // namespace chainreel
