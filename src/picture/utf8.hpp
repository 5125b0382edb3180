// UTF-8 to characters and back.
#pragma once

#include <string>
#include <string_view>

namespace chainreel {

// Throws Error (exit 3) where the bytes are not well-formed UTF-8 (overlong forms and surrogates included).
std::u32string decode_utf8(std::string_view utf8);
std::string encode_utf8(std::u32string_view text);

}  // namespace chainreel
