// The image of a texture: read, looked up, made coarser.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace chainreel {

using ColorBytes = std::array<std::uint8_t, 4>;  // red, green, blue, opacity

// What lies beyond an image's edges.
enum class TextureWrap { repeat, mirror, clamp };

struct Texture {
  int width = 0, height = 0;
  std::vector<ColorBytes> texels;  // row by row from the upper left corner
  std::array<TextureWrap, 2> wrap{TextureWrap::repeat, TextureWrap::repeat};

  const ColorBytes& texel(int x, int y) const { return texels[std::size_t(y) * std::size_t(width) + std::size_t(x)]; }
  // The texel at a place that may lie beyond the edges.
  const ColorBytes& beyond(int x, int y) const;
  // Linear between the middles of texels, whose places are whole numbers; 0 to 255.
  std::array<float, 4> at(float x, float y) const;

  // Over one colour: opaque.
  void put_over(const ColorBytes& color);
  // As fine in both directions, or one texel; means are taken in linear light, where what is transparent counts less.
  Texture halved() const;
};

inline constexpr int kFinestTexture = 2048;  // texels along a side: finer images are halved as they are read

// A PNG or a JPEG; nothing where the file is missing or cannot be read. For a child process with limits.
std::optional<Texture> read_texture(const std::string& path);

// Red, green, blue of the mean in linear light, where what is transparent counts less; absent where all is.
std::optional<std::array<std::uint8_t, 3>> mean_color(const Texture& texture);

// The mean of a file's image, read in such a child.
std::optional<std::array<std::uint8_t, 3>> read_mean_color(const std::string& path);

}  // namespace chainreel
