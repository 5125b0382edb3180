#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "encode/test_pictures.hpp"
#include "encode/yuv.hpp"

namespace chainreel {
namespace {

struct Planes {
  std::vector<std::uint8_t> y, cb, cr;
  friend bool operator==(const Planes&, const Planes&) = default;
};

using Converter = void (*)(const Image&, const PixelBox&, const PlanesYuv420&);

PlanesYuv420 pointers_to(Planes& p, const Image& image) {
  return {{p.y.data(), p.cb.data(), p.cr.data()}, {image.width, image.width / 2, image.width / 2}};
}

Planes planes_of(const Image& image, Converter convert) {
  const std::size_t pixels = std::size_t(image.width) * std::size_t(image.height);
  Planes p{std::vector<std::uint8_t>(pixels), std::vector<std::uint8_t>(pixels / 4),
           std::vector<std::uint8_t>(pixels / 4)};
  convert(image, {0, 0, image.width, image.height}, pointers_to(p, image));
  return p;
}

// The formulas of BT.709 themselves, in floating point.
struct Ycc {
  double y, cb, cr;
};
Ycc bt709(double r, double g, double b) {
  const double luma = 0.2126 * r + 0.7152 * g + 0.0722 * b;
  return {16 + 219 * luma / 255, 128 + 224 * (b - luma) / (1.8556 * 255),
          128 + 224 * (r - luma) / (1.5748 * 255)};
}

// Rounding to a whole code, and weights rounded to 2^-16 times three channels of 255.
constexpr double kRounding = 0.5 + 3 * 255.0 / 65536;

double largest_error(const Image& image, const Planes& planes) {
  double error = 0;
  for (int y = 0; y < image.height; y += 2) {
    for (int x = 0; x < image.width; x += 2) {
      double r = 0, g = 0, b = 0;
      for (int i = 0; i < 4; ++i) {
        const int px = x + i % 2, py = y + i / 2;
        const Pixel p = image.at(px, py);
        error =
            std::max(error, std::abs(planes.y[std::size_t(py * image.width + px)] - bt709(p.r, p.g, p.b).y));
        r += p.r / 4.0;
        g += p.g / 4.0;
        b += p.b / 4.0;
      }
      const std::size_t chroma = std::size_t((y / 2) * (image.width / 2) + x / 2);
      error = std::max(error, std::abs(planes.cb[chroma] - bt709(r, g, b).cb));
      error = std::max(error, std::abs(planes.cr[chroma] - bt709(r, g, b).cr));
    }
  }
  return error;
}

TEST(Yuv420, FollowsBt709ToHalfACode) {
  const Image image = random_picture(254, 62, 1);
  EXPECT_LE(largest_error(image, planes_of(image, convert_to_yuv420)), kRounding);
}

TEST(Yuv420, CornersOfTheColourCubeStayInLimitedRange) {
  for (const unsigned rgb :
       {0x000000u, 0xFF0000u, 0x00FF00u, 0x0000FFu, 0xFFFF00u, 0x00FFFFu, 0xFF00FFu, 0xFFFFFFu}) {
    const Image image = flat_picture(16, 2, pixel_of(rgb));
    const Planes planes = planes_of(image, convert_to_yuv420);
    EXPECT_LE(largest_error(image, planes), kRounding) << std::hex << rgb;
    EXPECT_GE(planes.y[0], 16);
    EXPECT_LE(planes.y[0], 235);
    for (const std::uint8_t c : {planes.cb[0], planes.cr[0]}) {
      EXPECT_GE(c, 16);
      EXPECT_LE(c, 240);
    }
  }
}

TEST(Yuv420, PartsThatChangedMakeTheWhole) {
  const Image before = random_picture(254, 62, 1);
  const std::vector<PixelBox> parts = {{0, 0, 2, 2}, {32, 10, 78, 20}, {200, 0, 54, 62}, {252, 60, 2, 2}};
  Image after = before;
  for (const PixelBox& part : parts)
    for (int y = part.y; y < part.bottom(); ++y)
      for (int x = part.x; x < part.right(); ++x) after.bgra[std::size_t(4 * (y * after.width + x))] ^= 0x55u;
  for (const Converter convert : {convert_to_yuv420, convert_to_yuv420_scalar}) {
    Planes planes = planes_of(before, convert);
    ASSERT_NE(planes, planes_of(after, convert));
    for (const PixelBox& part : parts) convert(after, part, pointers_to(planes, after));
    EXPECT_EQ(planes, planes_of(after, convert));
  }
}

TEST(Yuv420, GreyHasNoColour) {
  for (int grey = 0; grey < 256; ++grey) {
    const auto byte = static_cast<std::uint8_t>(grey);
    const Planes planes = planes_of(flat_picture(8, 2, {byte, byte, byte}), convert_to_yuv420);
    EXPECT_EQ(planes.cb[0], 128);
    EXPECT_EQ(planes.cr[0], 128);
  }
  EXPECT_EQ(planes_of(flat_picture(8, 2, {0, 0, 0}), convert_to_yuv420).y[0], 16);
  EXPECT_EQ(planes_of(flat_picture(8, 2, {255, 255, 255}), convert_to_yuv420).y[0], 235);
}

// Widths that leave every possible rest behind the vectors of eight.
TEST(Yuv420, VectorsAndScalarsGiveTheSameBytes) {
  for (const int width : {2, 4, 6, 8, 10, 12, 14, 16, 640, 1918}) {
    const Image image = random_picture(width, 6, unsigned(width));
    EXPECT_EQ(planes_of(image, convert_to_yuv420), planes_of(image, convert_to_yuv420_scalar)) << width;
  }
}

TEST(Yuv420, AlphaIsNotLookedAt) {
  Image opaque = random_picture(32, 4, 3), clear = opaque;
  for (std::size_t i = 3; i < opaque.bgra.size(); i += 4) {
    opaque.bgra[i] = 255;
    clear.bgra[i] = 0;
  }
  EXPECT_EQ(planes_of(opaque, convert_to_yuv420), planes_of(clear, convert_to_yuv420));
}

// Negative control: the measure above must see red and blue exchanged, and a shift by a single code.
TEST(Yuv420, TheErrorMeasureSeesExchangedChannelsAndShifts) {
  const Image image = random_picture(64, 4, 4);
  Image exchanged = image;
  for (std::size_t i = 0; i < exchanged.bgra.size(); i += 4)
    std::swap(exchanged.bgra[i], exchanged.bgra[i + 2]);
  EXPECT_GT(largest_error(exchanged, planes_of(image, convert_to_yuv420)), 10);

  Planes shifted = planes_of(image, convert_to_yuv420);
  for (std::uint8_t& y : shifted.y) ++y;
  EXPECT_GT(largest_error(image, shifted), kRounding);
}

}  // namespace
}  // namespace chainreel
