#include "encode/usual_png.hpp"

#include <libdeflate.h>

#include <bit>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <string>

#include "core/large_memory.hpp"

namespace chainreel {
namespace {

using std::string_view_literals::operator""sv;

constexpr std::string_view kSignature = "\x89PNG\r\n\x1a\n";
constexpr std::uint32_t kLargest = 32768;  // pixels a side

std::uint32_t number_at(std::string_view bytes, std::size_t at) {
  std::uint32_t number = 0;
  for (std::size_t i = 0; i < 4; ++i) number = 256 * number + static_cast<unsigned char>(bytes[at + i]);
  return number;
}

struct Chunks {
  std::uint32_t width = 0, height = 0;
  std::size_t channels = 0;  // 3: RGB, 4: RGBA
  std::string pixels;        // compressed
};

// True where IHDR's 13 bytes tell of a picture of the usual kind.
bool read_head(std::string_view body, Chunks& chunks) {
  if (body.size() != 13) return false;
  chunks.width = number_at(body, 0);
  chunks.height = number_at(body, 4);
  const std::string_view kind = body.substr(8);  // depth, colours, compression, filter, interlace
  if (kind == "\x08\x02\0\0\0"sv) chunks.channels = 3;
  if (kind == "\x08\x06\0\0\0"sv) chunks.channels = 4;
  const auto is_side = [](std::uint32_t side) { return side > 0 && side <= kLargest; };
  return chunks.channels != 0 && is_side(chunks.width) && is_side(chunks.height);
}

// Chunks that say nothing of the pixels' values.
bool says_nothing_of_values(std::string_view name) {
  return name == "tEXt" || name == "iTXt" || name == "zTXt" || name == "tIME" || name == "pHYs" ||
         name == "sRGB";
}

// Length, name, that many bytes and a checksum of name and bytes each: IHDR first, all IDAT in a row, IEND
// last.
std::optional<Chunks> read_chunks(std::string_view bytes) {
  if (!bytes.starts_with(kSignature)) return std::nullopt;
  Chunks chunks;
  std::string_view last;
  for (std::size_t at = kSignature.size(); last != "IEND"sv;) {
    if (bytes.size() - at < 12 || number_at(bytes, at) > bytes.size() - at - 12) return std::nullopt;
    const std::size_t length = number_at(bytes, at);
    const std::string_view named = bytes.substr(at + 4, length + 4), name = named.substr(0, 4),
                           body = named.substr(4);
    if (libdeflate_crc32(0, named.data(), named.size()) != number_at(bytes, at + 8 + length))
      return std::nullopt;
    if (last.empty() ? name != "IHDR"sv || !read_head(body, chunks)
                     : name != "IDAT"sv && name != "IEND"sv && !says_nothing_of_values(name))
      return std::nullopt;
    if (name == "IDAT"sv) {
      if (!chunks.pixels.empty() && last != "IDAT"sv) return std::nullopt;
      chunks.pixels += body;
    }
    last = name;
    at += 12 + length;
  }
  return chunks;
}

int paeth(int left, int above, int corner) {
  const int guess = left + above - corner;
  const int to_left = std::abs(guess - left), to_above = std::abs(guess - above),
            to_corner = std::abs(guess - corner);
  return to_left <= to_above && to_left <= to_corner ? left : to_above <= to_corner ? above : corner;
}

// Takes a row's filter back in place. `above` is the row above it, zeros at the top. False where there is no
// such filter.
bool unfilter(int filter, std::uint8_t* row, const std::uint8_t* above, std::size_t count,
              std::size_t channels) {
  const auto left = [&](std::size_t i) { return i < channels ? 0 : int(row[i - channels]); };
  const auto corner = [&](std::size_t i) { return i < channels ? 0 : int(above[i - channels]); };
  const auto add = [&](auto guess) {
    for (std::size_t i = 0; i < count; ++i) row[i] = std::uint8_t(row[i] + guess(i));
  };
  switch (filter) {
    case 0:
      break;
    case 1:
      add(left);
      break;
    case 2:
      add([&](std::size_t i) { return int(above[i]); });
      break;
    case 3:
      add([&](std::size_t i) { return (left(i) + above[i]) / 2; });
      break;
    case 4:
      add([&](std::size_t i) { return paeth(left(i), above[i], corner(i)); });
      break;
    default:
      return false;
  }
  return true;
}

// One row of RGB or RGBA as BGRA; four bytes may be read from where a pixel begins.
template <std::size_t kChannels>
void to_bgra(const std::uint8_t* row, std::size_t pixels, std::uint8_t* bgra) {
  static_assert(std::endian::native == std::endian::little);
  for (std::size_t x = 0; x < pixels; ++x) {
    std::uint32_t rgba;
    std::memcpy(&rgba, row + kChannels * x, 4);
    const std::uint32_t bgr = __builtin_bswap32(rgba) >> 8;  // in one instruction, where shifts take six
    const std::uint32_t pixel = bgr | (kChannels == 4 ? rgba & 0xff000000 : 0xff000000);
    std::memcpy(bgra + 4 * x, &pixel, 4);
  }
}

struct FreeDecompressor {
  void operator()(libdeflate_decompressor* one) const { libdeflate_free_decompressor(one); }
};

}  // namespace

std::optional<Image> decode_usual_png(std::string_view bytes) {
  const std::optional<Chunks> chunks = read_chunks(bytes);
  if (!chunks) return std::nullopt;
  const std::size_t width = chunks->width, height = chunks->height, count = chunks->channels * width;
  const std::size_t stride = 1 + count, size = height * stride;  // a row is its filter and its bytes
  const RawBytes rows(size + 1);  // one for to_bgra
  const std::unique_ptr<libdeflate_decompressor, FreeDecompressor> zlib(libdeflate_alloc_decompressor());
  if (!zlib || libdeflate_zlib_decompress(zlib.get(), chunks->pixels.data(), chunks->pixels.size(),
                                          rows.get(), size, nullptr) != LIBDEFLATE_SUCCESS)
    return std::nullopt;

  Image image{int(width), int(height)};
  const std::string top(count, '\0');
  const std::uint8_t* above = reinterpret_cast<const std::uint8_t*>(top.data());
  for (std::size_t y = 0; y < height; ++y) {
    std::uint8_t* row = &rows[y * stride + 1];
    if (!unfilter(rows[y * stride], row, above, count, chunks->channels)) return std::nullopt;
    (chunks->channels == 3 ? to_bgra<3> : to_bgra<4>)(row, width, &image.bgra[4 * width * y]);
    above = row;
  }
  return image;
}

}  // namespace chainreel
