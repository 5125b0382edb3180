// Bytes as text that any page may hold: base64 (RFC 4648, section 4), without line breaks.
#pragma once

#include <iosfwd>
#include <string>
#include <string_view>

namespace chainreel {

std::string base64(std::string_view bytes);

// A file's bytes, piece by piece. Throws Error (exit 3) where it cannot be read.
void write_base64_of_file(std::ostream& stream, const std::string& path);

}  // namespace chainreel
