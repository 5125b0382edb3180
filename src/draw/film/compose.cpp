#include "draw/film/compose.hpp"

#include <algorithm>

#include "core/error.hpp"

namespace chainreel {
namespace {

constexpr const char* kFirstToGo[] = {"equation", "torque_label", "legend", "mass_matrix", "scale_bar"};
constexpr double kLeastOfWidth = 0.6;  // pages still narrower keep the words of this one

// The first in the order that the page still shows; null where none is left.
const char* next_to_go(const Scene& page) {
  for (const char* name : kFirstToGo)
    if (std::find(page.draw.begin(), page.draw.end(), name) != page.draw.end()) return name;
  return nullptr;
}

}  // namespace

double text_scale_of_page(const Scene& page) {
  const double aspect = double(page.video.width) / page.video.height;
  const double wanted = page.text_scale * std::clamp(aspect, kLeastOfWidth, 1.0);
  return std::max(wanted, kLeastWordPixels / (kSmallestText * std::max(page.video.height, kLeastPagePixels)));
}

Composition compose(const Scene& page, const std::vector<PanelRun>& runs, const std::vector<double>& times, const Fonts& fonts,
                    const FilmClock& clock) {
  Scene shown = page;
  shown.text_scale = text_scale_of_page(page);
  const bool is_enlarged = shown.text_scale > page.text_scale;
  std::vector<std::string> left_out;
  while (true) {
    const char* next = is_enlarged ? next_to_go(shown) : nullptr;
    try {
      auto stage = std::make_unique<const Stage>(shown, runs, times, fonts, clock);
      Layers layers = layers_of(*stage);
      FilmSheet sheet(*stage, layers);
      if (next == nullptr || sheet.sheet.scene.height() >= kLeastScene)
        return {std::move(stage), std::move(layers), std::move(sheet), std::move(left_out)};
    } catch (const Error&) {
      if (next == nullptr) throw;
    }
    std::erase(shown.draw, std::string(next));
    left_out.push_back(next);
  }
}

}  // namespace chainreel
