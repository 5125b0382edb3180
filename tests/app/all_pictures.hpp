// A picture of every kind that the program draws, at any look: what holds for all of them is tested over this
// list.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "draw/film/film.hpp"
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
  // Shows the film of which `draw` takes a frame; none where the picture is no film's.
  std::function<void(const PictureLook&, const Fonts&, const std::function<void(const Film&)>&)> show_film{};
};

// Frames of every scene of assets/scenes, of comparisons, with plots, with all layers; poses, figures of
// ellipses, charts.
const std::vector<AnyPicture>& all_pictures();

}  // namespace chainreel::test
