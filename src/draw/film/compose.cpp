#include "draw/film/compose.hpp"

#include <algorithm>

#include "core/error.hpp"
#include "draw/film/story.hpp"

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

namespace {

// A page that cannot hold what is asked for is bad input; a renderer, a file or memory that fails is not about room.
bool tells_of_no_room(const Error& error) {
  return error.code() == ExitCode::bad_input;
}

// What all pages of a film are made from.
struct Shown {
  const std::vector<PanelRun>& runs;
  const std::vector<double>& times;
  const Fonts& fonts;
  const FilmClock& clock;
};

Composition with_readable_words(const Scene& page, const Shown& film, const std::vector<PlotCurves>& story) {
  Scene shown = page;
  shown.text_scale = text_scale_of_page(page);
  const bool is_enlarged = shown.text_scale > page.text_scale;
  std::vector<std::string> left_out;
  while (true) {
    const char* next = is_enlarged ? next_to_go(shown) : nullptr;
    try {
      auto stage = std::make_unique<const Stage>(shown, film.runs, film.times, film.fonts, film.clock);
      Layers layers = layers_of(*stage);
      FilmSheet sheet(*stage, layers, story);
      if (next == nullptr || sheet.sheet.scene.height() >= kLeastScene) {
        FilmView view(*stage, layers, sheet);
        return {std::move(stage), std::move(layers), std::move(sheet), std::move(view), std::move(left_out)};
      }
    } catch (const Error& error) {
      if (next == nullptr || !tells_of_no_room(error)) throw;
    }
    std::erase(shown.draw, std::string(next));
    left_out.push_back(next);
  }
}

}  // namespace

Composition compose(const Scene& page, const std::vector<PanelRun>& runs, const std::vector<double>& times, const Fonts& fonts,
                    const FilmClock& clock) {
  Composition plain = with_readable_words(page, {runs, times, fonts, clock}, {});
  if (page.layout != PageLayout::automatic || page.plot.size() > 1) return plain;
  const std::vector<PlotCurves> story = page.plot.empty() ? story_of(*plain.stage) : std::vector<PlotCurves>();
  if (page.plot.empty() && story.empty()) return plain;
  for (const PageLayout layout : {PageLayout::scene_right, PageLayout::scene_below}) {
    Scene with_plot = page;
    with_plot.layout = layout;
    try {
      Composition told = with_readable_words(with_plot, {runs, times, fonts, clock}, story);
      if (told.left_out == plain.left_out && told.view.camera.scale >= kLeastKept * plain.view.camera.scale) return told;
    } catch (const Error& error) {
      if (!tells_of_no_room(error)) throw;
    }
  }
  return plain;
}

}  // namespace chainreel
