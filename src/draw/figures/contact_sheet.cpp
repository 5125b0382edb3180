#include "draw/figures/contact_sheet.hpp"

#include <algorithm>
#include <limits>

#include "core/error.hpp"
#include "draw/page/sheet.hpp"
#include "picture/formula_words.hpp"
#include "picture/place_picture.hpp"

namespace chainreel {
namespace {

constexpr double kBetweenColumns = 0.022;            // between columns, and below the titles of a row
constexpr double kTitlePitch = 1.28;       // of the em
constexpr double kAirOfTitle = 0.45;        // of the em, between a picture and its title
constexpr double kAscent = 0.80;          // of the em
constexpr double kSmallestPicture = 0.045;   // height of a picture that shows anything
constexpr double kWidestTitle = 1.5;      // of a picture's width
constexpr double kWideCell = 0.75;        // from this width on, titles have one line and their full size
constexpr double kThinnestLine = 0.0011;  // 1.2 px of 1080
constexpr double kLargestWords = 2;  // text_scale; beyond it words would hide what they name
constexpr double kNoWords = 1e-3;    // text_scale of words, and of the room for them, that nobody sees
constexpr double kScript = 0.7;      // of the em: indices are that small by themselves
const std::string kEllipsis = "\u2026";

constexpr double kTitleRoom = 1.7;   // of its em: of the page's title with the air below it
constexpr double kTitleLinePitch = 1.25;  // of its em
constexpr double kTitleOfPaper = 0.8;  // of what it is on a slide, beside the same words
constexpr double kTitleAspect = 1.2;  // narrower pages have smaller titles
constexpr int kMostTitleLines = 2;
constexpr double kSmallerTitle = 0.95;

// The page's title, whole on as many lines as it takes, smaller where these would be too many.
struct PageTitle {
  std::vector<TextLine> lines;
  double size = 0;

  double room() const { return lines.empty() ? 0 : (kTitleRoom + double(lines.size() - 1) * kTitleLinePitch) * size; }
};

// Greedy: as many words as fit into each line, one at least; what is left over stands in the last one.
template <class Fits>
std::vector<std::string> broken_into_lines(const std::string& text, int most, Fits fits) {
  std::vector<std::string> lines;
  for (const std::string& word : formula_words(text)) {
    const std::string longer = lines.empty() ? word : lines.back() + " " + word;
    if (lines.empty() || (!fits(longer) && int(lines.size()) < most))
      lines.push_back(word);
    else
      lines.back() = longer;
  }
  return lines;
}

PageTitle page_title(const ContactSheetLook& look) {
  PageTitle title;
  const double width = look.aspect - 2 * size::kMargin;
  const auto line_of = [&](const std::string& words) {
    return lay_out_words(*look.fonts, words, {Face::label_bold, title.size, look.theme->ink, Align::left});
  };
  if (look.title.empty()) return title;
  for (title.size = look.words_of(size::kTitle) * (look.is_paper ? kTitleOfPaper : std::min(1.0, look.aspect / kTitleAspect));; title.size *= kSmallerTitle) {
    title.lines.clear();
    const auto fits_width = [&](const std::string& words) { return line_of(words).advance <= width; };
    for (const std::string& words : broken_into_lines(look.title, std::numeric_limits<int>::max(), fits_width)) title.lines.push_back(line_of(words));
    const bool is_narrow = std::ranges::all_of(title.lines, [width](const TextLine& line) { return line.advance <= width; });
    const bool fits = is_narrow && int(title.lines.size()) <= kMostTitleLines;
    if (look.is_paper && title.size < look.least_text)
      throw Error(ExitCode::usage, "the title has no room above the page where it can be read: take a shorter --title, or a wider page");
    if (fits || title.size < kNoWords) return title;  // on a page of next to no width nothing fits
  }
}

// Heights that a grid of that many lines gives its pictures.
struct Cut {
  double width = 0, height = 0;  // of a picture
  double caption = 0;            // below it
  double text_size = 0;
  int title_lines = 2;
};

Cut cut_page(int columns, int lines, const Rect& inside, const ContactSheetLook& look) {
  Cut cut;
  cut.width = (inside.width() - (columns - 1) * kBetweenColumns) / columns;
  const bool wide = cut.width >= kWideCell;
  cut.title_lines = std::max(wide ? 1 : 2, look.title_lines);
  cut.text_size = look.words_of(wide ? size::kAxis : kSmallestText);
  cut.caption = (kAirOfTitle + cut.title_lines * kTitlePitch) * cut.text_size;
  const double room = (inside.height() - (lines - 1) * kBetweenColumns) / lines - cut.caption;
  cut.height = std::min(cut.width / kCellAspect, room);
  cut.width = cut.height * kCellAspect;
  cut.height = std::clamp(room, cut.height, cut.width / kTallestCell);
  return cut;
}

int lines_of(int count, int columns) {
  return (count + columns - 1) / columns;
}

// As few columns as any other choice that makes the pictures as large.
int best_columns(int count, const Rect& inside, const ContactSheetLook& look) {
  int best = 1;
  double largest = 0;
  for (int columns = 1; columns <= count; ++columns) {
    const double width = cut_page(columns, lines_of(count, columns), inside, look).width;
    if (width <= largest * (1 + 1e-9)) continue;
    largest = width;
    best = columns;
  }
  return best;
}

TextLine title_line(const std::string& text, double size, const ContactSheetLook& look) {
  return lay_out_words(*look.fonts, text, {Face::label, size, look.theme->ink});
}

// The longest beginning of a text, with an ellipsis behind it, that is no wider than `width`: whole words, or
// a part of the only one.
std::string shortened(const std::string& text, double size, double width, const ContactSheetLook& look) {
  for (const bool whole_words : {true, false})
    for (std::size_t end = text.size() - 1; end > 0; --end) {
      const bool inside_character = (static_cast<unsigned char>(text[end]) & 0xC0) == 0x80;
      if (inside_character || (whole_words && text[end] != ' ')) continue;
      if (!is_outside_formula(text, end)) continue;
      const std::string cut = text.substr(0, end) + kEllipsis;
      if (title_line(cut, size, look).advance <= width) return cut;
    }
  return kEllipsis;
}

std::vector<std::string> lines_of_title(const std::string& title, double size, double width, int most, const ContactSheetLook& look) {
  return broken_into_lines(title, most, [&](const std::string& words) { return title_line(words, size, look).advance <= width; });
}

// What is left over is cut off in the last.
std::vector<std::string> broken_title(const std::string& title, double size, double width, int most,
                                      const ContactSheetLook& look) {
  std::vector<std::string> lines = lines_of_title(title, size, width, most, look);
  for (std::string& line : lines)
    if (title_line(line, size, look).advance > width) line = shortened(line, size, width, look);
  return lines;
}

void draw_frame(Picture& picture, const Rect& r, const Theme& theme) {
  picture.add(Polygon{
      {Point{r.x0, r.y0}, {r.x1, r.y0}, {r.x1, r.y1}, {r.x0, r.y1}}, 4, {{}, theme.rule, size::kFrameLine}});
}

}  // namespace

ContactGrid contact_grid(int count, const ContactSheetLook& look) {
  if (count > kMostCells)
    throw Error(ExitCode::usage, std::to_string(count) + " pictures are too many for a sheet: no more than " +
                                     std::to_string(kMostCells) + " fit");
  const Rect inside{size::kMargin, size::kMargin, look.aspect - size::kMargin, 1 - size::kMargin - page_title(look).room()};
  ContactGrid grid;
  grid.columns =
      look.columns > 0 ? std::min(look.columns, count) : best_columns(count, inside, look);
  grid.lines = lines_of(count, grid.columns);
  const Cut cut = cut_page(grid.columns, grid.lines, inside, look);
  if (cut.height < kSmallestPicture)
    throw Error(ExitCode::usage, std::to_string(count) + " pictures in " + std::to_string(grid.columns) +
                                     " columns are too small on this page: choose other --columns, a larger "
                                     "--height or a smaller --text-scale");
  grid.text_size = cut.text_size;
  grid.title_lines = cut.title_lines;
  grid.smallest_text = look.words_of(kSmallestText);

  // The whole lies in the middle of the page. Where the height decides on the pictures, titles are wider than they, by no more than a half.
  const double column = (inside.width() - (grid.columns - 1) * kBetweenColumns) / grid.columns;
  const double wide = grid.columns > 1 ? std::min(column, kWidestTitle * cut.width) : cut.width;
  const double all = grid.columns * (wide + kBetweenColumns) - kBetweenColumns;
  const double left = std::min((look.aspect - all + wide - cut.width) / 2, look.aspect - size::kMargin - all);
  const double line = cut.height + cut.caption + kBetweenColumns;
  const double top = inside.y1 - (inside.height() - grid.lines * line + kBetweenColumns) / 2;
  for (int i = 0; i < count; ++i) {
    const double x = left + (i % grid.columns) * (wide + kBetweenColumns);
    const double y = top - (i / grid.columns) * line;
    grid.pictures.push_back({x, y - cut.height, x + cut.width, y});
    grid.titles.push_back({x, y - cut.height - cut.caption, x + wide, y - cut.height});
  }
  return grid;
}

double text_scale_in(const ContactGrid& grid) {
  const double scale = grid.smallest_in_cell() / size::kAxis;
  return scale <= kLargestWords ? std::max(scale, 1.0) : kNoWords;
}

int title_lines_of(const ContactGrid& grid, std::span<const ContactCell> cells, const ContactSheetLook& look) {
  int most = 0;
  for (std::size_t i = 0; i < cells.size(); ++i)
    most = std::max(most, int(lines_of_title(cells[i].title, grid.text_size, grid.titles[i].width(), std::numeric_limits<int>::max(), look).size()));
  return most;
}

Picture draw_contact_sheet(const ContactGrid& grid, std::span<const ContactCell> cells,
                           const ContactSheetLook& look) {
  Picture sheet;
  sheet.aspect = look.aspect;
  sheet.background = look.theme->background;
  const PageTitle page = page_title(look);
  for (std::size_t i = 0; i < page.lines.size(); ++i)
    draw_text(sheet, page.lines[i], {size::kMargin, 1 - size::kMargin - (kAscent + double(i) * kTitleLinePitch) * page.size});
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const Rect& title = grid.titles[i];
    place_picture(sheet, cells[i].picture,
                  {grid.pictures[i], kThinnestLine, kScript * grid.smallest_text, size::kMargin});
    draw_frame(sheet, grid.pictures[i], *look.theme);
    double y = title.y1 - (kAirOfTitle + kAscent) * grid.text_size;
    for (const std::string& line :
         broken_title(cells[i].title, grid.text_size, title.width(), grid.title_lines, look)) {
      draw_text(sheet, title_line(line, grid.text_size, look), {title.x0, y});
      y -= kTitlePitch * grid.text_size;
    }
  }
  return sheet;
}

}  // namespace chainreel
