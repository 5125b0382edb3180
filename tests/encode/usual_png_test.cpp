#include "encode/usual_png.hpp"

#include <gtest/gtest.h>
#include <zlib.h>

#include <cstdlib>
#include <optional>
#include <string>

#include "core/error.hpp"
#include "encode/png.hpp"
#include "encode/test_pictures.hpp"
#include "support/temporary_folder.hpp"

namespace chainreel {
namespace {

std::string big_endian(std::uint32_t number) {
  return {char(number >> 24), char(number >> 16), char(number >> 8), char(number)};
}

std::string chunk(const std::string& name, const std::string& body) {
  const std::string named = name + body;
  const uLong sum = crc32(0, reinterpret_cast<const Bytef*>(named.data()), uInt(named.size()));
  return big_endian(std::uint32_t(body.size())) + named + big_endian(std::uint32_t(sum));
}

std::string squeezed(const std::string& raw) {
  uLongf size = compressBound(uLong(raw.size()));
  std::string bytes(size, '\0');
  compress(reinterpret_cast<Bytef*>(bytes.data()), &size, reinterpret_cast<const Bytef*>(raw.data()),
           uLong(raw.size()));
  bytes.resize(size);
  return bytes;
}

const std::string kSignature = "\x89PNG\r\n\x1a\n";

struct Kind {
  int channels = 4;
  int first_filter = 0;                   // of the first row; the rows below go on with the next ones ..
  bool all_same = false;                  // .. or with the same
  std::string before = "", between = "";  // chunks before the pixels, and between their two
  char interlace = 0;
};

// A picture as PNG, its rows filtered as the specification says (9.2).
std::string png_of(const Image& image, const Kind& kind = {}) {
  std::string raw;
  const auto byte = [&](int x, int y, int channel) {
    if (x < 0 || y < 0) return 0;
    const Pixel p = image.at(x, y);
    return int(channel == 0 ? p.r : channel == 1 ? p.g : channel == 2 ? p.b : p.a);
  };
  for (int y = 0; y < image.height; ++y) {
    const int filter = kind.all_same ? kind.first_filter : (kind.first_filter + y) % 5;
    raw += char(filter);
    for (int x = 0; x < image.width; ++x)
      for (int c = 0; c < kind.channels; ++c) {
        const int a = byte(x - 1, y, c), b = byte(x, y - 1, c),
                  d = x > 0 && y > 0 ? byte(x - 1, y - 1, c) : 0;
        const int p = a + b - d, pa = std::abs(p - a), pb = std::abs(p - b), pd = std::abs(p - d);
        const int guesses[] = {0, a, b, (a + b) / 2, pa <= pb && pa <= pd ? a : pb <= pd ? b : d};
        raw += char(byte(x, y, c) - (filter < 5 ? guesses[filter] : 0));  // there are no others
      }
  }
  const std::string pixels = squeezed(raw);
  const std::string head = big_endian(std::uint32_t(image.width)) + big_endian(std::uint32_t(image.height)) +
                           std::string{8, char(kind.channels == 4 ? 6 : 2), 0, 0, kind.interlace};
  return kSignature + chunk("IHDR", head) + kind.before + chunk("IDAT", pixels.substr(0, pixels.size() / 2)) +
         kind.between + chunk("IDAT", pixels.substr(pixels.size() / 2)) + chunk("IEND", "");
}

Image opaque(Image image) {
  for (std::size_t i = 3; i < image.bgra.size(); i += 4) image.bgra[i] = 255;
  return image;
}

TEST(UsualPng, EveryFilterOfBothKindsIsTakenBack) {
  const Image image = random_picture(13, 11, 1);
  for (const int channels : {3, 4}) {
    const Image expected = channels == 3 ? opaque(image) : image;
    for (int filter = 0; filter < 5; ++filter)
      for (const bool all_same : {false, true}) {
        const std::optional<Image> read = decode_usual_png(
            png_of(image, {.channels = channels, .first_filter = filter, .all_same = all_same}));
        ASSERT_TRUE(read);
        EXPECT_EQ(read->width, 13);
        EXPECT_EQ(read->height, 11);
        EXPECT_EQ(read->bgra, expected.bgra) << channels << " channels, filter " << filter;
      }
  }
}

TEST(UsualPng, PicturesOfOurOwnAreUsual) {
  const TemporaryFolder folder;
  for (const Image& image : {random_picture(37, 23, 1), disc_picture(64, 48, 3)}) {
    write_png(folder.file("a.png"), image, {{"title", "one"}, {"words", "\xce\xb8"}});
    const std::optional<Image> read = decode_usual_png(read_whole_file(folder.file("a.png")));
    ASSERT_TRUE(read);
    EXPECT_EQ(read->bgra, image.bgra);
  }
}

// Whatever may change what a value means is libpng's.
TEST(UsualPng, WhatSaysMoreOfThePixelsIsNot) {
  const Image image = random_picture(5, 4, 2);
  const Kind kinds[] = {{.before = chunk("gAMA", big_endian(100000))},
                        {.channels = 3, .before = chunk("tRNS", std::string(6, '\1'))},
                        {.before = chunk("sBIT", "\5\5\5\5")},
                        {.before = chunk("acTL", std::string(8, '\1'))},
                        {.before = chunk("ABCD", "")},
                        {.between = chunk("tEXt", std::string("a\0b", 3))},
                        {.interlace = 1}};
  for (const Kind& kind : kinds) EXPECT_FALSE(decode_usual_png(png_of(image, kind)));
  EXPECT_TRUE(decode_usual_png(png_of(image, {.before = chunk("tEXt", std::string("a\0b", 3))})));
  EXPECT_FALSE(decode_usual_png(png_of(image, {.first_filter = 5, .all_same = true})));
}

// A byte of a checksum, of a length, of the pixels: none passes, and libpng says what is wrong.
TEST(UsualPng, NoDamagedFileIs) {
  const std::string sound = png_of(random_picture(4, 3, 3));
  ASSERT_TRUE(decode_usual_png(sound));
  for (std::size_t i = 0; i < sound.size(); ++i) {
    EXPECT_FALSE(decode_usual_png(sound.substr(0, i))) << i;
    for (const int bit : {1, 0x80}) {
      std::string damaged = sound;
      damaged[i] = char(damaged[i] ^ bit);
      EXPECT_FALSE(decode_usual_png(damaged)) << i;
    }
  }
  EXPECT_THROW(decode_png(sound.substr(0, sound.size() / 2), "a.png"), Error);
}

TEST(UsualPng, OthersAreReadAllTheSame) {
  const Image image = random_picture(5, 4, 2);
  EXPECT_EQ(decode_png(png_of(image, {.before = chunk("sBIT", "\5\5\5\5")}), "a.png").bgra, image.bgra);
}

}  // namespace
}  // namespace chainreel
