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

// A word, or a part of one, as it stands in a line.
struct Piece {
  std::string text;
  double space = 0, width = 0;  // before it, where it does not begin a line
};

// A word that is wider than a line ends behind its hyphens.
std::vector<std::string> parts_of(const std::string& word, bool is_wide) {
  std::vector<std::string> parts{""};
  const bool may_part = is_wide && word.find('$') == std::string::npos;
  for (std::size_t i = 0; i < word.size(); ++i) {
    parts.back() += word[i];
    if (may_part && word[i] == '-' && i > 0 && i + 1 < word.size()) parts.emplace_back();
  }
  return parts;
}

// Where lines end, each as long as the width lets it be, and one word at least: the words behind them.
std::vector<std::size_t> ends_within(const std::vector<Piece>& words, double width) {
  std::vector<std::size_t> ends;
  double line = 0;
  for (std::size_t i = 0; i < words.size(); ++i) {
    const bool begins = ends.empty() ? i == 0 : ends.back() == i;
    if (!begins && line + words[i].space + words[i].width > width) {
      ends.push_back(i);
      line = words[i].width;
    } else {
      line += (begins ? 0 : words[i].space) + words[i].width;
    }
  }
  ends.push_back(words.size());
  return ends;
}

}  // namespace

TextLine lay_out_within(const Fonts& fonts, const std::string& text, const TextStyle& style, double width) {
  const auto width_of = [&](const std::string& words) { return lay_out_words(fonts, words, style).advance; };
  const double space = width_of("a b") - width_of("ab");
  std::vector<Piece> pieces;
  for (const std::string& word : formula_words(text)) {
    const std::vector<std::string> parts = parts_of(word, width_of(word) > width);
    for (const std::string& part : parts) pieces.push_back({part, &part == &parts.front() ? space : 0, width_of(part)});
  }
  std::vector<std::size_t> ends = ends_within(pieces, width);
  for (double narrower = kNarrower * width; narrower > kNarrowest * width; narrower *= kNarrower) {
    std::vector<std::size_t> even = ends_within(pieces, narrower);
    if (even.size() > ends.size()) break;
    ends = std::move(even);
  }
  TextLine whole;
  std::size_t first = 0;
  for (std::size_t i = 0; i < ends.size(); first = ends[i++]) {
    std::string line;
    for (std::size_t k = first; k < ends[i]; ++k) line += (k > first && pieces[k].space > 0 ? " " : "") + pieces[k].text;
    append(whole, lay_out_words(fonts, line, style), {0, -double(i) * kLeading * style.size});
  }
  return whole;
}

}  // namespace chainreel
