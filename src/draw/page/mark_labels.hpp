// Words over a chain that belong to marks: arrows, arcs, axes, poses. They are drawn above all marks, moved
// apart where they would overlap, and left out where there is no room near what they name.
#pragma once

#include <vector>

#include "picture/picture.hpp"
#include "picture/text.hpp"

namespace chainreel {

class MarkLabels {
 public:
  // `box`: where the ink of the line is wished, units of H. A plate sets it off from what lies below.
  void add(TextLine line, const Rect& box, bool plate);

  // Inside `area`; labels that are wished outside of it are left out, and those that would have to go farther
  // than `farthest` heights of their own.
  void draw(Picture& picture, const Rect& area, Color background, int clip, double farthest = 1.5) const;

 private:
  struct Label {
    TextLine line;
    Rect wish;
    bool plate = false;
  };
  std::vector<Label> labels_;
};

// Boxes moved apart, as little as need be, within `area`: the places of those that can stand, and nothing for
// those left out. The same for the same boxes, whatever was drawn before.
struct PlacedBox {
  Rect box;
  bool stands = true;
};
std::vector<PlacedBox> boxes_apart(const std::vector<Rect>& wishes, const Rect& area, double air,
                                   double farthest);

}  // namespace chainreel
