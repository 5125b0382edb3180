#include "draw/figures/joint_space_layout.hpp"

#include <algorithm>

namespace chainreel {
namespace {

constexpr double kWordsLine = 1.7;        // of the em of its words: the line above a block
constexpr double kLeastGap = 0.5, kMostGap = 2.5;  // of the em, between the squares of a block
constexpr double kBetweenRows = 0.7, kBetweenBlocks = 2;  // of the em

// What stands about a square of axes, units of H.
struct Surroundings {
  double left = 0, right = 0;
  double title = 0;  // of y, above
  double below = 0;  // numbers and title of x
};

Surroundings about(const Axis& x, const Axis& y, const PlotStyle& style, double ems) {
  const Rect area{0, 0, ems * style.text(size::kTick), ems * style.text(size::kTick)};
  const Rect named = lay_out_plot(area, x, y, style).box;
  return {named.x0 - area.x0, area.x1 - named.x1, area.y1 - named.y1, named.y0 - area.y0};
}

// Of frames of any usual size: larger ones have more numbers, with more digits.
Surroundings about(const Axis& x, const Axis& y, const PlotStyle& style) {
  constexpr double kSmall = 10, kUsual = 20, kLarge = 40;  // em of numbers
  Surroundings most;
  for (const double ems : {kSmall, kUsual, kLarge}) {
    const Surroundings one = about(x, y, style, ems);
    most = {std::max(most.left, one.left), std::max(most.right, one.right), std::max(most.title, one.title),
            std::max(most.below, one.below)};
  }
  return most;
}

struct Measures {
  Surroundings from, to;
  double em = 0, gap = 0;

  Measures(const JointSpaceAxes& axes, const PlotStyle& style)
      : from(about(axes.from_x, axes.from_y, style)),
        to(about(axes.to_x, axes.to_y, style)),
        em(style.text(size::kAxis)),
        gap(kLeastGap * em) {}

  double beside() const { return from.left + from.right + to.left + to.right; }
  double row(double side) const { return kWordsLine * em + from.title + side + from.below; }
  double rows(int count, double side) const { return count * row(side) + (count - 1) * kBetweenRows * em; }
};

int rows_of(int count, int across) { return (count + across - 1) / across; }

}  // namespace

JointSpaceLayout lay_out_blocks(const JointSpaceAxes& axes, int count, int across, double width, double height,
                                const PlotStyle& style) {
  const Measures measures(axes, style);
  const int rows = rows_of(count, across);
  const double block = (width - (across - 1) * kBetweenBlocks * measures.em) / across;
  const double by_width = (block - measures.beside() - 2 * measures.gap) / 3;
  const double by_height = (height - measures.rows(rows, 0)) / rows;
  const double side = std::min(by_width, by_height);
  return {across, side, measures.rows(rows, side)};
}

std::vector<JointSpaceBlock> blocks_of(const JointSpaceLayout& layout, const JointSpaceAxes& axes, int count, const Rect& area,
                                       const PlotStyle& style) {
  const Measures measures(axes, style);
  const double side = layout.side, em = measures.em, pitch = (area.width() + kBetweenBlocks * em) / layout.across;
  const double free = pitch - kBetweenBlocks * em - 3 * side - measures.beside() - 2 * measures.gap;
  const double gap = std::min(measures.gap + free / 2, kMostGap * em);
  const double width = 3 * side + measures.beside() + 2 * gap;
  const double top = area.y1 - std::max(0.0, area.height() - layout.height) / 2;
  std::vector<JointSpaceBlock> blocks;
  for (int i = 0; i < count; ++i) {
    const int row = i / layout.across, column = i % layout.across;
    const double left = area.x0 + column * pitch + (pitch - kBetweenBlocks * em - width) / 2;
    const double words = top - row * (measures.row(side) + kBetweenRows * em);
    const double y1 = words - kWordsLine * em - measures.from.title, y0 = y1 - side;
    JointSpaceBlock block{{left, words - kWordsLine * em, left + width, words}, {left, y0, left + side, y1}, {}, {}};
    double x = block.chain.x1 + gap + measures.from.left;
    block.from = {axes.from_x, axes.from_y, {x, y0, x + side, y1}};
    x += side + measures.from.right + gap + measures.to.left;
    block.to = {axes.to_x, axes.to_y, {x, y0, x + side, y1}};
    blocks.push_back(block);
  }
  return blocks;
}

}  // namespace chainreel
