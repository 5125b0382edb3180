// Where the names of poses stand that share one picture. Internal.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "draw/page/mark_labels.hpp"
#include "draw/page/word_plan.hpp"
#include "picture/picture.hpp"
#include "picture/theme.hpp"

namespace chainreel {

// What is named: a place on the page with the curve about it, as two perpendicular semi-axes, the longer one first; those of open
// ones may lead beyond the page.
struct NamedPlace {
  Point tip;
  TextLine name;
  std::array<Point, 2> curve{};
};
// What names keep off, if they can: the links of all poses, `half_width` wide to each side.
struct Bar {
  Point a, b;
  double half_width = 0;
};

struct PlacedName {
  StandingWord word;  // of opacity 0 where it has no place without covering another
  bool has_leader = false;  // its place alone would not tell whose name it is
  Point to{};               // where that leads: to the tip, or to an outer end of its curve
};

// For each its place within `area`: near to its own tip or to an end of its curve, off other names, tips, curves, bars and `lines`, with
// leaders that cross no other. The same for the same places.
std::vector<PlacedName> place_names(std::span<const NamedPlace> places, std::span<const Bar> bars, const Rect& area,
                                    std::span<const Obstacle> lines = {});

// Whether the curves of two places meet, or one lies in the other.
bool curves_overlap(const NamedPlace& one, const NamedPlace& other);

// The words where they lie on nothing of what was drawn since item `first`, nor on `obstacles`; how many have no such place.
// `most_or_none`: where several things are named a few words would be taken for those of their neighbours.
int draw_clear_of(Picture& picture, std::size_t first, const MarkLabels& words, std::vector<Obstacle> obstacles, const Rect& scene,
                  const Theme& theme, int clip, bool most_or_none = false);

}  // namespace chainreel
