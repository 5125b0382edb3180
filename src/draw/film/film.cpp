#include "draw/film/film.hpp"

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "core/format.hpp"
#include "draw/film/torque_label.hpp"
#include "draw/layers/acting.hpp"
#include "draw/page/scales.hpp"
#include "draw/robot/view.hpp"

namespace chainreel {
namespace {

constexpr double kEllipseBar = 0.10;  // units of H: the bounded semi-axis measures about as much
constexpr double kTitleRow = 1.55;   // of the em: a panel's title or note with the air around it
constexpr double kBarInset = 0.014;  // of the metre bar from the frame of its panel
constexpr double kLargestAside = 0.6;  // of a panel's width may be taken by what stands beside its scene
constexpr double kTitleDescent = 0.40;    // of the em, from the lower end of a row up to its base line

std::vector<double> first_times(const Trajectory& trajectory, int frames) {
  const auto count = std::size_t(std::clamp(frames, 0, trajectory.size()));
  return {trajectory.t.begin(), trajectory.t.begin() + std::ptrdiff_t(count)};
}

}  // namespace

Film::Film(const Scene& scene, const Chain& chain, const Trajectory& trajectory, int frames,
           const Fonts& fonts)
    : Film(scene, {{scene, chain, trajectory}}, first_times(trajectory, frames), fonts) {}

Film::Film(const Scene& page, const std::vector<PanelRun>& runs, std::vector<double> times,
           const Fonts& fonts, FilmClock clock)
    : scene_(page), fonts_(fonts), theme_(theme_named(page.theme)), layers_(layers_of(page)), times_(std::move(times)),
      clock_(std::move(clock)) {
  for (const PanelRun& run : runs) {
    const int samples = std::min(int(times_.size()), run.trajectory.size());
    if (samples < 1)
      throw Error(ExitCode::bad_input, "a film needs at least one frame", page.place_of("duration"));
    const bool freezes = runs.size() > 1 || run.scene.expect == "diverge";
    const bool in_outline = is_ghost_layout(page) && !panels_.empty();
    panels_.emplace_back(run, in_outline ? outline_layers(layers_) : layers_, samples, freezes ? WildEnd::frozen : WildEnd::shown, theme_);
  }
  if (is_ghost()) tell_variants_apart();
  if (layers_.ellipse) find_ellipse_scale();
  if (layers_.acting.any()) find_vector_scales();
  if (layers_.mass_matrix) make_mass_maps();
  lay_out();
  fit_camera();
  if (has_cells() && layers_.title) place_titles();
}

void Film::tell_variants_apart() {
  const int count = panel_count();
  panels_.front().set_trail_color(variant_color(0, count, theme_));
  for (int i = 1; i < count; ++i)
    panels_[std::size_t(i)].draw_in_outline(variant_color(i, count, theme_), variant_letter(i, count));
}

void Film::find_ellipse_scale() {
  std::vector<double> bounded;
  for (std::size_t i = 0; i < full_panels(); ++i) {
    const std::vector<double> own = panels_[i].bounded_semi_axes();
    bounded.insert(bounded.end(), own.begin(), own.end());
  }
  // Panels share the page, so their sides shrink with the root of their number.
  ellipse_scale_ =
      chainreel::ellipse_scale(std::move(bounded), kEllipseBar / std::sqrt(double(full_panels())), layers_.reading);
}

// Runs that diverge do not decide on it, unless all do: their arrows are cut.
void Film::find_vector_scales() {
  for (Panel& panel : panels_)
    if (is_ghost() || all_wild() || !panel.is_wild()) vector_scales_.peaks.add(panel.peaks());
  vector_scales_.shrink = 1 / std::sqrt(double(full_panels()));
}

void Film::make_mass_maps() {
  double largest = 0;
  for (const Panel& panel : panels_) largest = std::max(largest, panel.largest_mass_entry());
  for (Panel& panel : panels_)
    panel.set_mass_map({panel.chain().nv, mass_unit(panel.chain()), largest, theme_, fonts_, scene_.text_scale});
}

std::vector<ScaleEntry> Film::entries() const {
  std::vector<VectorKind> shown;
  for (const Panel& panel : panels_)
    for (const VectorKind kind : kinds_shown(panel.chain(), layers_.acting))
      if (std::find(shown.begin(), shown.end(), kind) == shown.end()) shown.push_back(kind);
  std::vector<ScaleEntry> entries = scale_entries(vector_scales_, shown, layers_.legend, theme_);
  if (layers_.chain && panels_.front().foot())
    entries.push_back(panels_.front().foot()->scale_entry(theme_));
  if (layers_.com && layers_.legend)
    entries.push_back({ScaleEntry::Mark::center_of_mass, 0, theme_.ink, "centre of mass"});
  return entries;
}

bool Film::is_constrained() const {
  return std::any_of(panels_.begin(), panels_.end(), [](const Panel& panel) { return panel.is_constrained(); });
}

// What acts at the joints of all panels; nothing where they differ, since then their titles say it.
std::vector<std::string> Film::common_torque() const {
  const auto notations = [](const Panel& panel) {
    return torque_notations(panel.chain(), panel.scene().torque, panel.scene().control);
  };
  const std::vector<std::string> first = notations(panels_.front());
  const bool same = std::all_of(panels_.begin(), panels_.end(),
                                [&](const Panel& panel) { return notations(panel) == first; });
  return same ? first : std::vector<std::string>{};
}

void Film::lay_out() {
  SheetText text;
  text.title_place = scene_.place_of("title");
  if (layers_.title) text.title = is_comparison() ? scene_.title : panels_.front().title();
  if (layers_.torque_label) text.torque = common_torque();
  if (layers_.time) text.longest_time = time_text(times_.back(), time_decimals(clock_));
  if (!clock_.is_plain() && !is_transparent(scene_)) {
    speed_.emplace(clock_, scene_.text_scale, theme_, fonts_);
    text.beside_time = speed_->width();
  }
  if (layers_.ellipse) {
    text.bar = ellipse_scale_.label();
    text.bar_length = ellipse_scale_.bar_length;
  }
  if (layers_.ellipse && layers_.legend) text.legend = ellipse_legend(layers_.reading, layers_.section && !panels_.front().chain().planar);
  if (layers_.equation) {
    text.equation = equation_of_motion(is_constrained());
    text.symbols = equation_colors(layers_.acting, theme_);
  }
  text.scales = entries();
  if (is_transparent(scene_)) text = {};  // nothing above or below the scene
  const double aspect = double(scene_.video.width) / scene_.video.height;
  sheet_ = lay_out_sheet(text, aspect, scene_.text_scale, theme_, fonts_);
  if (!scene_.plot.empty() && !is_transparent(scene_)) lay_out_plots();
  if (is_ghost() && layers_.title) {
    key_.emplace(panels_, sheet_.scene.width(), scene_.text_scale, theme_, fonts_);
    rows_.title = key_->height();
  }
  if (has_cells() && layers_.title) rows_.title = kTitleRow * scaled(size::kSymbol, scene_.text_scale);
  if (has_notes())
    rows_.note = kTitleRow * scaled(size::kAxis, scene_.text_scale);
}

bool Film::has_notes() const {
  return !is_transparent(scene_) &&
         std::any_of(panels_.begin(), panels_.end(), [](const Panel& panel) { return panel.may_have_notes(); });
}

// One plot below the scene, more beside it, unless the layout says otherwise; below several panels.
void Film::lay_out_plots() {
  std::vector<StripRun> runs;
  for (const Panel& panel : panels_) runs.push_back(panel.strip_run());
  const int count = int(scene_.plot.size());
  const bool right = !is_comparison() && scene_.layout != "scene-below" &&
                     (count > 1 || scene_.layout == "scene-right");
  const PlotAreas areas = plot_areas(sheet_.scene, count, right ? PlotPlace::right : PlotPlace::below);
  sheet_.scene = areas.scene;
  const PlotStyle style{&fonts_, &theme_, scene_.text_scale};
  for (std::size_t i = 0; i < areas.plots.size(); ++i)
    plots_.emplace_back(strip_data(runs, i, times_.back(), theme_), areas.plots[i], style);
  if (!right) return;
  double x0 = sheet_.scene.x1, x1 = sheet_.aspect;
  for (const PlotStrip& plot : plots_) {
    x0 = std::max(x0, plot.frame().box.x0);
    x1 = std::min(x1, plot.frame().box.x1);
  }
  for (PlotStrip& plot : plots_) plot.narrow_to(x0, x1);
}

// In a corner that nothing ever comes into, the same one in all panels; false where there is none.
bool Film::place_mass_maps(const Camera& camera) {
  const double inset = has_cells() ? kBarInset : 0;
  for (const auto& [right, top] : {std::pair{true, true}, {false, true}, {true, false}, {false, false}}) {
    if (layers_.scale_bar && !right && !top) continue;
    bool free = true;
    for (std::size_t i = 0; i < panels_.size() && free; ++i) {
      const Rect& cell = cells_[i].scene;
      const double width = panels_[i].mass_map()->width(), height = panels_[i].mass_map()->height();
      const Point corner{right ? cell.x1 - inset - width : cell.x0 + inset,
                         top ? cell.y1 - inset - height : cell.y0 + inset};
      panels_[i].place_mass_map(corner);
      free = corner.x >= cell.x0 && corner.y >= cell.y0 &&
             panels_[i].leaves_free(camera_of(camera, i),
                                    {corner.x, corner.y, corner.x + width, corner.y + height});
    }
    if (free) return true;
  }
  return false;
}

// Right of the scenes, which become narrower.
void Film::set_mass_maps_aside() {
  double width = 0;
  for (const Panel& panel : panels_) width = std::max(width, panel.mass_map()->width());
  const double inset = has_cells() ? kBarInset : 0;
  for (std::size_t i = 0; i < panels_.size(); ++i) {
    Rect& cell = cells_[i].scene;
    panels_[i].place_mass_map({cell.x1 - inset - width, cell.y1 - inset - panels_[i].mass_map()->height()});
    if (width + size::kGutter > kLargestAside * cell.width() ||
        panels_[i].mass_map()->height() > cell.height())
      throw Error(ExitCode::bad_input, "M(q) leaves no room for the chain: draw without mass_matrix",
                  scene_.place_of("draw"));
    cell.x1 -= inset + width + size::kGutter;
  }
}

// The size at which every panel's title fits, if it is not too small to read.
double Film::title_size() const {
  const double full = scaled(size::kSymbol, scene_.text_scale);
  double common = full;
  for (std::size_t i = 0; i < panels_.size(); ++i) {
    const TextLine line =
        lay_out_text(fonts_, panels_[i].title(), {Face::label_bold, full, theme_.ink});
    if (line.advance > 0) common = std::min(common, full * cells_[i].title.width() / line.advance);
  }
  return std::max(common, std::min(full, scaled(kSmallestText, scene_.text_scale)));
}

void Film::place_titles() {
  const bool two_sides = panels_.size() == 2;
  const double text_size = title_size();
  for (std::size_t i = 0; i < panels_.size(); ++i) {
    const Rect& row = cells_[i].title;
    const Color color = !two_sides ? theme_.ink : i == 0 ? theme_.side_a : theme_.side_b;
    const Scene& scene = panels_[i].scene();
    TextLine line = lay_out_text(fonts_, panels_[i].title(), {Face::label_bold, text_size, color});
    if (line.advance > row.width() + kRoundOff)
      throw Error(ExitCode::bad_input,
                  "the title of panel " + std::to_string(i + 1) +
                      " does not fit above it: give the panel a short `title:`",
                  scene.place_of("title"));
    titles_.push_back({std::move(line), {row.x0, row.y0 + kTitleDescent * text_size}});
  }
}

Picture Film::page() const {
  Picture picture;
  picture.aspect = sheet_.aspect;
  picture.background = theme_.background;
  if (is_transparent(scene_)) picture.background.a = 0;
  for (const PanelCell& cell : cells_) picture.clips.push_back(cell.scene);
  return picture;
}

void Film::draw_frames(Picture& picture) const {
  for (const PanelCell& cell : cells_) {
    const Rect& r = cell.scene;
    picture.add(Polygon{
        {Point{r.x0, r.y0}, {r.x1, r.y0}, {r.x1, r.y1}, {r.x0, r.y1}}, 4, {{}, theme_.rule, size::kFrameLine}});
  }
}

Picture Film::static_layer() const {
  Picture picture = page();
  if (has_cells()) draw_frames(picture);
  for (const Panel& panel : panels_) panel.draw_static(picture);
  if (layers_.scale_bar) {
    Sheet first = sheet_;
    first.scene = cells_.front().scene;
    if (has_cells()) first.scene.x0 += kBarInset;
    draw_metre_bar(picture, camera(), first, fonts_);
  }
  draw_sheet(picture, sheet_);
  if (key_) key_->draw(picture, cells_.front().title);
  for (const PlacedText& title : titles_) draw_text(picture, title.line, title.anchor);
  for (const PlotStrip& plot : plots_) plot.draw_static(picture);
  return picture;
}

Picture Film::frame(int k) const {
  k = std::clamp(k, 0, int(times_.size()) - 1);
  Picture picture = page();
  for (const Panel& panel : panels_) panel.draw_frame(picture, k, ellipse_scale_, fonts_);
  draw_notes(picture, k);
  for (const PlotStrip& plot : plots_) plot.draw_frame(picture, times_[std::size_t(k)]);
  if (layers_.time) draw_time(picture, sheet_, times_[std::size_t(k)], fonts_, time_decimals(clock_));
  if (speed_) speed_->draw(picture, sheet_.time_left, clock_.speed_at(times_[std::size_t(k)]));
  return picture;
}

// Of what the panels show; where they lie over one another each says whose it is.
void Film::draw_notes(Picture& picture, int k) const {
  if (!has_notes()) return;
  for (std::size_t i = 0; i < panels_.size(); ++i) {
    std::string note = panels_[i].note(k);
    if (note.empty()) continue;
    if (is_ghost()) note = panels_[i].title() + ": " + note;
    const Rect& row = cells_[i].note;
    const TextStyle style{Face::label, scaled(size::kAxis, scene_.text_scale), theme_.ink, Align::left};
    draw_text(picture, fit_text(fonts_, note, style, row.width(), scene_.text_scale),
              {row.x0, row.y0 + kTitleDescent * style.size});
  }
}

// How the one camera of a film is placed: which way it looks, from how far, and what it holds.

bool Film::all_wild() const {
  return std::all_of(panels_.begin(), panels_.end(), [](const Panel& panel) { return panel.is_wild(); });
}

MotionBox Film::motion() const {
  MotionBox box(up_of(panels_.front().chain()));
  for (const Panel& panel : panels_)
    if (all_wild() || !panel.is_wild()) box.add(panel.motion(all_wild()));
  return box;
}

FitBox Film::fit_box(const Camera& view, double marks) {
  FitBox box;
  for (Panel& panel : panels_) panel.set_pens(fonts_, vector_scales_, marks);
  for (Panel& panel : panels_) box.add(panel.fit_box(view, marks, all_wild()));
  return box;
}

// What is to be seen just fills `area`, or what the scene says.
void Film::fit_to_area(Camera& camera, const FitBox& box, const Rect& area) const {
  if (!fit_as_told(camera, scene_.camera, area)) fit_to(camera, box, area, size::kFitMargin);
}

void Film::find_ground(const Camera& camera) {
  const bool wanted = layers_.ground || layers_.shadow;
  if (!wanted || !is_oblique(panels_.front().chain(), scene_.camera)) return;
  if (const auto ground = ground_under(motion(), camera))
    for (Panel& panel : panels_) panel.set_ground(*ground);
}

void Film::fit_camera() {
  Camera camera = view_of(panels_.front().chain(), scene_.camera);
  FitBox box = fit_box(camera, 1);
  find_cells(box);
  if (cells_.empty())
    throw Error(ExitCode::bad_input,
                "the panels get too small on this page: compare fewer, or lower text_scale",
                scene_.place_of("compare"));
  const double marks = is_ghost() ? 1 : marks_in(cells_);
  if (has_eye(panels_.front().chain(), scene_.camera))
    place_eye(
        camera, motion(), scene_.camera, cells_.front().scene.height(),
        [&](Camera& seen) { fit_to_area(seen, fit_box(seen, marks), cells_.front().scene); },
        scene_.place_of("camera.distance"));
  if (marks != 1 || camera.nearness > 0) box = fit_box(camera, marks);
  fit_to_area(camera, box, cells_.front().scene);
  if (layers_.mass_matrix && !place_mass_maps(camera)) {
    set_mass_maps_aside();
    fit_to_area(camera, box, cells_.front().scene);
  }
  find_ground(camera);
  for (std::size_t i = 0; i < panels_.size(); ++i)
    panels_[i].settle(camera_of(camera, i), cells_[i].scene, int(i), marks);
  for (std::size_t i = full_panels(); i < panels_.size(); ++i) panels_.front().reach_as_far_as(panels_[i]);
}

void Film::find_cells(const FitBox& box) {
  const int count = panel_count();
  if (is_ghost())
    cells_ = ghost_cells(sheet_.scene, rows_, panels_);
  else if (scene_.layout == "compare")
    cells_ = panel_cells(sheet_.scene, count, count, rows_);
  else
    cells_ = best_cells(sheet_.scene, count, rows_, box);
}

// All panels see the same part of the world at the same place of their cells.
Camera Film::camera_of(const Camera& first, std::size_t i) const {
  const Rect &from = cells_.front().scene, &to = cells_[i].scene;
  Camera shifted = first;
  shifted.origin = first.origin + Point{to.x0 - from.x0, to.y0 - from.y0};
  return shifted;
}

}  // namespace chainreel
