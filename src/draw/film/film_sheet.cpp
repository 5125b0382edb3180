#include "draw/film/film_sheet.hpp"

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "core/format.hpp"
#include "draw/film/exact_curve.hpp"
#include "draw/page/panel.hpp"
#include "draw/page/wrapped_words.hpp"
#include "picture/formula_words.hpp"
#include "picture/thin_points.hpp"
#include "sim/audit.hpp"
#include "sim/doubts.hpp"

namespace chainreel {
namespace {

constexpr double kPlotOfComparison = 0.28;  // of the page's height, for a plot's frame: there the plot is the message
constexpr double kMostOfComparison = 0.52;  // ... of what panels share with it, with its words
constexpr double kPlotInWords = 9.5;  // heights of the smallest words, with the plot's own
constexpr double kTitleRow = 1.55;  // of the em: a panel's title or note with the air around it

SheetText words_of(const Stage& stage, const Layers& layers) {
  SheetText text;
  if (is_transparent(stage.page)) {  // nothing above or below the scene
    text.with_panel_titles = stage.page.video.panel_names > 0 && stage.has_cells();
    return text;
  }
  text.title_place = stage.page.place_of("title");
  for (const auto& layer : layers) layer->write(text);
  if (const auto& logo = stage.page.style.logo; logo && logo->image)
    text.logo = PageLogo{logo->image, logo->corner, logo->height, stage.page.video.height};
  std::stable_sort(text.scales.begin(), text.scales.end(),
                   [](const ScaleEntry& a, const ScaleEntry& b) { return a.order < b.order; });
  return text;
}

bool tells_no_scale(const ScaleEntry& entry) {
  return entry.mark == ScaleEntry::Mark::center_of_mass || entry.order > kAfterScales;
}

bool has_notes(const Stage& stage) {
  return !is_transparent(stage.page) &&
         std::any_of(stage.motions.begin(), stage.motions.end(),
                     [](const StagedRun& motion) { return motion.may_have_notes(); });
}

// Leaves out what is no number, which else is a gap.
void leave_out_unknown(std::vector<double>& t, std::vector<double>& y) {
  std::vector<double> times, values;
  for (std::size_t k = 0; k < y.size(); ++k) {
    if (std::isnan(y[k])) continue;
    times.push_back(t[k]);
    values.push_back(y[k]);
  }
  t = std::move(times);
  y = std::move(values);
}

constexpr double kSeenStep = 0.015;  // of the clip: dots at the ends of such steps stand apart

// J, where it is more than is taken for a motion's own. At frames, too: that between the ends of long steps is what curves show.
double energy_off(const StagedRun& motion) {
  const Trajectory& run = motion.trajectory();
  if (!motion.simulation() || !run.energy_at_steps || motion.is_wild()) return 0;
  const Audit audit = audit_of(*motion.simulation(), run);
  const bool is_off = audit.largest_error > kDoubtfulEnergy * audit.energy_moved || doubt_of_energy(*motion.simulation(), run, audit, {});
  return is_off ? std::max(audit.largest_error, run.energy_at_steps->largest_error) : 0;
}

constexpr std::size_t kVeryManySamples = 16384;
constexpr double kFinerColumns = 2;  // than those of a curve as wide as the page

// Of so many samples those that a plot of the page can show, as long as only one run's curves are there in full.
void keep_what_shows(const Scene& page, std::vector<double>& t, PlotCurves& plot) {
  const auto is_whole = [&](const PlotCurve& curve) { return curve.y.size() == t.size() && std::ranges::all_of(curve.y, [](double y) { return std::isfinite(y); }); };
  if (t.size() <= kVeryManySamples || !std::ranges::all_of(plot.curves, is_whole)) return;
  const double pixel = 1.0 / page.video.height, scale = kFinerColumns * page.video.width * pixel / t.back();
  std::vector<bool> shows(t.size());
  std::vector<Point> points(t.size());
  for (const PlotCurve& curve : plot.curves) {
    for (std::size_t k = 0; k < t.size(); ++k) points[k] = {scale * t[k], curve.y[k]};
    for (const std::size_t k : column_points(points, pixel)) shows[k] = true;
  }
  const auto kept_of = [&](const std::vector<double>& all) {
    std::vector<double> kept;
    for (std::size_t k = 0; k < all.size(); ++k)
      if (shows[k]) kept.push_back(all[k]);
    return kept;
  };
  for (PlotCurve& curve : plot.curves) curve.y = kept_of(curve.y);
  t = kept_of(t);
}

// What the plots of the page show of a run; its simulation must be there. The work, and so what is wrong with the energy, is known
// at its samples alone.
StripRun strip_run(const Scene& page, const StagedRun& motion, const std::vector<PlotCurves>& story) {
  const Trajectory& run = motion.curve_run();
  StripRun strip{motion.title(), motion.is_wild(), {}, story};
  strip.accurate_until = motion.accurate_until();
  strip.change_points = motion.change_points();
  if (const Simulation* simulation = motion.simulation()) {
    if (simulation->method && simulation->step > 0) strip.steps = simulation->method->title + ", " + format_shortest(1000 * simulation->step) + "\u2009ms";
    // Of higher order curves bend as the motion does, and steps are not seen.
    if (simulation->method && simulation->method->order == 1 && simulation->step >= kSeenStep * run.t.back()) {
      strip.step = simulation->step;
      strip.breaks = simulation->torque->breaks(simulation->duration);
      std::ranges::sort(strip.breaks);
    }
  }
  if (story.empty() && motion.simulation()) strip.plots = plot_curves(*motion.simulation(), run, motion.curve_samples());
  if (std::ranges::any_of(strip.plots, [](const PlotCurves& plot) { return plot.quantity == PlotQuantity::energy; })) strip.energy_off = energy_off(motion);
  strip.times.assign(strip.plots.size(), std::vector<double>(run.t.begin(), run.t.begin() + motion.curve_samples()));
  for (std::size_t i = 0; i < strip.plots.size(); ++i)
    if (strip.plots[i].quantity == PlotQuantity::energy_error && run.t.size() > motion.trajectory().t.size())
      leave_out_unknown(strip.times[i], strip.plots[i].curves[0].y);
  for (std::size_t i = 0; i < strip.plots.size(); ++i) keep_what_shows(page, strip.times[i], strip.plots[i]);
  return strip;
}

constexpr double kNamesPad = 0.35;     // likewise, at both sides: a sheet's cells have no margin
constexpr double kSmallerNames = 0.75;  // of Video::panel_names: smaller they are cut
constexpr int kNameLines = 3;           // then they are cut
constexpr int kTitleLines = 2;          // of a film: more would be a text
constexpr double kMostOfNames = 0.32;   // of a sheet's cell: the rest is for what they name

double full_title_size(const Scene& page) {
  return page.video.panel_names > 0 ? page.video.panel_names : scaled(size::kSymbol, page.text_scale);
}

double least_title_size(const Scene& page) {
  const double names = page.video.panel_names;
  return names > 0 ? kSmallerNames * names : std::min(full_title_size(page), scaled(kSmallestText, page.text_scale));
}

// How many lines words take that were laid out within a width.
int lines_of(const TextLine& words, double size) {
  double lowest = 0;
  for (const GlyphRun& run : words.runs) lowest = std::min(lowest, run.origin.y);
  return 1 + int(std::lround(-lowest / (kLeading * size)));
}

double height_of_titles(int lines, double size) {
  return (kTitleRow + (lines - 1) * kLeading) * size;
}

// The largest size at which all titles have room on so many lines within the width, in a row so high.
struct TitleFit {
  double size = 0;
  int lines = 1;
};
std::optional<TitleFit> fit_titles(const Stage& stage, double width, int most_lines, double most_height) {
  constexpr double kSmaller = 0.96;  // from trial to trial
  const double least = least_title_size(stage.page);
  for (double size = full_title_size(stage.page);; size = std::max(least, kSmaller * size)) {
    int lines = 1;
    bool fits = true;
    for (const StagedRun& motion : stage.motions) {
      const TextLine title = lay_out_within(stage.fonts, motion.title(), {Face::label_bold, size, stage.theme.ink}, width);
      lines = std::max(lines, lines_of(title, size));
      fits = fits && title.box.width() <= width + kRoundOff;
    }
    if (fits && lines <= most_lines && height_of_titles(lines, size) <= most_height + kRoundOff) return TitleFit{size, lines};
    if (!(size > least)) return std::nullopt;
  }
}

// The size at which every panel's title fits, if it is not too small to read.
double title_size(const Stage& stage, const std::vector<PanelCell>& cells) {
  const double names = stage.page.video.panel_names, full = full_title_size(stage.page);
  double common = full;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const TextLine line =
        lay_out_words(stage.fonts, stage.motions[i].title(), {Face::label_bold, full, stage.theme.ink});
    if (line.advance > 0) common = std::min(common, full * (cells[i].title.width() - 2 * kNamesPad * names) / line.advance);
  }
  const double least = least_title_size(stage.page);
  if (!(common < least)) return common;
  // On several lines, where the row has room for them.
  const Rect& row = cells.front().title;
  const auto fit = fit_titles(stage, row.width() - 2 * kNamesPad * names, kNameLines, row.height());
  return fit ? fit->size : least;
}

// What the names of a sheet's panels take above panels that stand side by side, where they have least width: one line unless all have room on more.
double row_of_names(const Stage& stage, const Rect& scene) {
  const double full = full_title_size(stage.page), one = kTitleRow * full;
  const auto count = double(stage.motions.size());
  const double width = (scene.width() - (count - 1) * size::kGutter) / count - 2 * kNamesPad * full;
  const auto fit = fit_titles(stage, width, kNameLines, kMostOfNames * scene.height());
  return fit ? std::max(one, height_of_titles(fit->lines, fit->size)) : one;
}

// Whoever wrote a title is told that it is too long; one that says what a panel differs in was made up, at first or when the
// film was made whose words these are.
bool is_made_up(const StagedRun& motion) {
  return !motion.scene().places.contains("title") || motion.title().find(" = ") != std::string::npos;
}

// One that is too long at the smallest size says its beginning and its end, where what differs stands; or nothing.
TextLine abbreviated(const Fonts& fonts, const std::string& title, const TextStyle& style, double width) {
  constexpr std::size_t kLeastKept = 6;  // characters
  const std::u32string letters = decode_utf8(in_plain_words(title));
  for (std::size_t kept = letters.size(); kept-- > kLeastKept;) {
    const std::u32string shorter = letters.substr(0, kept / 2) + U"\u2026" + letters.substr(letters.size() - (kept - kept / 2));
    TextLine line = lay_out_text(fonts, encode_utf8(shorter), style);
    if (line.advance <= width + kRoundOff) return line;
  }
  return {};
}

// What is plotted: what the page names, else the story.
std::vector<StripData> data_of_plots(const Stage& stage, const Story& story, bool has_panel_titles) {
  const std::size_t count = story.empty() ? stage.page.plot.size() : story.front().size();
  std::vector<StripData> data;
  if (count == 0) return data;
  std::vector<StripRun> runs;
  double end = stage.times.back();
  for (std::size_t i = 0; i < stage.motions.size(); ++i) {
    const StagedRun& motion = stage.motions[i];
    runs.push_back(strip_run(stage.page, motion, story.empty() ? std::vector<PlotCurves>() : story[i]));
    runs.back().is_named_by_colour = has_panel_titles && motion.variant().has_value();
    if (const int samples = motion.curve_samples(); samples > 0) end = std::max(end, motion.curve_run().t[std::size_t(samples) - 1]);
  }
  const std::optional<StripRun> exact = story.empty() ? exact_run(stage) : std::nullopt;
  for (std::size_t i = 0; i < count; ++i) {
    data.push_back(strip_data(runs, i, end, stage.theme));
    if (exact) add_exact(data.back(), *exact, i, stage.theme);
    const auto has_value = [](const StripCurve& curve) { return std::ranges::any_of(curve.points, [](const Point& p) { return std::isfinite(p.y); }); };
    if (story.empty() && !data.back().has_poles && std::ranges::none_of(data.back().curves, has_value))
      throw Error(ExitCode::bad_input, "'" + stage.page.plot[i].value + "' is not finite at any instant: there is nothing to plot", stage.page.plot[i].place);
    const auto is_above_zero = [](const StripCurve& curve) { return std::ranges::any_of(curve.points, [](const Point& p) { return p.y > 0; }); };
    if (data.back().is_log && std::ranges::none_of(data.back().curves, is_above_zero))
      throw Error(ExitCode::bad_input, "'" + stage.page.plot[i].value + "' is never above zero, which `scale: log` has no place for: leave the scale out",
                  stage.page.plot[i].place);
  }
  return data;
}

bool has_time_alone_below(const SheetText& text) {
  return !text.longest_time.empty() && !(text.beside_time > 0) && text.bar.empty() && text.legend.empty() && text.scales.empty() &&
         !(text.logo && !is_at_top(text.logo->corner));
}

}  // namespace

FilmSheet::FilmSheet(const Stage& stage, const Layers& layers, const Story& story, const PlotRoom& room_given) : plot_room(room_given) {
  const Scene& page = stage.page;
  SheetText text = words_of(stage, layers);
  if (plot_room.without_names) std::erase_if(text.scales, tells_no_scale);
  const double aspect = double(page.video.width) / page.video.height;
  has_panel_titles = text.with_panel_titles && stage.has_cells();
  const std::vector<StripData> data = is_transparent(page) ? std::vector<StripData>() : data_of_plots(stage, story, has_panel_titles);
  const auto lay_out = [&](const SheetText& words) {
    sheet = lay_out_sheet(words, aspect, page.text_scale, stage.theme, stage.fonts);
    if (!data.empty()) lay_out_plots(stage, data);
  };
  SheetText without_time = text;
  without_time.longest_time.clear();
  if (!data.empty() && has_time_alone_below(text)) lay_out(without_time);
  if (!put_time_beside_numbers(stage, text.longest_time)) lay_out(text);
  if (has_panel_titles) rows.title = page.video.panel_names > 0 ? row_of_names(stage, sheet.scene) : kTitleRow * full_title_size(page);
  if (text.with_panel_titles && stage.is_ghost()) {
    key.emplace(stage, sheet.scene.width());
    rows.title = key->height();
  }
  if (has_notes(stage)) rows.note = ((is_narrow(page) || (has_plots_beside && stage.has_cells())) && !stage.is_ghost() ? 2 : 1) * kTitleRow * scaled(size::kAxis, page.text_scale);
}

// On paper, where the page is as high as it must be.
double least_plot(const Scene& page) {
  return page.video.least_text > 0 ? kPlotInWords * scaled(kSmallestText, page.text_scale) : 0;
}

// One plot below the scene, more beside it, unless the layout says otherwise; below several panels, or beside those of a narrow motion. What the scene
// did not ask for stands beside runs that lie over one another.
void FilmSheet::lay_out_plots(const Stage& stage, std::vector<StripData> data) {
  plots.clear();
  const Scene& page = stage.page;
  const int count = int(data.size());
  const bool right = stage.is_ghost()        ? page.plot.empty()
                     : stage.is_comparison() ? plot_room.beside_panels
                                             : page.layout != PageLayout::scene_below && (count > 1 || page.layout == PageLayout::scene_right);
  const PlotPlace place = is_narrow(page) ? PlotPlace::stacked : right ? PlotPlace::right : PlotPlace::below;
  std::vector<double> shares;
  if (!(page.video.least_text > 0))  // where each has a least height
    for (const StripData& one : data) shares.push_back(share_of_height(one));
  const PlotStyle style{&stage.fonts, &stage.theme, page.text_scale, 1.0 / page.video.height};
  if (plot_room.columns > 0) {
    const Rect cell = panel_cells(sheet.scene, int(stage.motions.size()) + 1, plot_room.columns, {}).back().scene;
    const PlotAreas areas = plot_areas(cell, count, PlotPlace::right, 0, page.text_scale, 1, 0, shares);
    for (std::size_t i = 0; i < areas.plots.size(); ++i) plots.emplace_back(std::move(data[i]), areas.plots[i], style);
    return align_plots();
  }
  const PlotAreas areas = plot_areas(sheet.scene, count, place,
                                     stage.is_comparison() ? kPlotOfComparison + height_around_frame(style) : 0, page.text_scale, plot_room.beside,
                                     std::max(least_plot(page), plot_room.each), shares,
                                     plot_room.most > 0 ? plot_room.most : stage.is_comparison() && place == PlotPlace::below ? kMostOfComparison : 0);
  has_plots_beside = place == PlotPlace::right;
  has_plots_stacked = place == PlotPlace::stacked && !areas.plots.empty();
  sheet.scene = areas.scene;
  for (std::size_t i = 0; i < areas.plots.size(); ++i)
    plots.emplace_back(std::move(data[i]), areas.plots[i], style);
  if (place != PlotPlace::below) align_plots();
}

void FilmSheet::align_plots() {
  double x0 = 0, x1 = sheet.aspect;
  for (const PlotStrip& plot : plots) {
    x0 = std::max(x0, plot.frame().box.x0);
    x1 = std::min(x1, plot.frame().box.x1);
  }
  for (PlotStrip& plot : plots) plot.narrow_to(x0, x1);
}

// A row of its own would take from panels what stands empty beside the numbers of a plot as wide as the page.
bool FilmSheet::put_time_beside_numbers(const Stage& stage, const std::string& longest_time) {
  constexpr double kMostOfFrame = 0.08;  // that it takes of the plot's width
  if (plots.empty() || has_plots_beside || plot_room.columns > 0 || (plots.size() > 1 && !has_plots_stacked)) return false;
  const double em = scaled(size::kAxis, stage.page.text_scale), width = lay_out_text(stage.fonts, longest_time, {Face::label, em}).advance;
  const Point numbers = plots.back().end_of_numbers();
  const double taken = std::max(0.0, numbers.x + em - (sheet.scene.x1 - width));
  if (taken > kMostOfFrame * plots.back().frame().box.width()) return false;
  for (PlotStrip& plot : plots) plot.narrow_to(plot.frame().box.x0, plot.frame().box.x1 - taken);
  sheet.time_anchor = sheet.time_left = {sheet.scene.x1, numbers.y};
  return true;
}

double FilmSheet::widest_title(const Stage& stage) const {
  double widest = 0;
  if (!has_panel_titles) return widest;
  const TextStyle style{Face::label_bold, scaled(kSmallestText, stage.page.text_scale), stage.theme.ink};
  for (const StagedRun& motion : stage.motions)
    widest = std::max(widest, lay_out_words(stage.fonts, motion.title(), style).advance);
  return widest;
}

double FilmSheet::narrowest_panel(const Stage& stage) const {
  constexpr double kNarrower = 0.97;  // from trial to trial
  const double whole = widest_title(stage);
  double width = whole;
  while (kNarrower * width > whole / kTitleLines && fit_titles(stage, kNarrower * width, kTitleLines, HUGE_VAL)) width *= kNarrower;
  if (!has_notes(stage)) return width;
  const TextStyle style{Face::label, scaled(kSmallestText, stage.page.text_scale), stage.theme.ink, Align::left};
  return std::max(width, lay_out_text(stage.fonts, kLeftThePicture + time_text(stage.latest_time()) + ",", style).advance);
}

std::optional<double> FilmSheet::row_of_titles(const Stage& stage, double width) const {
  if (!has_panel_titles || widest_title(stage) <= width) return rows.title;
  const auto fit = fit_titles(stage, width, kTitleLines, HUGE_VAL);
  if (!fit) return std::nullopt;
  return std::max(rows.title, height_of_titles(fit->lines, fit->size));
}

std::vector<PlacedText> FilmSheet::panel_titles(const Stage& stage, const std::vector<PanelCell>& cells) const {
  std::vector<PlacedText> titles;
  if (!has_panel_titles) return titles;
  const double text_size = title_size(stage, cells);
  const double pad = kNamesPad * stage.page.video.panel_names;
  const auto style_of = [&](std::size_t i) {
    const auto& variant = stage.motions[i].variant();
    return TextStyle{Face::label_bold, text_size, variant ? variant->color : stage.theme.ink};
  };
  std::vector<TextLine> wrapped;
  for (std::size_t i = 0; i < cells.size(); ++i)
    wrapped.push_back(lay_out_within(stage.fonts, stage.motions[i].title(), style_of(i), cells[i].title.width() - 2 * pad));
  // All begin at the same height, with as many lines as one takes.
  const int room = 1 + int((cells.front().title.height() - kTitleRow * text_size + kRoundOff) / (kLeading * text_size));
  int lines = 1;
  for (std::size_t i = 0; i < cells.size() && room > 1; ++i)
    if (const int taken = lines_of(wrapped[i], text_size); taken <= room) lines = std::max(lines, taken);
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const Rect row{cells[i].title.x0 + pad, cells[i].title.y0, cells[i].title.x1 - pad, cells[i].title.y1};
    const TextStyle style = style_of(i);
    const std::string title = stage.motions[i].title();
    TextLine line = lay_out_words(stage.fonts, title, style);
    const bool has_room_on_lines = lines_of(wrapped[i], text_size) <= lines && wrapped[i].box.width() <= row.width() + kRoundOff;
    if (line.advance > row.width() + kRoundOff && has_room_on_lines) line = std::move(wrapped[i]);
    if (line.advance > row.width() + kRoundOff && (stage.page.video.panel_names > 0 || is_made_up(stage.motions[i])))
      line = abbreviated(stage.fonts, title, style, row.width());
    if (line.runs.empty() && stage.page.video.panel_names > 0) continue;  // a cell of a sheet too small for names
    if (line.advance > row.width() + kRoundOff || (line.runs.empty() && !title.empty()))
      throw Error(ExitCode::bad_input,
                  "the title of panel " + std::to_string(i + 1) +
                      " does not fit above it: give the panel a short `title:`",
                  stage.motions[i].scene().place_of("title"));
    titles.push_back({std::move(line), {row.x0, row.y0 + (kTitleDescent + (lines - 1) * kLeading) * text_size}});
  }
  return titles;
}

}  // namespace chainreel
