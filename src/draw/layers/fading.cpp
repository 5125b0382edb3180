#include "draw/layers/fading.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

#include "core/format.hpp"
#include "draw/layers/cut_numbers.hpp"
#include "draw/page/mark_labels.hpp"
#include "draw/page/sheet.hpp"

namespace chainreel {
namespace {

constexpr double kDash = 0.012, kGap = 0.008, kLeastDash = kDash / 2;
constexpr double kNumberGaps[] = {0.010, 0.018};        // units of H, beyond the end of a semi-axis
constexpr double kBesideGaps[] = {0.010, 0.018, 0.03};    // ... beside it, of one that is short
constexpr double kTieOff = 0.004, kShortTie = 0.008;      // lines of figures end so far from that end, and are no shorter
constexpr double kTiedNumberGaps[] = {0.05, 0.09, 0.13, 0.18, 0.25};  // ... of figures, with a line from there
constexpr double kTipDot = 0.0055, kTipRim = 0.0015;  // units of H: radius, and the line around it
constexpr double kFarNumberGaps[] = {0.05, 0.09, 0.13, 0.18, 0.25, 0.33, 0.42};  // ... where a robot is in the way
constexpr std::size_t kFarOfFilms = 3;  // of these: in films words stay near
constexpr double kLeastAxis = 0.008;                    // ... seen from its end, a shorter one has no room for a number
constexpr double kOwnByFar = 0.7;                       // of the way to the end of another axis: a number is that of the nearer one
constexpr double kAlongLink = 0.5;                      // cosine: an axis along the link
constexpr double kAside[] = {0, 0.8, -0.8, 1.5, -1.5};  // rad: where its number stands about that end

}  // namespace

std::optional<std::pair<double, double>> part_inside(const Rect& scene, Point p, Point q) {
  double in = 0, out = 1;
  const auto narrow = [&](double at, double way, double low, double high) {
    if (std::abs(way) < kNoLength) {
      if (at < low || at > high) out = -1;
      return;
    }
    in = std::max(in, std::min((low - at) / way, (high - at) / way));
    out = std::min(out, std::max((low - at) / way, (high - at) / way));
  };
  narrow(p.x, q.x - p.x, scene.x0, scene.x1);
  narrow(p.y, q.y - p.y, scene.y0, scene.y1);
  if (!(in < out)) return std::nullopt;
  return std::pair{in, out};
}

double way_out(const Rect& scene, Point p, Point d) {
  const auto to_edge = [](double x, double dx, double low, double high) {
    if (std::abs(dx) < kNoLength) return std::numeric_limits<double>::infinity();
    return ((dx > 0 ? high : low) - x) / dx;
  };
  return std::max(0.0,
                  std::min(to_edge(p.x, d.x, scene.x0, scene.x1), to_edge(p.y, d.y, scene.y0, scene.y1)));
}

void Spread::add(Point a) {
  xx += a.x * a.x;
  xy += a.x * a.y;
  yy += a.y * a.y;
}

double Spread::reach(Point n) const {
  return std::sqrt(std::max(0.0, n.x * n.x * xx + 2 * n.x * n.y * xy + n.y * n.y * yy));
}

std::array<Point, 2> Spread::axes() const {
  const double angle = 0.5 * std::atan2(2 * xy, xx - yy);
  const double mean = (xx + yy) / 2, deviation = std::hypot((xx - yy) / 2, xy);
  const Point u{std::cos(angle), std::sin(angle)};
  return {std::sqrt(mean + deviation) * u, std::sqrt(std::max(mean - deviation, 0.0)) * normal_to(u)};
}

double excess_of(const Rect& scene, Point center, Point v) {
  const double length = norm(v);
  if (!(length > kNoLength)) return 0;
  const Point d = (1 / length) * v;
  const double farther = std::max(way_out(scene, center, d), way_out(scene, center, -1 * d));
  return std::max(0.0, length - farther);
}

Polygon cut(const Polygon& polygon, Point through, Point inward) {
  Polygon kept;
  kept.paint = polygon.paint;
  for (int i = 0; i < polygon.count; ++i) {
    const Point p = polygon.corners[std::size_t(i)],
                q = polygon.corners[std::size_t((i + 1) % polygon.count)];
    const double at_p = dot(p - through, inward), at_q = dot(q - through, inward);
    if (at_p >= 0) kept.corners[std::size_t(kept.count++)] = p;
    if ((at_p >= 0) != (at_q >= 0)) {
      kept.corners[std::size_t(kept.count++)] = p + (at_p / (at_p - at_q)) * (q - p);
    }
  }
  return kept;
}

namespace {

// How far the ellipse of semi-variances `along` and `across` with the mixed one `mixed` reaches along the first axis where
// the second is within [low, high], which holds 0.
double farthest(double along, double mixed, double across, double low, double high) {
  if (!(across > kNoLength * kNoLength)) return std::sqrt(along);
  // Its boundary is steepest in the middle: the highest point is the highest of all, or the nearest to it that is allowed.
  const double highest = along > 0 ? mixed / std::sqrt(along) : 0, reach = std::sqrt(across);
  const double at = std::clamp(highest, std::max(low, -reach), std::min(high, reach));
  const double rest = std::max(0.0, along - mixed * mixed / across) * std::max(0.0, 1 - at * at / across);
  return mixed / across * at + std::sqrt(rest);
}

}  // namespace

Fade fade_of(const EllipseStyle& style, Point center, const Spread& spread) {
  constexpr double kOfStill = 6;  // times as quickly as where a curve grows from frame to frame
  return fade_of(style.scene, center, spread, style.fade, style.unnamed != nullptr ? kOfStill : 1);
}

Fade fade_of(const Rect& scene, Point center, const Spread& spread, double most, double per_excess) {
  const Rect room{scene.x0 - center.x, scene.y0 - center.y, scene.x1 - center.x, scene.y1 - center.y};
  // Before it gets there, so that a tip that just passes an edge is not cut flat.
  constexpr double kBefore = 0.03;
  const auto stretch = [&](double reach, double way) { return std::clamp(per_excess * (reach - way) + kBefore, 0.0, most); };
  const auto& [xx, xy, yy] = spread;
  return {scene, stretch(farthest(xx, xy, yy, -room.y1, -room.y0), -room.x0),
          stretch(farthest(xx, xy, yy, room.y0, room.y1), room.x1),
          stretch(farthest(yy, xy, xx, -room.x1, -room.x0), -room.y0),
          stretch(farthest(yy, xy, xx, room.x0, room.x1), room.y1)};
}

void draw_outline(Picture& picture, const std::vector<Point>& points, double width, Color color, const Fade& fade,
                  int clip) {
  Trail trail;
  trail.color = color;
  const auto put_down = [&] {
    if (trail.points.size() > 1) picture.add(trail, clip);
    trail.points.clear();
  };
  if (!fade.any()) {
    for (const Point p : points) trail.points.push_back({p, width, 1});
    return put_down();
  }
  for (std::size_t i = 0; i + 1 < points.size(); ++i) {
    const Point way = points[i + 1] - points[i];
    const auto inside = part_inside(fade.scene, points[i], points[i + 1]);
    if (!inside) {
      put_down();
      continue;
    }
    const auto [in, out] = *inside;
    if (in > 0) put_down();
    const int pieces = std::clamp(int((out - in) * norm(way) / kLongPiece), 1, 200);
    for (int j = trail.points.empty() ? 0 : 1; j <= pieces; ++j) {
      const Point p = points[i] + (in + (out - in) * j / pieces) * way;
      trail.points.push_back({p, width, fade.opacity_at(p)});
    }
    if (out < 1) put_down();
  }
  put_down();
}

void fill_between(Picture& picture, const std::vector<Point>& upper, const std::vector<Point>& lower, Color color,
                  const Fade& fade, int clip) {
  const std::size_t n = upper.size();
  for (std::size_t i = 0; i + 1 < n; ++i)
    fill_piece(picture, {upper[i], upper[i + 1], lower[n - 2 - i], lower[n - 1 - i]}, color, fade, clip);
}

void fill_piece(Picture& picture, const std::array<Point, 4>& corners, Color color, const Fade& fade, int clip) {
  Polygon piece;
  for (const Point p : corners) {
    const bool again = piece.count > 0 && norm(p - piece.corners[std::size_t(piece.count - 1)]) < kNoLength;
    if (!again) piece.corners[std::size_t(piece.count++)] = p;
  }
  if (piece.count > 2 && norm(piece.corners[std::size_t(piece.count - 1)] - piece.corners[0]) < kNoLength)
    --piece.count;
  if (piece.count < 3) return;
  piece.paint.fill = color;
  if (fade.any()) {
    const Rect& r = fade.scene;
    piece = cut(cut(piece, {r.x0, r.y0}, {1, 0}), {r.x1, r.y1}, {-1, 0});
    piece = cut(cut(piece, {r.x0, r.y0}, {0, 1}), {r.x1, r.y1}, {0, -1});
    piece.fade = fade;
  }
  if (piece.count >= 3) picture.add(piece, clip);
}

void draw_ellipse(Picture& picture, Point center, const std::array<Point, 2>& axes, const Paint& paint,
                  const Fade& fade, int clip) {
  const auto [u, v] = axes;
  if (norm(v) < kNoLength) {  // nothing moves along the other axis
    if (paint.stroke_width > 0) draw_axis(picture, center, u, false, paint.stroke_width, paint.stroke, fade, clip);
    return;
  }
  picture.add(Ellipse{center, std::min(1.0, kLongest / norm(u)) * u, v, paint, fade}, clip);
}

void draw_axis(Picture& picture, Point center, Point v, bool dashed, double width, Color color, const Fade& fade,
               int clip, double hole) {
  const double length = norm(v);
  if (hole > 0) hole += width / 2;  // lines have round ends
  if (!(length > std::max(kNoLength, hole))) return;
  const Point u = (1 / length) * v;
  // As far as it can be seen.
  const double reach = fade.any() ? std::min(length, kBeyond) : length;
  if (!dashed) {
    const auto draw = [&](double from, double to) {
      const Point begin = center + from * u, end = center + to * u;
      fade.any() ? draw_outline(picture, {begin, end}, width, color, fade, clip) : draw_line(picture, {begin, end}, width, color, clip);
    };
    if (!(hole > 0)) return draw(-reach, reach);
    draw(-hole, -reach);
    return draw(hole, reach);
  }
  // Symmetric about the middle, which is the middle of a dash.
  const int half_count = int((reach - kDash / 2) / (kDash + kGap)) + 1;
  for (int i = -half_count; i <= half_count; ++i) {
    const double middle = i * (kDash + kGap);
    double from = std::max(middle - kDash / 2, -reach), to = std::min(middle + kDash / 2, reach);
    if (hole > 0 && i >= 0) from = std::max(from, hole);
    if (hole > 0 && i <= 0) to = std::min(to, -hole);
    const double opacity = fade.opacity_at(center + middle * u);
    // What the end of a link leaves of a dash, next to it, would be a speck; but of a short axis it is all there is.
    const bool is_speck = hole > 0 && to - from < kLeastDash && (from == hole || to == -hole) && reach - hole > kLeastDash;
    if (from < to && opacity > 0 && !is_speck)
      draw_line(picture, {center + from * u, center + to * u}, width, color.faded(opacity), clip);
  }
}

namespace {

constexpr double kSignAir = 0.008;       // units of H: about a sign
constexpr double kCutHead = 0.018, kCutHeadWidth = 0.014;  // units of H: of an axis that goes on beyond the scene
constexpr double kAppearing = 0.02;  // units of H: an axis that leads out by so much has its length in full strength

// The text's ink with its middle as near to `at` as the scene allows.
Rect box_near(const TextLine& text, Point at, const Rect& scene) {
  const Point half{text.box.width() / 2, text.box.height() / 2};
  const Point middle{
      std::clamp(at.x, std::min(scene.x0 + half.x, scene.x1), std::max(scene.x1 - half.x, scene.x0)),
      std::clamp(at.y, std::min(scene.y0 + half.y, scene.y1), std::max(scene.y1 - half.y, scene.y0))};
  return {middle.x - half.x, middle.y - half.y, middle.x + half.x, middle.y + half.y};
}

// Half of what a text takes along the unit vector d.
double half_along(const TextLine& text, Point d) {
  return std::abs(d.x) * text.box.width() / 2 + std::abs(d.y) * text.box.height() / 2;
}

// Where it stands at the edge of the scene that a line from the center along the unit vector d leaves it through: beside the band, on either side.
std::array<Rect, 2> boxes_beside_edge(const TextLine& text, Point center, Point d, double half_width, const Rect& scene) {
  const Point side = normal_to(d), foot = center + std::max(way_out(scene, center, d) - half_along(text, d) - kSignAir, 0.0) * d;
  const double off = half_width + half_along(text, side) + kSignAir;
  return {box_near(text, foot + off * side, scene), box_near(text, foot - off * side, scene)};
}

// .. on the line itself, where there is room.
Rect box_at_edge(const TextLine& text, Point center, Point d, double half_width, const Rect& scene) {
  const double clear = half_along(text, d) + kSignAir, along = way_out(scene, center, d) - clear;
  if (along > clear + size::kEndEffector) return box_near(text, center + along * d, scene);
  // Too near to the edge: beside the band, on the side that has more room.
  const Point side = normal_to(d), foot = center + std::max(along, 0.0) * d;
  const bool left = way_out(scene, foot, side) > way_out(scene, foot, -1 * side);
  return boxes_beside_edge(text, center, d, half_width, scene)[left ? 0 : 1];
}

void draw_at_edges(Picture& picture, const TextLine& text, Point center, Point d, double half_width, const EllipseStyle& style, int clip,
                   MarkLabels* labels) {
  for (const double side : {1.0, -1.0}) {
    const Rect box = box_at_edge(text, center, side * d, half_width, style.scene);
    if (labels != nullptr)
      labels->add(kLengthAtEdge, text, box);
    else
      draw_text(picture, text, {box.x0 - text.box.x0, box.y0 - text.box.y0}, clip);
  }
}

// A film's number has one place at each frame: the plan moves it where the axis leads.
bool has_one_place(const EllipseStyle& style) {
  return style.labels != nullptr && style.unnamed == nullptr;
}

double strength_of_length(Point center, Point v, const EllipseStyle& style) {
  return style.signs ? std::min(1.0, excess_of(style.scene, center, v) / kAppearing) : 0;
}

// Where the axis of a film in the plane leaves the scene. Of its two ends the outer one counts, or where there is no link its own first.
struct CutEnd {
  Point d;                   // unit, from the middle
  double way = 0;            // until the edge
  double strength = 0;       // of what is said there, 0 where the end is inside
  std::string bound;         // said instead of the number
};

CutEnd cut_end(Point center, Point v, double length, const EllipseStyle& style) {
  if (!has_one_place(style) || style.hides || !style.signs || !(norm(v) > kNoLength)) return {};
  const Point d = dot(v, style.outward) < 0 ? -1 * unit(v) : unit(v);
  const double way = way_out(style.scene, center, d), reached = std::clamp((norm(v) - way) / kAppearing, 0.0, 1.0);
  const double strength = style.stands ? std::round(reached) : reached;
  const auto said = std::ranges::find(style.cut_numbers, length, &CutNumber::length);
  if (said == style.cut_numbers.end()) return {d, way, strength, norm(v) > kFarOut ? bound_below(length) : ""};
  return {d, way, std::min(strength, said->opacity), said->bound};
}

// Where the axis is cut its number stands on it, between the lines of the curve, which a name would cross.
TextLine text_of_length(double length, double strength, const EllipseStyle& style, const std::string& bound = "", bool is_cut = false) {
  const std::string unit = style.reading == EllipseReading::energy ? " m/s" : " kg", number = (bound.empty() ? format_digits(length, 3) : bound) + unit;
  const auto place = std::size_t(std::ranges::find(style.lengths, length) - style.lengths.begin());
  const std::string name = place < style.names.size() && !is_cut ? "$" + style.names[place] + "$ = " : "";
  return lay_out_words(*style.fonts, name + number,
                      {Face::label, scaled(size::kTick, style.text_scale), style.theme->ellipse.faded(strength),
                       Align::left});
}

TextLine infinity(const EllipseStyle& style) {
  return lay_out_text(*style.fonts, "\u221E",
                      {Face::label, size::kSymbol * style.text_scale, style.theme->ellipse, Align::left});
}

// At both ends, or at that along d alone. `more`: units of H, beside the text.
Fade fade_before(const TextLine& text, double strength, Point d, Fade fade, bool one_end = false, double more = 0) {
  const double taken = strength * (2 * half_along(text, d) + kSignAir + more);
  // Only towards edges that the axis leaves through; one that it nearly misses comes in gradually.
  const auto room = [&](double stretch, double along) { return std::min(taken * (one_end ? std::max(0.0, along) : std::abs(along)), 4 * stretch); };
  fade.scene = {fade.scene.x0 + room(fade.left, -d.x), fade.scene.y0 + room(fade.bottom, -d.y),
                fade.scene.x1 - room(fade.right, d.x), fade.scene.y1 - room(fade.top, d.y)};
  return fade;
}

// What moves with its axis needs no plan of words: it is there at every frame.
void draw_at_cut(Picture& picture, double length, Point center, const CutEnd& end, const EllipseStyle& style, int clip) {
  const TextLine text = text_of_length(length, end.strength, style, end.bound, true);
  const double half = half_along(text, end.d), nearest = std::max(style.hole, size::kEndEffector) + kSignAir + half;
  const Rect box = box_near(text, center + std::max(end.way - kCutHead - kSignAir - half, nearest) * end.d, style.scene);
  const Point anchor{box.x0 - text.box.x0, box.y0 - text.box.y0};
  draw_halo(picture, text, anchor, style.theme->background.faded(end.strength), kWordHalo, clip);
  draw_text(picture, text, anchor, clip);
  const Point tip = center + end.way * end.d, back = tip - kCutHead * end.d, side = kCutHeadWidth / 2 * normal_to(end.d);
  Polygon head{{tip, back + side, back - side}, 3, {style.theme->ellipse.faded(end.strength), {}, 0}};
  picture.add(head, clip);
}

// Where the number of an axis may stand about those of its ends, the best first, and its line.
void add_places(MarkWord& word, Point center, Point v, std::span<const double> ends, const EllipseStyle& style, std::span<const Point> others) {
  const bool is_figure = style.unnamed != nullptr, has_lines = is_figure && !style.hides;
  const auto to_ends = [&](const Rect& place, Point axis) {
    const Point ahead = center + axis, behind = center - axis;
    return std::min(norm(nearest_in(place, ahead) - ahead), norm(nearest_in(place, behind) - behind));
  };
  const auto can_stand = [&](const Rect& place) {
    return is_within(place, style.scene) &&
           std::ranges::all_of(others, [&](Point other) { return to_ends(place, v) < kOwnByFar * to_ends(place, other); });
  };
  // That of an axis shorter than its words are high stands beside it: beyond its end it would stand nearer to the tip of the other one.
  if (norm(v) < word.line.box.height())
    for (const double gap : kBesideGaps)
      for (const double side : ends) {
        const Point end = center + side * v;
        const Rect place = place_beyond(word.line, end, gap, {std::copysign(1.0, side * v.x), 0});
        if (std::abs(v.x) > std::abs(v.y) / 2 && can_stand(place)) word.places.push_back(place);
      }
  for (const double gap : kNumberGaps)
    for (const double side : ends) {
      const Point d = side * unit(v), end = center + side * v;
      for (const double aside : kAside) {
        const Rect place = place_beyond(word.line, end, gap, std::cos(aside) * d + std::sin(aside) * normal_to(d));
        if (can_stand(place)) word.places.push_back(place);
      }
    }
  // In space the robot may lie around the ends of an axis.
  if (style.hides) {
    const Point end = center + v;
    for (const double gap : std::span(kFarNumberGaps).first(is_figure ? std::size(kFarNumberGaps) : kFarOfFilms))
      for (const Point tip : {end, center - v})
        for (const Rect& place : places_about(word.line, tip, gap, unit(tip - center)))
          if (is_within(place, style.scene)) word.places.push_back(place);
    word.tie = Tie{end, kTieOff, style.theme->ellipse, center - v, kShortTie};
  }
  if (!has_lines) return;
  for (const double share : {0.7, 0.4})
    for (const double end : ends)
      for (const double side : {1.0, -1.0})
        for (const double gap : kNumberGaps) {
          const Rect place = place_beyond(word.line, center + end * share * v, gap + style.hole, side * normal_to(unit(v)));
          if (can_stand(place)) word.places.push_back(place);
        }
  for (const double gap : kTiedNumberGaps)
    for (const double side : ends)
      for (const Rect& place : places_about(word.line, center + side * v, gap, side * unit(v)))
        if (is_within(place, style.scene)) word.places.push_back(place);
  // However near: beside the end of an axis there may be a link, too.
  word.tie = Tie{center + v, kTieOff, style.theme->ellipse, center - v, kShortTie};
}

// Of an ellipsoid numbers stand before none of its lines, unless there is no other place.
void close_covered(MarkWord& word, const EllipseStyle& style) {
  if (!style.covers) return;
  for (const Rect& place : word.places) word.closed.push_back(style.covers(place));
  if (std::ranges::find(word.closed, false) == word.closed.end()) word.closed.clear();
}

}  // namespace

bool is_cut(Point center, Point v, const EllipseStyle& style) {
  return cut_end(center, v, 0, style).strength > 0;
}

void draw_infinities(Picture& picture, Point center, Point d, double half_width, const EllipseStyle& style, int clip) {
  if (!style.signs) return;
  draw_at_edges(picture, infinity(style), center, d, half_width, style, clip, nullptr);
}

void draw_length(Picture& picture, Point center, Point v, std::size_t axis, double length, double half_width, const EllipseStyle& style, int clip,
                 std::span<const Point> others) {
  if (const CutEnd end = cut_end(center, v, length, style); end.strength > 0) return draw_at_cut(picture, length, center, end, style, clip);
  const bool has_no_numbers = style.labels == nullptr && style.unnamed != nullptr;  // a figure with panels too small for them
  const double strength = strength_of_length(center, v, style);
  if (strength > 0 && !has_no_numbers && !has_one_place(style))
    draw_at_edges(picture, text_of_length(length, strength, style), center, unit(v), half_width, style, clip, style.labels);
  if (style.labels == nullptr || !style.signs) return;
  // In a figure there is room for a line from the number to what it is of.
  const bool is_figure = style.unnamed != nullptr, has_lines = is_figure && !style.hides;
  if (norm(v) < (is_figure ? kNoLength : kLeastAxis)) {
    if (style.unnamed != nullptr) ++*style.unnamed;
    return;
  }
  // In space the ends of axes are not seen as such: each has a dot, to which its number leads.
  if (style.hides)
    for (const Point tip : {center + v, center - v})
      picture.add(Ellipse{tip, {kTipDot, 0}, {0, kTipDot}, {style.theme->ellipse, style.theme->background, kTipRim}}, clip);
  MarkWord word{"semi-axis " + std::to_string(axis + 1), text_of_length(length, 1, style), {}};
  word.anchor = center;  // its ends may change sides
  if (strength > 0 && has_one_place(style))
    for (const double side : {1.0, -1.0})
      for (const Rect& place : boxes_beside_edge(word.line, center, side * unit(v), half_width, style.scene)) word.places.push_back(place);
  // Of a figure the outer end of an axis along the link: at the other one its number would be taken for the link's.
  std::vector<double> ends{1, -1};
  bool leaves_scene = false;
  if (const double along = dot(unit(v), style.outward); has_lines && std::abs(along) > kAlongLink * norm(style.outward) && norm(style.outward) > 0) {
    if (along < 0) v = -1 * v;
    ends = {1};
    leaves_scene = !contains(style.scene, center + v);
    if (leaves_scene && !(strength > 0))
      for (const Rect& place : boxes_beside_edge(word.line, center, unit(v), half_width, style.scene)) word.places.push_back(place);
  }
  add_places(word, center, v, ends, style, others);
  // Rather at the inner end than nowhere.
  if (ends.size() == 1) add_places(word, center, v, std::vector<double>{-1}, style, others);
  close_covered(word, style);
  if (leaves_scene) word.tie.reset();  // beside it where it leaves the scene
  if (!word.places.empty())
    style.labels->add(std::move(word));
  else if (style.unnamed != nullptr && !(strength_of_length(center, v, style) > 0))
    ++*style.unnamed;
}

Fade fade_before_length(Point center, Point v, double length, const Fade& whole, const EllipseStyle& style) {
  if (const CutEnd end = cut_end(center, v, length, style); end.strength > 0)
    return fade_before(text_of_length(length, end.strength, style, end.bound, true), end.strength, end.d, whole, true, kCutHead + kSignAir);
  const double strength = strength_of_length(center, v, style);
  if (!(strength > 0) || has_one_place(style)) return whole;
  return fade_before(text_of_length(length, strength, style), strength, unit(v), whole);
}

Fade fade_before_infinity(Point d, const Fade& whole, const EllipseStyle& style) {
  return fade_before(infinity(style), style.signs ? 1 : 0, d, whole);
}

}  // namespace chainreel
