#include "draw/page/sheet.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/error.hpp"
#include "core/format.hpp"
#include "draw/page/house_style.hpp"
#include "picture/plot.hpp"

namespace chainreel {
namespace {

constexpr double kTextGap = 0.05;   // between texts that share a row
constexpr double kNextRow = 1.5;    // of the em, for further rows
constexpr double kAirAboveRows = 0.4;  // of the em, above the last of these
constexpr double kNarrowPage = 1.2;  // aspect: below, titles may take two rows

// Advances are proportional to the size, so one correction is enough. `lay_out`: of a style.
template <class LayOut>
TextLine fit_line(LayOut lay_out, TextStyle style, double width, double text_scale) {
  TextLine line = lay_out(style);
  if (line.advance <= width) return line;
  style.size =
      std::max(style.size * width / line.advance, std::min(style.size, scaled(kSmallestText, text_scale)));
  return lay_out(style);
}

double baseline(double bottom, double top, double text_size) {
  return (bottom + top - kCapHeight * text_size) / 2;
}

struct Builder {
  Sheet sheet;
  const Fonts& fonts;
  double left, right, top, bottom;  // what is still free inside the margins

  double width() const { return right - left; }
  TextStyle style(Face face, double size, Color color, Align align = Align::left) const {
    return {face, scaled(size, sheet.text_scale), color, align};
  }
  void place(TextLine line, Point anchor) { sheet.texts.push_back({std::move(line), anchor}); }
};

// The title broken where its longer half is shortest; nothing where that does not fit either.
std::optional<std::array<TextLine, 2>> two_rows(const Builder& b, const std::string& title, const TextStyle& style) {
  std::optional<std::array<TextLine, 2>> best;
  for (std::size_t at = title.find(' '); at != std::string::npos; at = title.find(' ', at + 1)) {
    if (std::count(title.begin(), title.begin() + std::ptrdiff_t(at), '$') % 2 == 1) continue;  // within a formula
    const auto row = [&](const std::string& words) { return fit_words(b.fonts, words, style, b.width(), b.sheet.text_scale); };
    std::array<TextLine, 2> rows{row(title.substr(0, at)), row(title.substr(at + 1))};
    const auto length = [](const std::array<TextLine, 2>& two) { return std::max(two[0].advance, two[1].advance); };
    if (length(rows) <= b.width() + kRoundOff && (!best || length(rows) < length(*best))) best = std::move(rows);
  }
  return best;
}

void build_title_band(Builder& b, const SheetText& text) {
  if (text.title.empty() && text.torque.empty() && text.equation.empty()) return;
  const Theme& theme = *b.sheet.theme;
  const double title_size = scaled(size::kTitle, b.sheet.text_scale);
  const double torque_size = scaled(size::kEquation, b.sheet.text_scale);
  double row_bottom = b.top - grown(size::kTitleBand, size::kTitle, b.sheet.text_scale);
  double title_end = b.left;
  if (!text.title.empty()) {
    const TextStyle style = b.style(Face::label_bold, size::kTitle, theme.ink);
    TextLine line = fit_words(b.fonts, text.title, style, b.width(), b.sheet.text_scale);
    if (const auto rows = b.sheet.aspect < kNarrowPage && line.advance > b.width() + kRoundOff ? two_rows(b, text.title, style)
                                                                                              : std::nullopt) {
      b.place((*rows)[0], {b.left, baseline(row_bottom, b.top, title_size)});
      b.top = row_bottom + 0.35 * title_size;
      row_bottom = b.top - kNextRow * title_size;
      line = (*rows)[1];
    }
    if (line.advance > b.width() + kRoundOff) {
      throw Error(ExitCode::bad_input,
                  "the title does not fit on the page: shorten it (at most seven words read well)",
                  text.title_place);
    }
    title_end += line.advance + kTextGap;
    b.place(std::move(line), {b.left, baseline(row_bottom, b.top, title_size)});
  }
  double free_from = title_end;  // in the last row
  bool row_has_room = true, is_second_row = false;
  if (!text.torque.empty()) {
    const TextStyle style = b.style(Face::math, size::kEquation, theme.ink);
    TextLine line = fit_math(b.fonts, text.torque, style, b.width(), b.sheet.text_scale);
    const bool beside = title_end + line.advance <= b.right;
    double row_top = b.top;
    if (!beside) {
      row_top = row_bottom + 0.2 * torque_size;  // the title's row has air below it
      row_bottom = row_top - kNextRow * torque_size;
    }
    const double x = beside && !text.title.empty() ? b.right - line.advance : b.left;
    free_from = b.left + line.advance + kTextGap;
    row_has_room = !beside || text.title.empty();
    is_second_row = !beside;
    b.place(std::move(line), {x, baseline(row_bottom, row_top, torque_size)});
  }
  if (!text.equation.empty()) {
    const TextStyle style = b.style(Face::math, size::kEquation, theme.ink);
    TextLine line = fit_math(b.fonts, {text.equation}, style, b.width(), b.sheet.text_scale, text.symbols);
    const bool beside = row_has_room && free_from + line.advance <= b.right;
    double row_top = is_second_row ? row_bottom + kNextRow * torque_size : b.top;
    if (!beside) {
      row_top = row_bottom + (is_second_row ? 0 : 0.2 * torque_size);
      row_bottom = row_top - kNextRow * torque_size;
    }
    const double x = beside && free_from > b.left ? b.right - line.advance : b.left;
    b.place(std::move(line), {x, baseline(row_bottom, row_top, torque_size)});
  }
  b.top = row_bottom;
}

// The legend in one line, or broken behind its colon, or else between words, so that each line fits; all of one size.
std::vector<TextLine> legend_lines(const Builder& b, const std::string& legend, double usual) {
  if (legend.empty()) return {};
  TextStyle style = b.style(Face::label, usual, b.sheet.theme->muted);
  const double smallest = std::min(style.size, scaled(kSmallestText, b.sheet.text_scale));
  const std::size_t colon = legend.find(": ");
  std::vector<std::string> parts{legend};
  if (lay_out_text(b.fonts, legend, style).advance > b.width() && colon != std::string::npos)
    parts = {legend.substr(0, colon + 1), legend.substr(colon + 2)};
  double size = style.size;
  for (const std::string& part : parts)
    size = std::min(size, style.size * b.width() / std::max(lay_out_text(b.fonts, part, style).advance, kRoundOff));
  if (size < smallest * (1 - kRoundOff)) {
    size = style.size;
    parts = wrapped(b.fonts, legend, style, b.width());
  }
  style.size = size;
  std::vector<TextLine> lines;
  for (const std::string& part : parts) lines.push_back(fit_text(b.fonts, part, style, b.width(), b.sheet.text_scale));
  return lines;
}

void place_bar(Builder& b, TextLine label, double row_bottom, double row_top) {
  const double middle = (row_bottom + row_top) / 2;
  b.sheet.bar = Point{b.left, middle};
  b.place(std::move(label), {b.left + b.sheet.bar_length + size::kMarkToText,
                             baseline(row_bottom, row_top, scaled(size::kTick, b.sheet.text_scale))});
}

// Entries in rows of their width.
std::vector<std::vector<EntryLine>> entry_rows(const Builder& b, const SheetText& text) {
  std::vector<std::vector<EntryLine>> rows;
  double used = 0;
  for (const ScaleEntry& entry : text.scales) {
    EntryLine line = lay_out_entry(entry, b.fonts, b.sheet.text_scale, *b.sheet.theme);
    if (rows.empty() || used + kTextGap + line.width > b.width()) {
      rows.emplace_back();
      used = -kTextGap;
    }
    used += kTextGap + line.width;
    rows.back().push_back(std::move(line));
  }
  return rows;
}

// Above what stands in the foot; the last row beside the time where `beside` has room for it.
void place_entries(Builder& b, const SheetText& text, double beside, double row_bottom, double row_top) {
  std::vector<std::vector<EntryLine>> rows = entry_rows(b, text);
  const double pitch = kNextRow * scaled(size::kAxis, b.sheet.text_scale);
  const double foot_top = row_top;
  bool first = true;
  for (std::size_t i = rows.size(); i-- > 0; first = false) {
    double width = -kTextGap;
    for (const EntryLine& line : rows[i]) width += kTextGap + line.width;
    if (!first || width > beside) {
      row_bottom = row_top;
      row_top += pitch;
    }
    double x = b.left;
    for (EntryLine& line : rows[i]) {
      const double step = line.width + kTextGap;
      b.sheet.scales.push_back({std::move(line), {x, (row_bottom + row_top) / 2}});
      x += step;
    }
  }
  // Lower rows than that of the time have less air above them than what stands there, as the numbers of a plot, is to keep off.
  b.bottom = row_top + (row_top > foot_top ? kAirAboveRows * scaled(size::kAxis, b.sheet.text_scale) : 0);
}

void build_footer_band(Builder& b, const SheetText& text) {
  const bool has_time = !text.longest_time.empty() || text.beside_time > 0;
  if (!has_time && text.bar.empty() && text.legend.empty() && text.scales.empty()) return;
  const Theme& theme = *b.sheet.theme;
  const double row = grown(size::kFooterBand, size::kAxis, b.sheet.text_scale), axis = scaled(size::kAxis, b.sheet.text_scale);
  const TextLine time =
      lay_out_text(b.fonts, text.longest_time, b.style(Face::label, size::kAxis, theme.ink));
  TextLine bar = lay_out_text(b.fonts, text.bar, b.style(Face::label, size::kTick, theme.ink));
  std::vector<TextLine> legend = legend_lines(b, text.legend, text.legend_size);

  const double beside_gap = text.beside_time > 0 && !text.longest_time.empty() ? kTextGap / 2 : 0;
  const double time_width = has_time ? time.advance + beside_gap + text.beside_time + kTextGap : 0;
  const double bar_width = text.bar.empty() ? 0 : text.bar_length + size::kMarkToText + bar.advance;
  const double bar_to_legend = text.bar.empty() ? 0 : kTextGap / 2;
  const bool one_row =
      legend.size() <= 1 &&
      bar_width + bar_to_legend + time_width + (legend.empty() ? 0 : legend[0].advance) <= b.width();
  const bool bar_beside_time = bar_width + time_width <= b.width();

  // Rows from the bottom up: time, scale bar, legend.
  double row_bottom = b.bottom, row_top = b.bottom + row;
  b.sheet.time_anchor = {b.right, baseline(row_bottom, row_top, axis)};
  b.sheet.time_left = b.sheet.time_anchor - Point{time.advance + beside_gap, 0};
  if (!text.bar.empty()) {
    if (!bar_beside_time) {
      row_bottom = row_top;
      row_top += kNextRow * axis;
    }
    b.sheet.bar_length = text.bar_length;
    place_bar(b, std::move(bar), row_bottom, row_top);
  }
  const bool row_taken = !text.bar.empty() || has_time;
  for (std::size_t i = legend.size(); i-- > 0;) {
    if (!one_row && (row_taken || i + 1 < legend.size())) {
      row_bottom = row_top;
      row_top += kNextRow * axis;
    }
    const double x = b.left + (one_row ? bar_width + bar_to_legend : 0);
    b.place(std::move(legend[i]), {x, baseline(row_bottom, row_top, axis)});
  }
  b.bottom = row_top;
  const bool bare = text.bar.empty() && text.legend.empty();
  if (!text.scales.empty()) place_entries(b, text, bare ? b.width() - time_width : 0, row_bottom, row_top);
}

}  // namespace

TextLine fit_text(const Fonts& fonts, const std::string& text, TextStyle style, double width,
                  double text_scale) {
  return fit_line([&](const TextStyle& s) { return lay_out_text(fonts, text, s); }, style, width, text_scale);
}

TextLine fit_words(const Fonts& fonts, const std::string& words, TextStyle style, double width, double text_scale) {
  return fit_line([&](const TextStyle& s) { return lay_out_words(fonts, words, s); }, style, width, text_scale);
}

TextLine fit_math(const Fonts& fonts, const std::vector<std::string>& forms, TextStyle style, double width,
                  double text_scale, const std::vector<SymbolColor>& symbols) {
  TextLine line;
  for (const std::string& form : forms) {
    try {
      line = fit_line([&](const TextStyle& s) { return lay_out_math(fonts, form, s, symbols); }, style, width,
                      text_scale);
    } catch (const Error&) {
      continue;  // a name that is not notation, such as k_: a shorter form does without it
    }
    if (line.advance <= width + kRoundOff) break;
  }
  return line;
}

std::string time_text(double t, int decimals) {
  return "t = " + format_fixed(t, decimals) + " s";
}

bool is_at_top(PageCorner corner) { return corner == PageCorner::top_right || corner == PageCorner::top_left; }
bool is_at_left(PageCorner corner) { return corner == PageCorner::top_left || corner == PageCorner::bottom_left; }

Rect box_of(const PageLogo& logo, const Rect& inside) {
  const double pixel = 1.0 / logo.page_height, aspect = double(logo.image->width) / logo.image->height;
  const double high = std::min(logo.height, inside.width() / 3 / aspect);
  const auto whole = [&](double length) { return std::max(1.0, std::round(length / pixel)) * pixel; };
  const double width = whole(high * aspect), height = whole(high);
  const double x0 = std::floor((is_at_left(logo.corner) ? inside.x0 : inside.x1 - width) / pixel) * pixel;
  const double y0 = std::floor((is_at_top(logo.corner) ? inside.y1 - height : inside.y0) / pixel) * pixel;
  return {x0, y0, x0 + width, y0 + height};
}

namespace {

// Bands with the logo in one of their corners: they are as high as it at least, and their words end beside it.
class LogoCorner {
 public:
  LogoCorner(Builder& b, const std::optional<PageLogo>& logo) : b_(&b), logo_(logo) {}

  template <class Build>
  void build(bool at_top, Build build_band) {
    if (!logo_ || at_top != is_at_top(logo_->corner)) return build_band();
    const Rect box = box_of(*logo_, {b_->left, b_->bottom, b_->right, b_->top});
    const double left = b_->left, right = b_->right;
    if (is_at_left(logo_->corner))
      b_->left = box.x1 + kBesideLogo;
    else
      b_->right = box.x0 - kBesideLogo;
    build_band();
    b_->left = left;
    b_->right = right;
    if (at_top)
      b_->top = std::min(b_->top, box.y0 - size::kMarkToText);
    else
      b_->bottom = std::max(b_->bottom, box.y1 + size::kMarkToText);
    b_->sheet.logo = logo_;
    b_->sheet.logo_box = box;
  }

 private:
  Builder* b_;
  const std::optional<PageLogo>& logo_;
};

}  // namespace

Sheet lay_out_sheet(const SheetText& text, double aspect, double text_scale, const Theme& theme,
                    const Fonts& fonts, double height) {
  const double margin = size::kMargin * std::min(height, aspect);  // of a page higher than wide that of one as high as it is wide
  Builder b{{}, fonts, margin, aspect - margin, height - margin, margin};
  b.sheet.aspect = aspect;
  b.sheet.text_scale = text_scale;
  b.sheet.theme = &theme;
  LogoCorner corner(b, text.logo);
  corner.build(true, [&] { build_title_band(b, text); });
  corner.build(false, [&] { build_footer_band(b, text); });
  if (!(b.top - b.bottom > 0.1)) {
    throw Error(ExitCode::bad_input,
                "title, torques and legend leave no room for the scene: draw fewer of them or "
                "lower text_scale",
                text.title_place);
  }
  b.sheet.scene = {b.left, b.bottom, b.right, b.top};
  return b.sheet;
}

void draw_sheet(Picture& picture, const Sheet& sheet) {
  for (const PlacedText& text : sheet.texts) draw_text(picture, text.line, text.anchor);
  for (const PlacedEntry& entry : sheet.scales)
    draw_entry(picture, entry.line, entry.left, *sheet.theme);
  if (sheet.logo) draw_logo(picture, *sheet.logo->image, sheet.logo_box, sheet.logo->page_height);
  if (sheet.bar) draw_scale_bar(picture, *sheet.bar, sheet.bar_length, sheet.theme->ellipse);
}

void draw_time(Picture& picture, const Sheet& sheet, double t, const Fonts& fonts, int decimals) {
  // Figures of the label face are equally wide, so right alignment keeps every digit in its place.
  const TextStyle style{Face::label, scaled(size::kAxis, sheet.text_scale), sheet.theme->ink, Align::right};
  draw_text(picture, lay_out_text(fonts, time_text(t, decimals), style), sheet.time_anchor);
}

}  // namespace chainreel
