#include "draw/film/compose.hpp"

#include <algorithm>
#include <optional>
#include <string>

#include "core/error.hpp"
#include "draw/film/room.hpp"
#include "draw/film/story.hpp"

namespace chainreel {
namespace {

constexpr const char* kFirstToGo[] = {"equation", "torque_label", "legend", "mass_matrix", "scale_bar"};
constexpr double kWidestPlots = 0.62;  // of the page's width
constexpr double kWidePlots = 0.42;    // ... beside a motion that is no slim one, which is what one looks at
constexpr double kSlimMotion = 0.4;    // of its height
constexpr double kKeptBeside = 0.12;   // units of H, of the scene for words and the arrow of gravity
constexpr double kPlotsOfSpare = 0.6;  // ... of the height that a motion leaves, for plots below it
constexpr double kHighestPlots = 0.34;
constexpr double kNarrowMotion = 0.5;  // of its height, or of the page's width
constexpr double kNarrowestPlots = 0.3;  // of the page's width, beside panels
constexpr double kWorthBeside = 1.3;   // times the size below plots: then panels of a motion that is not narrow stand beside them, too
constexpr double kTitleAir = 1.1;      // times the least width of a panel's title, on two lines
constexpr double kFlatMotion = 0.8;      // of the scene's height
constexpr double kWorthwhile = 0.02;   // ... of the width
constexpr double kLeastOfWidth = 0.6;  // pages still narrower keep the words of this one
constexpr double kKeptOfFrame = 0.9;   // of the frame of a plot at text_scale 1, whatever words take
constexpr double kMostForWords = 0.75; // of the width or the height that plots share with the scene
constexpr double kKeptBesideWords = 0.4;  // of the scene's size at text_scale 1
constexpr double kSmallerWords = 0.93;  // from trial to trial
constexpr double kLowPanel = 0.4;      // of the page's height: so low panels take the rows of formulas above them
constexpr double kLargerInGrid = 1.1;  // times the scale, for a plot in the grid of its panels
constexpr double kFrameInGrid = 0.5;   // ... of the area of its frame
constexpr int kRoomTrials = 4;         // each finds most of what is lacking

// The first in the order that the page still shows; null where none is left.
const char* next_to_go(const Scene& page) {
  for (const char* name : kFirstToGo)
    if (std::find(page.draw.begin(), page.draw.end(), name) != page.draw.end()) return name;
  return nullptr;
}

}  // namespace

double least_word(const Video& video) {
  return video.least_text > 0 ? video.least_text : kLeastWordPixels / std::max(video.height, kLeastPagePixels);
}

double text_scale_of_page(const Scene& page) {
  const double aspect = double(page.video.width) / page.video.height;
  const double wanted = page.text_scale * std::clamp(aspect, kLeastOfWidth, 1.0);
  return std::max(wanted, least_word(page.video) / kSmallestText);
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
  ArrowShares arrows;
  bool without_names = false;  // of the legend, for the sake of a plot
};

std::unique_ptr<const Stage> staged(const Scene& page, const Shown& film, const Story& story) {
  return std::make_unique<const Stage>(page, film.runs, film.times, film.fonts, film.clock, film.arrows, !page.plot.empty() || !story.empty());
}

// Rows of formulas above panels that are low; `left_out` counts what had to go.
Composition with_rows_for_panels(Composition low, const Shown& film, const Story& story, const PlotRoom& room) {
  Scene shown = low.stage->page;
  std::vector<std::string> gone;
  for (const char* name : {"equation", "torque_label"}) {
    if (!low.stage->has_cells() || low.view.cells.front().scene.height() >= kLowPanel) break;
    if (std::erase(shown.draw, std::string(name)) == 0) continue;
    gone.push_back(name);
    try {
      auto stage = staged(shown, film, story);
      Layers layers = layers_of(*stage);
      FilmSheet sheet(*stage, layers, story, room);
      FilmView view(*stage, layers, sheet);
      if (!(view.camera.scale > low.view.camera.scale * (1 + kRoundOff))) continue;
      low = {std::move(stage), std::move(layers), std::move(sheet), std::move(view), std::move(low.left_out), std::move(low.given)};
      low.given.insert(low.given.end(), gone.begin(), gone.end());
      gone.clear();
    } catch (const Error& error) {
      if (!tells_of_no_room(error)) throw;
    }
  }
  return low;
}

// Plots that their words leave no frame.
struct CrampedPlots : Error {
  using Error::Error;
};

// On paper pages become as high as they must be.
bool is_cramped(const FilmSheet& sheet, const Scene& page) {
  const double least = least_frame(page.text_scale);
  return !(page.video.least_text > 0) && std::ranges::any_of(sheet.plots, [least](const PlotStrip& plot) { return !(plot.frame().box.height() >= least); });
}

Composition with_readable_words(const Scene& page, const Shown& film, const Story& story,
                                PlotRoom room = {}) {
  Scene shown = page;
  shown.text_scale = text_scale_of_page(page);
  room.without_names = room.without_names || film.without_names;
  const bool is_enlarged = shown.text_scale > page.text_scale;
  std::vector<std::string> left_out;
  while (true) {
    const char* next = next_to_go(shown);
    try {
      auto stage = staged(shown, film, story);
      Layers layers = layers_of(*stage);
      FilmSheet sheet(*stage, layers, story, room);
      if (next == nullptr && is_cramped(sheet, shown))
        throw CrampedPlots(ExitCode::bad_input, (sheet.plots.size() == 1 ? "the plot has" : std::to_string(sheet.plots.size()) + " plots have") +
                                                    std::string(" no room on this page: plot less, lower text_scale, or take a larger or a wider page"), page.place_of("plot"));
      const bool has_room = (!is_enlarged || sheet.sheet.scene.height() >= kLeastScene) && !is_cramped(sheet, shown);
      if (next == nullptr || has_room) {
        FilmView view(*stage, layers, sheet);
        Composition whole{std::move(stage), std::move(layers), std::move(sheet), std::move(view), std::move(left_out), {}};
        return is_enlarged && !(page.video.least_text > 0) ? with_rows_for_panels(std::move(whole), film, story, room) : std::move(whole);
      }
    } catch (const Error& error) {
      if (next == nullptr || !is_enlarged || !tells_of_no_room(error)) throw;
    }
    std::erase(shown.draw, std::string(next));
    left_out.push_back(next);
  }
}

double area_of(const PlotStrip& plot) {
  return plot.frame().box.width() * plot.frame().box.height();
}

// Panels of a narrow motion, beside one another, stand beside their plots where they are no smaller there, those of others where they are much larger, each as
// wide as its motion and its title are.
std::optional<Composition> with_plots_beside_panels(const Scene& page, const Shown& film, const Story& story, const Composition& below) {
  // Panels above a plot are lower, and marks in them no smaller: whether the motion is narrow is seen beside it.
  const auto is_narrower = [](const Composition& one, double part) { return one.view.size_used().x < part * one.view.size_used().y; };
  const bool may_stand = below.stage->has_cells() && page.layout == PageLayout::compare && !below.sheet.plots.empty() && !is_narrow(page) &&
                         !(page.video.least_text > 0);
  if (!may_stand) return std::nullopt;
  try {
    PlotRoom room;
    room.beside_panels = true;
    const Composition first = with_readable_words(page, film, story, room);
    const bool is_slim = is_narrower(below, 2 * kNarrowMotion) && is_narrower(first, kNarrowMotion);
    const double least = (is_slim ? 1 : kWorthBeside) * below.view.camera.scale;
    if (!is_slim && !(first.view.camera.scale >= least)) return std::nullopt;
    const double count = double(first.view.cells.size());
    const double panel = std::max(first.view.size_used().x + kKeptBeside, kTitleAir * first.sheet.narrowest_panel(*first.stage));
    const double spare = first.sheet.sheet.scene.width() - count * panel - (count - 1) * size::kGutter;
    room.beside = std::clamp(kPlotsBeside + spare / first.sheet.sheet.aspect, kNarrowestPlots, kWidestPlots);
    Composition beside = with_readable_words(page, film, story, room);
    // Words go in one order: fewer of them are some of those that go below.
    const bool is_as_good = beside.left_out.size() <= below.left_out.size() && beside.view.camera.scale >= least && lack_of_room(beside).what.empty();
    if (is_as_good) return beside;
  } catch (const Error& error) {
    if (!tells_of_no_room(error)) throw;
  }
  return std::nullopt;
}

// A plot beside a flat motion, which fills the width and leaves its height, is as narrow as can be where the motion is larger for it.
std::optional<Composition> with_narrow_plots(const Scene& page, const Shown& film, const Story& story, const Composition& usual) {
  const Rect& scene = usual.sheet.sheet.scene;
  const Point used = usual.view.size_used();
  if (!usual.sheet.has_plots_beside || used.x < scene.width() - kKeptBeside || used.y > kFlatMotion * scene.height()) return std::nullopt;
  PlotRoom room;
  room.beside = kNarrowestPlots;
  try {
    Composition narrow = with_readable_words(page, film, story, room);
    if (narrow.left_out.size() <= usual.left_out.size() && narrow.view.camera.scale > usual.view.camera.scale && lack_of_room(narrow).what.empty()) return narrow;
  } catch (const Error& error) {
    if (!tells_of_no_room(error)) throw;
  }
  return std::nullopt;
}

bool has_empty_cell(const std::vector<PanelCell>& cells) {
  std::size_t columns = 0;
  for (const PanelCell& cell : cells) columns += cell.scene.y0 == cells.front().scene.y0 ? 1 : 0;
  return cells.size() % columns != 0;
}

// A plot of a grid's panels takes the cell that they would leave empty, or one of a grid in which they are larger for it.
std::optional<Composition> with_plot_in_grid(const Scene& page, const Shown& film, const Story& story, const Composition& below) {
  const int count = int(below.view.cells.size()) + 1;
  const bool may_stand = below.stage->has_cells() && page.layout != PageLayout::compare && below.sheet.plots.size() == 1 && !(page.video.least_text > 0) &&
                         !(page.video.panel_names > 0);
  if (!may_stand) return std::nullopt;
  std::optional<Composition> best;
  double least = (has_empty_cell(below.view.cells) ? 1 : kLargerInGrid) * below.view.camera.scale;
  for (int columns = 2; columns < count; ++columns) {
    if (count % columns != 0) continue;
    PlotRoom room;
    room.columns = columns;
    try {
      Composition inside = with_readable_words(page, film, story, room);
      const bool is_as_good = inside.left_out.size() <= below.left_out.size() && inside.view.camera.scale >= least &&
                              area_of(inside.sheet.plots.front()) >= kFrameInGrid * area_of(below.sheet.plots.front()) && lack_of_room(inside).what.empty();
      if (!is_as_good) continue;
      least = inside.view.camera.scale;
      best.emplace(std::move(inside));
    } catch (const Error& error) {
      if (!tells_of_no_room(error)) throw;
    }
  }
  return best;
}

// Plots beside a narrow motion have the width that it leaves; those below a flat one, on pages that are narrow, of its height. `is_ours`: nobody
// asked for them to stand there.
Composition with_spare_room(const Scene& page, const Shown& film, const Story& story, bool is_ours) {
  Composition usual = with_readable_words(page, film, story);
  if (page.camera.fit) return usual;
  if (std::optional<Composition> beside = with_plots_beside_panels(page, film, story, usual)) return std::move(*beside);
  if (std::optional<Composition> inside = with_plot_in_grid(page, film, story, usual)) return std::move(*inside);
  if (is_ours)
    if (std::optional<Composition> narrow = with_narrow_plots(page, film, story, usual)) return std::move(*narrow);
  const Rect& scene = usual.sheet.sheet.scene;
  PlotRoom room;
  if (usual.sheet.has_plots_beside) {
    const Point used = usual.view.size_used();
    const double spare = scene.width() - used.x - kKeptBeside;
    room.beside = std::min(kPlotsBeside + spare / usual.sheet.sheet.aspect, used.x < kSlimMotion * used.y ? kWidestPlots : kWidePlots);
    return room.beside > kPlotsBeside + kWorthwhile ? with_readable_words(page, film, story, room) : std::move(usual);
  }
  if (!usual.sheet.has_plots_stacked || usual.stage->has_cells()) return usual;
  const double count = double(usual.sheet.plots.size());
  const double high = (scene.y0 - size::kGutter - usual.sheet.plots.back().area().y0 - (count - 1) * size::kGutter) / count;
  const double spare = usual.view.cells.front().scene.height() - usual.view.size_used().y - kKeptBeside;
  room.each = std::min(high + kPlotsOfSpare * spare / count, kHighestPlots / count);
  return room.each > high + kWorthwhile ? with_readable_words(page, film, story, room) : std::move(usual);
}

// By how much the frame of the plot that words have made smallest is smaller than it is with words of their usual size.
double lack_of_frames(const Composition& large, const Composition& usual) {
  double most = 1;
  const std::size_t count = std::min(large.sheet.plots.size(), usual.sheet.plots.size());
  for (std::size_t i = 0; i < count; ++i)
    most = std::max(most, kKeptOfFrame * area_of(usual.sheet.plots[i]) / area_of(large.sheet.plots[i]));
  return most;
}

// The room that gives plots what they lack, as far as the scene has it.
PlotRoom room_for_frames(const Composition& large, double lack) {
  PlotRoom room = large.sheet.plot_room;
  const Rect &frame = large.sheet.plots.front().frame().box, &area = large.sheet.plots.front().area();
  if (large.sheet.has_plots_beside) {
    room.beside = std::min((area.width() + (lack - 1) * frame.width()) / (area.x1 - large.sheet.sheet.scene.x0), kMostForWords);
  } else {
    room.each = area.height() + (lack - 1) * frame.height();
    room.most = kMostForWords;
  }
  return room;
}

Composition with_frames_kept(Composition large, const Composition& usual, const Scene& page, const Shown& film, const Story& story) {
  double lack = lack_of_frames(large, usual);
  for (int trial = 0; trial < kRoomTrials && lack > 1 + kRoundOff; ++trial) {
    Composition roomier = with_readable_words(page, film, story, room_for_frames(large, lack));
    const double less = lack_of_frames(roomier, usual);
    if (!(less < lack)) break;
    lack = less;
    large = std::move(roomier);
  }
  return large;
}

bool has_large_words(const Scene& page) {
  return page.text_scale > 1 && !(page.video.least_text > 0);
}

// Where words are larger than usual the scene yields the room that they take, not the plots; they are as large as leaves it enough.
Composition with_wide_plots(const Scene& page, const Shown& film, const Story& story, bool is_ours = false) {
  if (!has_large_words(page)) return with_spare_room(page, film, story, is_ours);
  try {
    Composition asked = with_spare_room(page, film, story, is_ours);
    if (asked.sheet.plots.empty()) return asked;
  } catch (const CrampedPlots&) {
    // Smaller words may leave them room.
  }
  Scene words = page;
  words.text_scale = 1;
  Composition usual = with_spare_room(words, film, story, is_ours);
  for (double text_scale = page.text_scale; text_scale > 1; text_scale *= kSmallerWords) {
    words.text_scale = text_scale;
    try {
      Composition large = with_frames_kept(with_spare_room(words, film, story, is_ours), usual, words, film, story);
      if (lack_of_frames(large, usual) > 1 + kRoundOff || large.view.camera.scale < kKeptBesideWords * usual.view.camera.scale) continue;
      if (text_scale < page.text_scale) large.held_text_scale = text_scale;
      return large;
    } catch (const Error& error) {
      if (!tells_of_no_room(error)) throw;
    }
  }
  usual.held_text_scale = 1;
  return usual;
}

// What is shown of a page: its layout, and what is plotted where it names nothing.
struct Layout {
  Scene page;
  Story story;
  bool is_ours = false;  // where the plot stands
  bool without_names = false;
};

// Whether what happens can be told by its name below each scene, as small as can be read: beside a plot the row is narrower.
bool notes_have_room(const Composition& composition) {
  const Stage& stage = *composition.stage;
  const TextStyle style{Face::label, least_word(stage.page.video), stage.theme.ink, Align::left};
  for (std::size_t i = 0; i < composition.view.cells.size(); ++i)
    for (const EventEntry& event : stage.motions[i].scene().events)
      if (lay_out_text(stage.fonts, event.title(), style).advance > composition.view.cells[i].note.width()) return false;
  return true;
}

// With a plot where the motion keeps its size. `plain`: without one; it becomes what is shown.
Layout with_story(const Scene& page, const Shown& film, Composition& plain) {
  const bool is_comparison = plain.stage->is_comparison();
  const bool is_ghost = plain.stage->is_ghost();
  const bool is_of_methods = differ_in_method_alone(*plain.stage);
  // A place for plots that the page does not name.
  const bool is_asked = !is_comparison && page.plot.empty() && (page.layout == PageLayout::scene_right || page.layout == PageLayout::scene_below);
  const bool may_tell = is_comparison ? page.plot.empty() && (is_ghost || is_of_methods || is_narrow(page))
                                      : page.plot.size() <= 1 && (page.layout == PageLayout::automatic || is_asked);
  if (!may_tell) return {page, {}};
  const Story story = page.plot.empty() ? story_of(*plain.stage, is_asked) : Story();
  if (page.plot.empty() && story.empty()) return {page, {}};
  const bool leaves_half = !is_comparison && is_narrow(page) && plain.view.size_used().x < kNarrowMotion * plain.sheet.sheet.scene.width();
  const double kept = is_asked                     ? 0
                      : is_of_methods                ? kLeastKeptOfMethods
                      : is_comparison && !is_ghost ? kLeastKeptOfPanels
                      : leaves_half                ? kLeastKeptOfNarrow
                      : is_narrow(page)            ? kLeastKeptStacked
                                                   : kLeastKept;
  // Where plots of a comparison stand FilmSheet knows.
  const std::vector<PageLayout> layouts = is_comparison || is_asked ? std::vector{page.layout} : std::vector{PageLayout::scene_right, PageLayout::scene_below};
  // Names of the legend go before the plot.
  struct Trial {
    PageLayout layout;
    bool without_names;
  };
  std::vector<Trial> trials;
  for (const bool without_names : {false, true})
    for (const PageLayout layout : layouts) trials.push_back({layout, without_names});
  for (const auto& [layout, without_names] : trials) {
    if (without_names && !is_narrow(page)) break;
    Scene with_plot = page;
    with_plot.layout = layout;
    Shown shown = film;
    shown.without_names = without_names;
    try {
      Composition told = with_wide_plots(with_plot, shown, story, true);
      const double least = kept * plain.view.camera.scale;
      // What large words take from the scene so that the plot keeps its frame is no reason to leave the plot out.
      const bool keeps_size = told.view.camera.scale >= least ||
                              (has_large_words(page) && with_spare_room(with_plot, shown, story, true).view.camera.scale >= least);
      // Words go in one order: fewer of them are some of those that go else.
      if (told.left_out.size() > plain.left_out.size() || !keeps_size) continue;
      if (page.video.least_text > 0 && page.plot.empty() && !lack_of_room(told).what.empty()) continue;
      if (page.plot.empty() && !notes_have_room(told)) continue;
      plain = std::move(told);
      return {with_plot, story, true, without_names};
    } catch (const Error& error) {
      if (!tells_of_no_room(error)) throw;
    }
  }
  return {page, {}};
}

}  // namespace

Composition compose(const Scene& page, const std::vector<PanelRun>& runs, const std::vector<double>& times, const Fonts& fonts,
                    const FilmClock& clock) {
  Shown film{runs, times, fonts, clock, {}, false};
  Composition composition = with_wide_plots(page, film, {});
  const Layout layout = with_story(page, film, composition);
  const ArrowShares& shares = composition.view.arrows;
  const auto told = [](Composition whole) {
    whole.left_out.insert(whole.left_out.end(), whole.given.begin(), whole.given.end());
    return whole;
  };
  if (std::all_of(shares.begin(), shares.end(), [](const auto& one) { return one.second == 1; })) return told(std::move(composition));
  // The scale that is printed is that of the arrows as they are drawn.
  film.arrows = shares;
  film.without_names = layout.without_names;
  return told(with_wide_plots(layout.page, film, layout.story, layout.is_ours));
}

}  // namespace chainreel
