// A house style: colours, line widths, faces and a logo that scenes share.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/image.hpp"
#include "core/names.hpp"

namespace chainreel {

enum class PageCorner { top_right, top_left, bottom_right, bottom_left };
std::span<const Name> names_of(PageCorner);

struct Logo {
  std::string file;  // as found from the working folder
  PageCorner corner = PageCorner::top_right;
  double height = 0.06;  // units of H
  std::shared_ptr<const Image> image;  // read where pictures are drawn; not a key
  std::string sha256;                  // of the file's bytes; not a key
};

// Families by name, "" for the program's own. No other face is ever taken in their place.
struct StyleFonts {
  std::string label;
  std::string bold;  // "": the bold face of `label`
  std::string math;

  bool empty() const { return label.empty() && bold.empty() && math.empty(); }
  friend bool operator==(const StyleFonts&, const StyleFonts&) = default;
};

// 0xRRGGBB by the name of what it colours; `links` and `curves` have several.
using StyleColors = std::map<std::string, std::vector<std::uint32_t>>;

struct Style {
  StyleColors light, dark;  // of the theme of that name
  double lines = 1;         // times the widths of outlines, curves, ellipses, trails and the shafts of arrows
  double trail = 1;         // s that trails go back
  StyleFonts fonts;
  std::optional<Logo> logo;

  bool empty() const { return light.empty() && dark.empty() && lines == 1 && trail == 1 && fonts.empty() && !logo; }
};

// Names of single colours, and how many `links` and `curves` there may be.
inline constexpr std::array kStyleColors = {
    Name{"background", "of the page"},      Name{"ink", "words, outlines, axes"},
    Name{"muted", "secondary words"},       Name{"base", "ground, fixed parts"},
    Name{"rule", "frames of panels"},       Name{"grid", "of plots"},
    Name{"ellipse", "the effective mass"},  Name{"torque", "torques of joints"},
    Name{"velocity", "arrows of velocity"}, Name{"force", "gravity and other forces"},
    Name{"constraint", "reactions"},        Name{"side_a", "the first of two variants; of more the one behind those of `curves`"},
    Name{"side_b", "the second of two variants; of more the one behind side_a"}};
inline constexpr std::size_t kMostLinkColors = 4, kMostCurveColors = 3;

}  // namespace chainreel
