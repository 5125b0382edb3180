// Curves that lead out of their scene and fade towards its edge. Internal.
#pragma once

#include <array>
#include <cmath>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "draw/layers/ellipse.hpp"
#include "draw/robot/joints.hpp"

namespace chainreel {

// On the page, axes shorter than this have no direction (an axis of an ellipsoid towards the viewer).
inline constexpr double kNoLength = 1e-9;
inline constexpr double kEllipseFill = 0.16;     // opacity
inline constexpr double kSilhouetteFill = 0.12;  // of an ellipsoid
inline constexpr double kLineEdge = 0.0016;  // units of H: of the background's colour, about lines that lie over a chain
inline constexpr double kLongPiece = 0.02;  // units of H: fading lines change their opacity in steps of this length
inline constexpr double kLongest = 60;  // units of H: an axis that is longer changes nothing on the page that can be seen
inline constexpr double kBeyond = 3;        // units of H: farther than any corner of a page from any place on it

inline bool contains(const Rect& r, Point p) {
  return p.x >= r.x0 && p.x <= r.x1 && p.y >= r.y0 && p.y <= r.y1;
}

// How far from p along the unit vector d the scene ends; 0 where p is outside and d leads away.
double way_out(const Rect& scene, Point p, Point d);

// A symmetric 2 x 2 matrix: the sum of a a^T over semi-axes a on the page, of which sqrt(n^T S n) is how far their ellipse
// reaches along the unit vector n.
struct Spread {
  double xx = 0, xy = 0, yy = 0;

  void add(Point a);
  double reach(Point n) const;
  // The semi-axes of the ellipse, the longer one first: of the silhouette of an ellipsoid with the projected semi-axes a;
  // of two perpendicular ones they themselves.
  std::array<Point, 2> axes() const;
};

// How far the nearer end of the axis from center - v to center + v lies outside of the scene, units of H; 0 where one
// end is inside, so that the length of the axis can be seen.
double excess_of(const Rect& scene, Point center, Point v);

// The parameters in [0, 1] between which the line from p to q is in the scene; absent where it misses it.
std::optional<std::pair<double, double>> part_inside(const Rect& scene, Point p, Point q);

// The part of a convex polygon where dot(p - through, inward) >= 0; one corner more at most.
Polygon cut(const Polygon& polygon, Point through, Point inward);

// Towards each edge through which the ellipse leaves the scene, over what it leads out there and `most` at most: of a curve
// that grows beyond its scene ever more fades, and nothing is cut.
Fade fade_of(const Rect& scene, Point center, const Spread& spread, double most, double per_excess = 1);
// The same as its style has it: of still figures soon over the whole stretch, since what is cut by little would look cut off.
Fade fade_of(const EllipseStyle& style, Point center, const Spread& spread);

// A line through the points, fading; of one that fades only the part in the scene.
void draw_outline(Picture& picture, const std::vector<Point>& points, double width, Color color, const Fade& fade,
                  int clip);

// The inside of a curve of two halves over the same places along its long axis: lower[n - 1 - i] lies opposite of
// upper[i]. Convex pieces, each faded like the lines around it.
void fill_between(Picture& picture, const std::vector<Point>& upper, const std::vector<Point>& lower, Color color,
                  const Fade& fade, int clip);
void fill_piece(Picture& picture, const std::array<Point, 4>& corners, Color color, const Fade& fade, int clip);

// An ellipse of two perpendicular semi-axes, the longer one first; the axis alone where the other has no length.
void draw_ellipse(Picture& picture, Point center, const std::array<Point, 2>& axes, const Paint& paint,
                  const Fade& fade, int clip);

// A line from center - v to center + v, fading; dashes are symmetric about the middle. Nothing is drawn nearer to it than `hole`.
void draw_axis(Picture& picture, Point center, Point v, bool dashed, double width, Color color, const Fade& fade,
               int clip, double hole = 0);

// What stands at the ends of axes that lead out of the scene: an infinity sign where the mass is infinite, else the
// length of the axis. Internal.

// Infinity signs on the way from the centre along d and against it, off the end effector's disc; nothing where the
// style wants none.
void draw_infinities(Picture& picture, Point center, Point d, double half_width, const EllipseStyle& style, int clip);

// "7.91 kg", of the axis from center - v to center + v, `length` in the unit of the reading. Of a film in the plane where its outer end has left the scene
// on the axis there, before a head that points on; of a figure where it leaves the scene at both of its ends at each of them; stronger the further it leads out; else, of a style with labels, as a word of the film beyond
// the end of v or else at the other one, where either is in the scene; in flat figures nowhere where it could be taken for that of another
// axis, whose vectors are `others`. `axis`: which one it is, by the size of its length: each has a word of its own from frame to frame.
void draw_length(Picture& picture, Point center, Point v, std::size_t axis, double length, double half_width, const EllipseStyle& style, int clip,
                 std::span<const Point> others = {});

// Whether a film has the length of this axis where it leaves the scene.
bool is_cut(Point center, Point v, const EllipseStyle& style);

// The name of such numbers among words.
inline constexpr const char* kLengthAtEdge = "length";

// How the lines of such axes fade, those of a curve that fades as `whole`, to leave room for what is written at their ends.
Fade fade_before_length(Point center, Point v, double length, const Fade& whole, const EllipseStyle& style);
Fade fade_before_infinity(Point d, const Fade& whole, const EllipseStyle& style);

// Of the inside of a curve.
inline Color fill_of(const EllipseStyle& style, double opacity = kEllipseFill) {
  return style.is_filled ? style.theme->ellipse.faded(opacity) : Color{};
}

// One stroke of the lines: those of a curve over a chain are drawn twice, first wider in the background's colour.
struct Stroke {
  Color color;
  double wider = 0;

  double width(double line, const EllipseStyle& style) const { return style.lines * line + wider; }
};
// Calls draw(stroke) for those that the style asks for.
template <class Draw>
void for_each_stroke(const EllipseStyle& style, Draw draw) {
  if (style.part == EllipsePart::above) draw(Stroke{style.theme->background, 2 * style.lines * kLineEdge});
  if (style.draws_above()) draw(Stroke{style.theme->ellipse, 0});
}

}  // namespace chainreel
