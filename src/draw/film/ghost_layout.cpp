#include "draw/film/ghost_layout.hpp"

#include <algorithm>

#include "core/error.hpp"
#include "draw/page/sheet.hpp"

namespace chainreel {
namespace {

constexpr double kMarkLength = 0.060;  // units of H, of a short link
constexpr double kMarkWidth = 0.85;    // of the em
constexpr double kEntryGap = 0.05;
constexpr double kKeyRow = 1.7;    // of the em
constexpr double kKeyDescent = 0.50;    // of the em, from the lower end of a row up to its base line

}  // namespace

std::vector<PanelCell> ghost_cells(const Rect& area, const PanelRows& rows, const std::vector<StagedRun>& motions) {
  PanelRows all = rows;
  all.note = 0;
  for (const StagedRun& motion : motions) all.note += motion.may_have_notes() ? rows.note : 0;
  std::vector<PanelCell> cells(motions.size(), panel_cells(area, 1, 1, all).front());
  double top = cells.front().scene.y0;
  for (std::size_t i = 0; i < motions.size(); ++i) {
    if (!motions[i].may_have_notes()) continue;
    cells[i].note.y1 = top;
    cells[i].note.y0 = top -= rows.note;
  }
  return cells;
}

GhostKey::GhostKey(const Stage& stage, double width)
    : theme_(&stage.theme), text_size_(scaled(size::kAxis, stage.page.text_scale)) {
  const int count = int(stage.motions.size());
  double x = 0;
  for (int i = 0; i < count; ++i) {
    const StagedRun& motion = stage.motions[std::size_t(i)];
    const Variant& variant = *motion.variant();
    Entry entry;
    entry.filled = i == 0;
    entry.color = variant.color;
    entry.fill = variant.theme->link[0];
    const std::string title = (variant.letter.empty() ? "" : variant.letter + ": ") + motion.title();
    const double room = width - kMarkLength - size::kMarkToText;
    entry.line =
        fit_words(stage.fonts, title, {Face::label_bold, text_size_, entry.color, Align::left}, room,
                 stage.page.text_scale);
    if (entry.line.advance > room + kRoundOff)
      throw Error(ExitCode::bad_input,
                  "the title of panel " + std::to_string(i + 1) +
                      " does not fit on the page: give the panel a short `title:`",
                  motion.scene().place_of("title"));
    const double taken = kMarkLength + size::kMarkToText + entry.line.advance;
    if (x > 0 && x + taken > width) {
      x = 0;
      ++rows_;
    }
    entry.x = x;
    entry.row = rows_ - 1;
    x += taken + kEntryGap;
    entries_.push_back(std::move(entry));
  }
}

double GhostKey::height() const {
  return rows_ * kKeyRow * text_size_;
}

void GhostKey::draw_mark(Picture& picture, const Entry& entry, Point left) const {
  const double r = kMarkWidth * text_size_ / 2;
  const Capsule link{{left.x + r, left.y}, {left.x + kMarkLength - r, left.y}, r, {}};
  Capsule shown = link;
  shown.paint = entry.filled ? Paint{entry.fill, theme_->ink, size::kLinkOutline}
                             : Paint{{}, entry.color, size::kLinkOutline};
  picture.add(shown);
}

void GhostKey::draw(Picture& picture, const Rect& rows) const {
  for (const Entry& entry : entries_) {
    const double base = rows.y1 - (entry.row + 1) * kKeyRow * text_size_ + kKeyDescent * text_size_;
    const Point left{rows.x0 + entry.x, base};
    draw_mark(picture, entry, left + Point{0, kCapHeight / 2 * text_size_});
    draw_text(picture, entry.line, left + Point{kMarkLength + size::kMarkToText, 0});
  }
}

}  // namespace chainreel
