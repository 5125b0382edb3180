#include "picture/utf8.hpp"

#include <cstdint>

#include "core/error.hpp"

namespace chainreel {
namespace {

// Bytes of the sequence that `lead` opens, 0 where it cannot open one.
int sequence_length(unsigned char lead) {
  if (lead < 0x80) return 1;
  if (lead < 0xC2) return 0;  // a continuation byte, or an overlong form
  if (lead < 0xE0) return 2;
  if (lead < 0xF0) return 3;
  return lead < 0xF5 ? 4 : 0;
}

constexpr std::uint32_t kSmallest[5] = {0, 0, 0x80, 0x800, 0x10000};

bool is_surrogate(std::uint32_t c) {
  return c >= 0xD800 && c < 0xE000;
}

}  // namespace

std::u32string decode_utf8(std::string_view utf8) {
  std::u32string text;
  for (std::size_t i = 0; i < utf8.size();) {
    const auto lead = static_cast<unsigned char>(utf8[i]);
    const int length = sequence_length(lead);
    std::uint32_t c = length == 1 ? lead : lead & (0x7Fu >> length);
    bool good = length > 0 && i + std::size_t(length) <= utf8.size();
    for (int k = 1; good && k < length; ++k) {
      const auto byte = static_cast<unsigned char>(utf8[i + std::size_t(k)]);
      good = (byte & 0xC0) == 0x80;
      c = c << 6 | (byte & 0x3Fu);
    }
    if (!good || c < kSmallest[length] || c > 0x10FFFF || is_surrogate(c))
      throw Error(ExitCode::bad_input, "text is not UTF-8: byte " + std::to_string(i + 1) + " of '" +
                                           std::string(utf8) + "'; save the file as UTF-8");
    text.push_back(char32_t(c));
    i += std::size_t(length);
  }
  return text;
}

std::string encode_utf8(std::u32string_view text) {
  std::string utf8;
  for (const char32_t c : text) {
    if (c < 0x80) {
      utf8 += char(c);
    } else if (c < 0x800) {
      utf8 += {char(0xC0 | c >> 6), char(0x80 | (c & 0x3F))};
    } else if (c < 0x10000) {
      utf8 += {char(0xE0 | c >> 12), char(0x80 | (c >> 6 & 0x3F)), char(0x80 | (c & 0x3F))};
    } else {
      utf8 += {char(0xF0 | c >> 18), char(0x80 | (c >> 12 & 0x3F)), char(0x80 | (c >> 6 & 0x3F)),
               char(0x80 | (c & 0x3F))};
    }
  }
  return utf8;
}

}  // namespace chainreel
