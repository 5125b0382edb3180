// A picture of every kind that the program draws, at any look: what holds for all of them is tested over this
// list.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "picture/picture.hpp"
#include "picture/text.hpp"

namespace chainreel::test {

struct PictureLook {
  std::string theme = "light";
  int width = 1920, height = 1080;
  double text_scale = 1;
};

struct AnyPicture {
  std::string name;
  std::function<Picture(const PictureLook&, const Fonts&)> draw;
};

// Frames of every scene of assets/scenes, of comparisons, with plots, with all layers; poses, figures of
// ellipses, charts.
const std::vector<AnyPicture>& all_pictures();

}  // namespace chainreel::test
