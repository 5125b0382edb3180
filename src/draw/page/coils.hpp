// Springs and dampers as shapes of the page. `size`: of what has a width of its own, 1 at the theme's sizes.
#pragma once

#include "picture/picture.hpp"

namespace chainreel {

// A coil from a to b: its windings go apart and together, their number stays. `casing`: of a wider line below it, over bodies and rails; one that is
// transparent is none.
void draw_coil(Picture& picture, Point a, Point b, double size, Color color, int clip, Color casing = {});
// A cylinder that is fixed at a, with a piston whose rod ends at b.
void draw_dashpot(Picture& picture, Point a, Point b, double size, Color color, Color inside, int clip);

// A circle about a joint as the page shows it, of radius 1: center + cos(angle) u + sin(angle) w.
struct PageTurn {
  Point center, u, w;

  Point at(double radius, double angle) const;
};

inline constexpr double kSpiralOuter = 0.046;  // radius, units of H

// A spiral whose inner end turns with the link, at angle q, and whose outer end is fixed: where q = rest it has its own
// number of windings. `casing`: as of a coil.
void draw_spiral(Picture& picture, const PageTurn& turn, double q, double rest, double size, Color color, int clip, Color casing = {});
inline constexpr double kVanesOuter = 0.0285;    // radius, units of H
inline constexpr double kInsideOfVanes = 0.25;   // of the colour's strength
// A ring about the joint in which vanes turn with the link.
void draw_vanes(Picture& picture, const PageTurn& turn, double q, double size, Color color, Color inside, int clip);
// A coil along the arc from one angle to another, as flat as they are near.
void draw_round_coil(Picture& picture, const PageTurn& turn, double radius, double from, double to, double size,
                     Color color, int clip, Color casing = {});

}  // namespace chainreel
