// Words of a plot: paragraphs, labels at the ends of curves, slopes.
#include <algorithm>
#include <cmath>

#include "picture/plot.hpp"

namespace chainreel {
namespace {


constexpr double kKeyLength = 0.042, kKeyToText = 0.010, kLeaderGap = 0.004, kLeader = 0.0014;
constexpr double kLeaderOpacity = 0.55;
constexpr double kLeastPitch = 1.1;  // of the em: letters of two lines do not touch
constexpr double kTriangleLine = size::kPlotFrame;
constexpr double kShortLastLine = 0.3, kNarrowerLines = 0.96, kNarrowestLines = 0.5;  // of the width

// Each line as long as the width lets it be.
std::vector<std::string> full_lines(const Fonts& fonts, const std::string& words, const TextStyle& style, double width) {
  std::vector<std::string> lines;
  std::string line;
  for (std::size_t at = 0; at < words.size();) {
    std::size_t end = std::min(words.find_first_of(" -", at), words.size());
    // A hyphen ends its line, but no sign of a number: "1e-10", "-3".
    while (end + 1 < words.size() && words[end] == '-' && words[end + 1] >= '0' && words[end + 1] <= '9') end = std::min(words.find_first_of(" -", end + 1), words.size());
    if (end < words.size() && words[end] == '-') ++end;
    const std::string part = words.substr(at, end - at);
    const bool is_spaced = at > 0 && words[at - 1] == ' ';
    const std::string longer = line + (is_spaced && !line.empty() ? " " : "") + part;
    if (line.empty() || lay_out_text(fonts, longer, style).advance <= width) {
      line = longer;
    } else {
      lines.push_back(line);
      line = part;
    }
    at = end + (end < words.size() && words[end] == ' ' ? 1 : 0);
  }
  if (!line.empty()) lines.push_back(line);
  return lines;
}

}  // namespace

std::vector<std::string> wrapped(const Fonts& fonts, const std::string& words, const TextStyle& style, double width) {
  std::vector<std::string> lines = full_lines(fonts, words, style, width);
  // No single word on the last line where the others can share theirs with it.
  for (double narrower = kNarrowerLines * width; lines.size() > 1 && narrower > kNarrowestLines * width; narrower *= kNarrowerLines) {
    if (lay_out_text(fonts, lines.back(), style).advance >= kShortLastLine * width) break;
    std::vector<std::string> even = full_lines(fonts, words, style, narrower);
    if (even.size() > lines.size()) break;
    lines = std::move(even);
  }
  return lines;
}

double draw_paragraph(Picture& picture, const Fonts& fonts, const std::string& words, const TextStyle& style,
                      Point top_left, double width) {
  const std::vector<std::string> lines = wrapped(fonts, words, style, width);
  for (std::size_t i = 0; i < lines.size(); ++i)
    draw_text(picture, lay_out_text(fonts, lines[i], style),
              {top_left.x, top_left.y - double(i) * kLinePitch * style.size});
  return double(lines.size()) * kLinePitch * style.size;
}

// y[i] - i pitch must not fall: pooled to means where it would, then held within the bounds.
std::vector<double> moved_apart(std::vector<double> wanted, double pitch, double low, double high) {
  struct Block {
    double sum;
    int count;
    double mean() const { return sum / count; }
  };
  std::vector<Block> blocks;
  for (std::size_t i = 0; i < wanted.size(); ++i) {
    Block block{wanted[i] - double(i) * pitch, 1};
    while (!blocks.empty() && blocks.back().mean() >= block.mean()) {
      block.sum += blocks.back().sum;
      block.count += blocks.back().count;
      blocks.pop_back();
    }
    blocks.push_back(block);
  }
  const double top = high - (double(wanted.size()) - 1) * pitch;
  std::size_t i = 0;
  for (const Block& block : blocks)
    for (int k = 0; k < block.count; ++k, ++i)
      wanted[i] = (top >= low ? std::clamp(block.mean(), low, top) : (low + top) / 2) + double(i) * pitch;
  return wanted;
}

void draw_slope_triangle(Picture& picture, const SlopeTriangle& triangle, const PlotStyle& style) {
  const Color color = style.theme->muted;
  const Point c = triangle.corner, along = c + Point{triangle.run, 0}, up = c + Point{0, triangle.rise};
  Polygon shape;
  shape.corners = {c, along, up};
  shape.count = 3;
  shape.paint = {color.faded(0.12), color, kTriangleLine};
  picture.add(shape);
  const double em = style.text(size::kTick);
  const double beside = triangle.rise > 0 ? -(kCapHeight + 0.25) * em : 0.25 * em;
  draw_text(picture, lay_out_text(*style.fonts, triangle.label, {Face::label, em, color, Align::center}),
            {c.x + triangle.run / 2, c.y + beside});
}

double end_labels_width(std::span<const std::string> texts, const PlotStyle& style) {
  double widest = 0;
  for (const std::string& text : texts)
    widest =
        std::max(widest, lay_out_words(*style.fonts, text,
                                      {Face::label, style.text(size::kTick), style.theme->ink, Align::left})
                             .advance);
  return kKeyLength + kKeyToText + widest;
}

// Ends that differ by rounding alone keep their order, whatever else a run was sampled at.
static double same_height(const EndLabel& label) {
  return std::round(label.end.y * 1e6);
}

void draw_end_labels(Picture& picture, const PlotFrame& frame, std::vector<EndLabel> labels, double x,
                     const PlotStyle& style) {
  // Of equal ends the first stands uppermost.
  std::reverse(labels.begin(), labels.end());
  std::stable_sort(labels.begin(), labels.end(),
                   [](const EndLabel& a, const EndLabel& b) { return same_height(a) < same_height(b); });
  // Closer than lines of a paragraph where the frame is low; what it cannot hold stands out above it, not below, where
  // the numbers are.
  const double em = style.text(size::kTick), count = double(std::max<std::size_t>(labels.size(), 1));
  const double half = std::clamp(frame.box.height() / count, kLeastPitch * em, kLinePitch * em) / 2;
  const double low = frame.box.y0 + half, high = std::max(frame.box.y1 - half, low + (count - 1) * 2 * half);
  std::vector<double> wanted;
  for (const EndLabel& label : labels) wanted.push_back(label.end.y);
  const std::vector<double> places =
      moved_apart(std::move(wanted), 2 * half, low, high);
  for (std::size_t i = 0; i < labels.size(); ++i) {
    const EndLabel& label = labels[i];
    const Point at = {x, places[i]};
    const Color thin = label.curve.color.faded(kLeaderOpacity * label.curve.color.a);
    picture.add(Capsule{label.end, {at.x - kLeaderGap, at.y}, kLeader / 2, {thin, {}, 0}});
    draw_key(picture, at, kKeyLength, label.curve, *style.theme);
    draw_text(picture,
              lay_out_words(*style.fonts, label.text,
                            {Face::label, em, style.theme->ink, Align::left}),
              {at.x + kKeyLength + kKeyToText, at.y - kCapHeight * em / 2});
  }
}

}  // namespace chainreel
