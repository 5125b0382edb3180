// What a PDF keeps in compressed streams.
#pragma once

#include <string>

namespace chainreel {

// The objects of a page's file that are written into streams (ISO 32000-1, 7.5.7), as text, one behind the other: newer versions of
// Cairo write nearly all there. Streams that do not inflate are left out, and so is what goes beyond 256 MB.
std::string objects_in_streams(const std::string& pdf);

}  // namespace chainreel
