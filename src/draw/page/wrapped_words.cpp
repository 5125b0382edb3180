#include "draw/page/wrapped_words.hpp"

#include "picture/formula_words.hpp"
#include "picture/picture.hpp"

namespace chainreel {
namespace {

constexpr double kNarrower = 0.96, kNarrowest = 0.3;

// Adds a line's ink at a place.
void append(TextLine& line, const TextLine& piece, Point at) {
  Picture ink;
  draw_text(ink, piece, at);
  const bool is_first = line.runs.empty() && line.marks.empty();
  for (Item& item : ink.items) {
    if (auto* run = std::get_if<GlyphRun>(&item.shape))
      line.runs.push_back(std::move(*run));
    else
      line.marks.push_back(std::move(item.shape));
  }
  const Rect box = moved(piece.box, at);
  line.box = is_first ? box : around(line.box, box);
}

// Where lines end, each as long as the width lets it be, and one word at least: the words behind them.
std::vector<std::size_t> ends_within(const std::vector<double>& words, double space, double width) {
  std::vector<std::size_t> ends;
  double line = 0;
  for (std::size_t i = 0; i < words.size(); ++i) {
    const bool begins = ends.empty() ? i == 0 : ends.back() == i;
    if (!begins && line + space + words[i] > width) {
      ends.push_back(i);
      line = words[i];
    } else {
      line += (begins ? 0 : space) + words[i];
    }
  }
  ends.push_back(words.size());
  return ends;
}

}  // namespace

TextLine lay_out_within(const Fonts& fonts, const std::string& text, const TextStyle& style, double width) {
  const std::vector<std::string> words = formula_words(text);
  std::vector<double> widths;
  for (const std::string& word : words) widths.push_back(lay_out_words(fonts, word, style).advance);
  const double space = lay_out_words(fonts, "a b", style).advance - lay_out_words(fonts, "ab", style).advance;
  std::vector<std::size_t> ends = ends_within(widths, space, width);
  for (double narrower = kNarrower * width; narrower > kNarrowest * width; narrower *= kNarrower) {
    std::vector<std::size_t> even = ends_within(widths, space, narrower);
    if (even.size() > ends.size()) break;
    ends = std::move(even);
  }
  TextLine whole;
  std::size_t first = 0;
  for (std::size_t i = 0; i < ends.size(); first = ends[i++]) {
    std::string line;
    for (std::size_t k = first; k < ends[i]; ++k) line += (k > first ? " " : "") + words[k];
    append(whole, lay_out_words(fonts, line, style), {0, -double(i) * kLeading * style.size});
  }
  return whole;
}

}  // namespace chainreel
