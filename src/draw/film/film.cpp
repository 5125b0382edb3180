#include "draw/film/film.hpp"

#include <algorithm>
#include <optional>
#include <string_view>
#include <utility>

#include "draw/page/arrow.hpp"
#include "draw/page/scales.hpp"
#include "picture/formula_words.hpp"

namespace chainreel {
namespace {

constexpr double kVeil = 0.55;       // opacity
constexpr double kNotePitch = 1.35;  // of the em

std::vector<double> first_times(const Trajectory& trajectory, int frames) {
  const auto count = std::size_t(std::clamp(frames, 0, trajectory.size()));
  return {trajectory.t.begin(), trajectory.t.begin() + std::ptrdiff_t(count)};
}

// A note in two lines: an event each, or, of one that is too long for one, how far away its run has been in the second, else when it was.
std::optional<std::pair<std::string, std::string>> broken_note(const std::string& note, bool is_long) {
  if (const std::size_t end = note.find(kBetweenEvents); end != std::string::npos)
    return std::pair{note.substr(0, end), note.substr(end + std::string_view(kBetweenEvents).size())};
  if (!is_long) return std::nullopt;
  if (const std::size_t end = note.find(kBeforeAway); end != std::string::npos) return std::pair{note.substr(0, end + 1), note.substr(end + 2)};
  if (const std::size_t end = note.find(" at t = "); end != std::string::npos) return std::pair{note.substr(0, end), note.substr(end + 1)};
  return std::nullopt;
}

// Rails are as long as those of runs that are drawn over them, and one machine beside itself has rails of one length.
std::vector<Panel> panels_of(const Stage& stage, const FilmView& view) {
  std::vector<Panel> panels;
  for (std::size_t i = 0; i < stage.motions.size(); ++i)
    panels.emplace_back(stage.motions[i], PanelView{view.camera_of(i), view.cells[i].scene, int(i), view.marks, view.room(i)}, stage.motions[i].theme_of(stage.theme));
  if (panels.size() == 1) return panels;
  std::vector<std::vector<Rail>> alone;
  for (const Panel& panel : panels) alone.push_back(panel.rails());
  const auto is_one_machine = [&](std::size_t i, std::size_t other) {
    const Chain &a = panels[i].chain(), &b = panels[other].chain();
    return a.name == b.name && a.coordinate_names == b.coordinate_names;
  };
  for (std::size_t i = 0; i < stage.full_panels(); ++i)
    for (std::size_t other = 0; other < panels.size(); ++other)
      if (other != i && (other >= stage.full_panels() || is_one_machine(i, other))) panels[i].let_rails_reach(alone[other]);
  return panels;
}

}  // namespace

Film::Film(const Scene& scene, const Chain& chain, const Trajectory& trajectory, int frames,
           const Fonts& fonts)
    : Film(scene, {{scene, chain, trajectory}}, first_times(trajectory, frames), fonts) {}

Film::Film(const Scene& page, const std::vector<PanelRun>& runs, std::vector<double> times,
           const Fonts& fonts, FilmClock clock)
    : Film(compose(page, runs, times, fonts, clock)) {}

Film::Film(Composition composed)
    : stage_(std::move(composed.stage)),
      layers_(std::move(composed.layers)),
      sheet_(std::move(composed.sheet)),
      view_(std::move(composed.view)),
      titles_(sheet_.panel_titles(*stage_, view_.cells)),
      panels_(panels_of(*stage_, view_)),
      words_(*stage_, layers_, sheet_, view_, panels_),
      left_out_(std::move(composed.left_out)),
      held_text_scale_(composed.held_text_scale) {}

Picture Film::page() const {
  Picture picture;
  picture.aspect = sheet_.sheet.aspect;
  picture.background = stage_->theme.background;
  if (is_transparent(stage_->page)) picture.background.a = 0;
  for (const PanelCell& cell : view_.cells) picture.clips.push_back(cell.scene);
  return picture;
}

void Film::draw_cell_frames(Picture& picture) const {
  const Paint paint{stage_->theme.rule, {}, 0};
  const auto line = [&](Point a, Point b) { picture.add(Capsule{a, b, size::kFrameLine / 2, paint}); };
  const Rect& whole = sheet_.sheet.scene;
  for (const PanelCell& cell : view_.cells) {
    const Rect& r = cell.scene;
    if (!(stage_->page.video.panel_names > 0)) {
      const Point corners[] = {{r.x0, r.y0}, {r.x1, r.y0}, {r.x1, r.y1}, {r.x0, r.y1}};
      for (int i = 0; i < 4; ++i) line(corners[i], corners[(i + 1) % 4]);
      continue;
    }
    // A sheet frames its cells: within them a line between panels will do.
    const double x = r.x1 + size::kGutter / 2, y = cell.title.y1 + size::kGutter / 2;
    if (x < whole.x1) line({x, cell.note.y0}, {x, cell.title.y1});
    if (y < whole.y1) line({r.x0, y}, {r.x1, y});
  }
}

Picture Film::static_layer() const {
  const auto guard = alone();
  Picture picture = page();
  if (stage_->has_cells()) draw_cell_frames(picture);
  for (const Panel& panel : panels_)
    for (const auto& layer : layers_)
      if (layer->is_of(panel.motion())) layer->draw_once(picture, panel);
  for (const auto& layer : layers_) layer->draw_page_once(picture, view_.shared_page(*stage_, sheet_));
  draw_sheet(picture, sheet_.sheet);
  if (sheet_.key) sheet_.key->draw(picture, view_.cells.front().title);
  for (const PlacedText& title : titles_) draw_text(picture, title.line, title.anchor);
  for (const PlotStrip& plot : sheet_.plots) plot.draw_static(picture);
  return picture;
}

std::vector<StandingWord> Film::words(int i, int k) const {
  const auto guard = alone();
  return words_.standing(*stage_, layers_, view_, panels_, std::size_t(i), k);
}

void Film::draw_panel(Picture& picture, std::size_t i, int k, bool is_still) const {
  const Panel& panel = panels_[i];
  const int shown = std::clamp(k, 0, panel.last());
  const bool is_gone = k > shown && panel.motion().may_freeze();
  // A page without a ground has no veil and no words to say so: what is not there any more is not shown, but where it is.
  if (is_gone && is_transparent(stage_->page)) {
    if (stage_->has_cells()) draw_way_out(picture, i, shown + 1);
    return;
  }
  const std::vector<StandingWord> of_still = is_still ? words_.still(*stage_, layers_, sheet_, view_, panels_, i, shown) : std::vector<StandingWord>{};
  MarkLabels labels = is_still ? MarkLabels(of_still) : words_.labels(i, shown);
  for (std::size_t l = 0; l < layers_.size(); ++l)
    if (layers_[l]->is_of(panel.motion()))
      layers_[l]->draw(picture, {panel, panel.motion().pose_at(shown), shown, k > shown, view_.corner(l, i), labels, is_still});
  if (!is_gone || !stage_->has_cells()) return;
  draw_veil(picture, i);
  draw_way_out(picture, i, shown + 1);
}

// At the edge of its cell, towards where the chain is at frame k, the first behind those that are shown. Where it is later an arrow would swap
// ends with each swing of a run that oscillates ever wider.
void Film::draw_way_out(Picture& picture, std::size_t i, int k) const {
  constexpr double kLength = 0.11, kFromEdge = 0.002, kWide = 1.6;  // units of H; the last times an arrow's own size
  const Panel& panel = panels_[i];
  const Rect& r = view_.cells[i].scene;
  const Point middle{(r.x0 + r.x1) / 2, (r.y0 + r.y1) / 2}, there = panel.far_point(std::min(k, panel.motion().samples() - 1));
  const Point way = there - middle;
  if (!std::isfinite(norm(way)) || !(norm(way) > 0)) return;
  const Point u = unit(way);
  const double reach = std::min(r.width() / 2 / std::max(std::abs(u.x), kRoundOff), r.height() / 2 / std::max(std::abs(u.y), kRoundOff));
  const Color color = panel.motion().variant() ? panel.motion().variant()->color : stage_->theme.ink;
  draw_arrow(picture, middle + (reach - kFromEdge - kLength) * u, kLength * u, {.color = color, .size = kWide * view_.marks}, int(i));
}

// Over a panel whose run came to an end that it should not have: what stands there is no more what happens.
void Film::draw_veil(Picture& picture, std::size_t i) const {
  const Rect& r = view_.cells[i].scene;
  picture.add(Polygon{{Point{r.x0, r.y0}, {r.x1, r.y0}, {r.x1, r.y1}, {r.x0, r.y1}}, 4, {stage_->theme.background.faded(kVeil), {}, 0}},
              int(i));
}

Picture Film::frame(int k) const {
  // A last frame that is held is looked at as long as a still: words that come with it stand there.
  return drawn(k, k == frame_count() - 1 && stage_->page.hold.last > 0);
}

Picture Film::still(int k) const {
  Picture picture = static_layer();
  picture.fixed = picture.items.size();
  picture.append(drawn(k, true));
  return picture;
}

Picture Film::drawn(int k, bool is_still) const {
  const auto guard = alone();
  k = std::clamp(k, 0, frame_count() - 1);
  Picture picture = page();
  for (std::size_t i = 0; i < panels_.size(); ++i) draw_panel(picture, i, k, is_still);
  draw_notes(picture, k);
  for (const PlotStrip& plot : sheet_.plots) plot.draw_frame(picture, stage_->times[std::size_t(k)]);
  for (const auto& layer : layers_) layer->draw_page(picture, view_.shared_page(*stage_, sheet_), k);
  return picture;
}

// A note in a row: an event a line where the row has two; in a narrow one of one line stands the last alone, and where that is still
// too long its name. How far away a run has been is said in smaller letters before it is left out.
std::vector<TextLine> Film::note_lines(const Panel& panel, int k, const Rect& row, const TextStyle& style) const {
  const double text_scale = stage_->page.text_scale, least = least_word(stage_->page.video);
  const std::string whose = stage_->is_ghost() ? in_plain_words(panel.title()) + ": " : "";
  const auto widest = [](const std::vector<TextLine>& lines) { return std::ranges::max(lines, {}, &TextLine::advance).advance; };
  std::vector<TextLine> lines;
  for (const int events : {2, 1, 0}) {
    const std::string note = whose + panel.note(k, events);
    const bool is_long = lay_out_text(stage_->fonts, note, style).advance > row.width();
    std::vector<std::string> parts{note};
    if (const auto broken = broken_note(note, is_long); broken && row.height() > 1.5 * kNotePitch * style.size) parts = {broken->first, broken->second};
    lines.clear();
    TextStyle alike = style;  // as small as those before it need
    const auto add = [&](const std::string& part) {
      lines.push_back(fit_text(stage_->fonts, part, alike, row.width(), text_scale));
      if (!lines.back().runs.empty()) alike.size = std::min(alike.size, lines.back().runs.front().size);
    };
    for (const std::string& part : parts) add(part);
    if (parts.size() > 1) {  // and all as small as the longest
      lines.clear();
      for (const std::string& part : parts) add(part);
    }
    const double wide = widest(lines);
    if (wide <= row.width() + kRoundOff) return lines;
    TextStyle small = style;
    small.size = std::max(scaled(kSmallestText, text_scale) * row.width() / wide, least);
    lines.clear();
    for (const std::string& part : parts) lines.push_back(lay_out_text(stage_->fonts, part, small));
    if (note.find(kBeforeAway) != std::string::npos && widest(lines) <= row.width() + kRoundOff) return lines;
  }
  return lines;  // as small as it must be, down to what can be read
}

// What happened in the panels; where they lie over one another each says whose it is.
void Film::draw_notes(Picture& picture, int k) const {
  if (!(sheet_.rows.note > 0)) return;
  const TextStyle style{Face::label, scaled(size::kAxis, stage_->page.text_scale), stage_->theme.ink, Align::left};
  for (std::size_t i = 0; i < panels_.size(); ++i) {
    if (panels_[i].note(k).empty()) continue;
    const Rect& row = view_.cells[i].note;
    double y = row.y0 + kTitleDescent * style.size;
    const std::vector<TextLine> lines = note_lines(panels_[i], k, row, style);
    for (auto line = lines.rbegin(); line != lines.rend(); ++line, y += kNotePitch * style.size) draw_text(picture, *line, {row.x0, y});
  }
}

}  // namespace chainreel
