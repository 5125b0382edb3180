// The one colour that stands for a texture.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>

namespace chainreel {

// Red, green, blue of a PNG's or a JPEG's mean, taken in linear light, where what is transparent counts less;
// nothing where the file is missing or cannot be read. For a child process with limits.
std::optional<std::array<std::uint8_t, 3>> mean_color(const std::string& path);

// The same, in such a child.
std::optional<std::array<std::uint8_t, 3>> read_mean_color(const std::string& path);

}  // namespace chainreel
