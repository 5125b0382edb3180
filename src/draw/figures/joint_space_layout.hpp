// Where the parts of a joint-space figure stand: for each pose a block of its words, its chain and two squares of axes. Internal.
#pragma once

#include <vector>

#include "picture/plot.hpp"

namespace chainreel {

// What the axes of both squares say; equal for all poses.
struct JointSpaceAxes {
  Axis from_x, from_y, to_x, to_y;
};

// A pose's part of the page: its words on one line, below them three squares on one base line.
struct JointSpaceBlock {
  Rect words, chain;
  PlotFrame from, to;
};

struct JointSpaceLayout {
  int across = 1;
  double side = 0;    // of a square
  double height = 0;  // of all blocks with their words
};

// Blocks so many across `width`, no higher together than `height`: their squares are as large as these allow.
JointSpaceLayout lay_out_blocks(const JointSpaceAxes& axes, int count, int across, double width, double height,
                                const PlotStyle& style);

// Those of a layout, row by row, in the middle of the area; each square bears the titles of its axes.
std::vector<JointSpaceBlock> blocks_of(const JointSpaceLayout& layout, const JointSpaceAxes& axes, int count, const Rect& area,
                                       const PlotStyle& style);

}  // namespace chainreel
