#include "draw/charts/chart_names.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "picture/formula_words.hpp"

namespace chainreel {
namespace {

constexpr double kNear = 2 * kClearance;
constexpr double kAlone = 0.036;     // units of H: a curve that far from a name is not thought to be meant
constexpr double kAloneEnd = 0.008;  // and from a leader
constexpr double kLeaderLine = 0.0014, kLeaderDot = 0.0032, kLeaderOpacity = 0.7;
constexpr double kBetweenNames = 0.018;  // else two read as one
constexpr double kBesideLeader = 0.006, kOffLeader = 0.012;
constexpr std::array kLeaderLengths = {0.025, 0.04, 0.055, 0.07, 0.085, 0.1, 0.12, 0.14};
constexpr int kLeaderWays = 24;
constexpr double kSteep = 0.4;  // cosine: leaders come from below or above
// What a name pays, units of H of a leader's length.
constexpr double kNotAnEnd = 0.02, kForLeader = 0.03, kAside = 0.005, kForNone = 0.5;

// Of a curve the points that a frame shows, the most exact one first.
std::vector<Point> shown_points(const PlotFrame& frame, const ChartCurve& curve, ChartCost cost) {
  std::vector<const ChartPoint*> points;
  for (const ChartPoint& point : curve.points)
    if (!point.failed && !point.is_apart && point.error >= frame.x.low && frame.can_show({point.error, cost_of(point, cost)})) points.push_back(&point);
  std::ranges::stable_sort(points, {}, &ChartPoint::error);
  std::vector<Point> places;
  for (const ChartPoint* const point : points) places.push_back(frame.at({point->error, cost_of(*point, cost)}));
  return places;
}

std::string name_of(const ChartCurve& curve) {
  return without_formulas(curve.title.empty() ? curve.method : curve.title);
}

Color color_of(const WorkPrecision& data, std::size_t curve, const ChartLook& look) {
  const int index = data.curves[curve].look;
  return curve_style(index < 0 ? int(curve) : index, *look.theme).color;
}

struct Word {
  TextLine line;
  double em;

  Word(const std::string& text, Color color, const ChartLook& look)
      : line(lay_out_text(*look.fonts, text, {Face::label, look.plot_style().text(size::kTick), color, Align::left})), em(look.plot_style().text(size::kTick)) {}
  double high() const { return kCapHeight * em; }
  Rect box_at(Point p) const { return {p.x, p.y - 0.2 * em, p.x + line.advance, p.y + em}; }
};

bool is_alone(const Rect& box, const Obstacles& obstacles, int curve) {
  return std::ranges::none_of(obstacles.lines, [&](Obstacles::Line other) {
    return other.curve >= 0 && other.curve != curve && cut_segment(box, other.a, other.b);
  });
}

// So far from a point, where neither curves nor other words are; else nowhere. Returns whether it stands.
bool draw_word_beside(Picture& picture, const Word& word, Point at, Obstacles& obstacles, double off = kNear) {
  const double wide = word.line.advance, high = word.high();
  for (const Point corner : {Point{off, -high / 2}, {-off - wide, -high / 2}, {-wide / 2, off}, {-wide / 2, -off - high}, {off, off},
                             {off, -off - high}, {-off - wide, off}, {-off - wide, -off - high}}) {
    const Rect box = word.box_at(at + corner);
    if (!obstacles.is_free(box)) continue;
    draw_text(picture, word.line, at + corner);
    obstacles.boxes.push_back(box);
    return true;
  }
  return false;
}

// Where a name may stand.
struct GreyPlace {
  Point corner;
  Rect box;
  Point dot, foot;  // the ends of its leader; the same: it has none
  double cost = 0;

  bool has_leader() const { return norm(foot - dot) > 0; }
};

bool segments_meet(Point a, Point b, Point c, Point d) {
  const auto side = [](Point from, Point to, Point p) { return cross(to - from, p - from); };
  return side(a, b, c) * side(a, b, d) <= 0 && side(c, d, a) * side(c, d, b) <= 0;
}

bool runs_through(const GreyPlace& place, const Rect& box) {
  Point a = place.dot, b = place.foot;
  return place.has_leader() && cut_segment(widened(box, kOffLeader), a, b);
}

bool do_collide(const GreyPlace& a, const GreyPlace& b) {
  return overlap(widened(a.box, kBetweenNames), b.box) || runs_through(a, b.box) || runs_through(b, a.box) ||
         (a.has_leader() && b.has_leader() && segments_meet(a.dot, a.foot, b.dot, b.foot));
}

double between(Point a, Point b, Point c, Point d) {
  return segments_meet(a, b, c, d) ? 0 : std::min({distance_to(a, c, d), distance_to(b, c, d), distance_to(c, a, b), distance_to(d, a, b)});
}

// Whether a leader from a point of a curve keeps off others, comes not to this one again, and runs through no word.
bool is_clear(const GreyPlace& place, const Obstacles& obstacles, int curve) {
  const Point off = place.dot + kNear / 2 * unit(place.foot - place.dot);
  return std::ranges::none_of(obstacles.lines, [&](const Obstacles::Line& line) {
           return line.curve != kNoCurve && (line.curve == curve ? segments_meet(off, place.foot, line.a, line.b)
                                                                 : between(place.dot, place.foot, line.a, line.b) < kAloneEnd);
         }) &&
         std::ranges::none_of(obstacles.boxes, [&](const Rect& box) { return runs_through(place, box); });
}

// The cheapest first.
std::vector<GreyPlace> places_of(const Word& word, const std::vector<Point>& points, int curve, const Obstacles& obstacles, double text_scale) {
  const double wide = word.line.advance, high = word.high();
  std::vector<GreyPlace> places;
  for (const Point& at : points) {
    const double of_point = &at == &points.front() || &at == &points.back() ? 0 : kNotAnEnd;
    for (const Point by : {Point{kNear, -high / 2}, {-kNear - wide, -high / 2}, {-wide / 2, kNear}, {-wide / 2, -kNear - high}}) {
      const Rect box = word.box_at(at + by);
      if (obstacles.is_free(box) && is_alone(widened(box, kAlone), obstacles, curve)) places.push_back({at + by, box, at, at, of_point});
    }
    for (const double length : kLeaderLengths)
      for (int k = 0; k < kLeaderWays; ++k) {
        const double angle = 2 * std::numbers::pi * k / kLeaderWays;
        const Point way{std::cos(angle), std::sin(angle)}, foot = at + text_scale * length * way;
        // It meets the middle of the side that it comes from, or an end of that.
        std::vector<Point> corners;
        if (std::abs(way.x) < kSteep)
          for (const double share : {0.5, 0.15, 0.85}) corners.push_back(foot + Point{-share * wide, way.y > 0 ? kBesideLeader : -kBesideLeader - high});
        else
          corners.push_back(foot + Point{way.x > 0 ? kBesideLeader : -kBesideLeader - wide, -high / 2});
        for (const Point& corner : corners) {
          const GreyPlace place{corner, word.box_at(corner), at, foot, of_point + kForLeader + length + (&corner == &corners.front() ? 0 : kAside)};
          if (obstacles.is_free(place.box) && is_clear(place, obstacles, curve)) places.push_back(place);
        }
      }
  }
  std::ranges::stable_sort(places, {}, &GreyPlace::cost);
  return places;
}

using Arrangement = std::vector<const GreyPlace*>;  // of each name, nullptr without one

// Each in turn from `first` on, up or down the list, takes the cheapest place that those before leave.
Arrangement arranged(const std::vector<std::vector<GreyPlace>>& places, std::size_t first, bool is_down) {
  const std::size_t count = places.size();
  Arrangement taken(count, nullptr);
  for (std::size_t k = 0; k < count; ++k) {
    const std::size_t i = is_down ? (first + count - k) % count : (first + k) % count;
    const auto free = std::ranges::find_if(places[i], [&](const GreyPlace& place) {
      return std::ranges::none_of(taken, [&](const GreyPlace* other) { return other != nullptr && do_collide(place, *other); });
    });
    if (free != places[i].end()) taken[i] = &*free;
  }
  return taken;
}

double price_of(const Arrangement& names) {
  double cost = 0;
  for (const GreyPlace* const place : names) cost += place != nullptr ? place->cost : kForNone;
  return cost;
}

}  // namespace

std::string setting_of(const std::string& label) {
  const std::size_t comma = label.rfind(", ");
  std::string text = comma == std::string::npos ? label : label.substr(comma + 2);
  for (const auto& [word, shorter] : {std::pair{"step ", "h = "}, {"tolerance ", "tol. "}})
    if (text.starts_with(word)) text.replace(0, std::string(word).size(), shorter);
  return text;
}

// Colour ties them to curves from a line away, too: beside a flat one no nearer place is free.
bool draw_names_in_colour(Picture& picture, const PlotFrame& frame, const WorkPrecision& data, ChartCost cost, Obstacles& obstacles,
                          const ChartLook& look) {
  const double em = look.plot_style().text(size::kTick);
  bool all = true;
  for (std::size_t k = 0; k < data.curves.size(); ++k) {
    if (!data.curves[k].is_lit) continue;
    const std::vector<Point> points = shown_points(frame, data.curves[k], cost);
    const Word word(name_of(data.curves[k]), color_of(data, k, look), look);
    all &= points.empty() || std::ranges::any_of(std::array{kNear, kNear + 0.4 * em, kNear + em}, [&](double off) {
      return std::ranges::any_of(points, [&](Point at) { return draw_word_beside(picture, word, at, obstacles, off); });
    });
  }
  return all;
}

void draw_settings(Picture& picture, const PlotFrame& frame, const WorkPrecision& data, ChartCost cost, Obstacles& obstacles,
                   const ChartLook& look) {
  for (std::size_t k = 0; k < data.curves.size(); ++k) {
    if (!data.curves[k].is_lit) continue;
    std::vector<const ChartPoint*> points;
    for (const ChartPoint& point : data.curves[k].points)
      if (!point.failed && !point.is_apart && point.error >= frame.x.low && frame.can_show({point.error, cost_of(point, cost)})) points.push_back(&point);
    if (points.empty()) continue;
    const auto [exact, crude] = std::ranges::minmax(points, {}, &ChartPoint::error);
    for (const ChartPoint* const point : {exact, crude}) {
      const std::string setting = setting_of(point->label);
      if (!setting.empty()) draw_word_beside(picture, Word(setting, color_of(data, k, look), look), frame.at({point->error, cost_of(*point, cost)}), obstacles);
      if (exact == crude) break;
    }
  }
}

void draw_grey_names(Picture& picture, const PlotFrame& frame, const WorkPrecision& data, ChartCost cost, Obstacles& obstacles,
                     const ChartLook& look) {
  std::vector<Word> words;
  std::vector<std::vector<GreyPlace>> places;
  // From the ends of curves in colour lines lead to their names, to the right.
  for (std::size_t k = 0; k < data.curves.size(); ++k) {
    const std::vector<Point> points = data.curves[k].is_lit ? shown_points(frame, data.curves[k], cost) : std::vector<Point>();
    if (!points.empty()) obstacles.lines.push_back({points.back(), {frame.box.x1, points.back().y}, int(k)});
  }
  for (std::size_t k = 0; k < data.curves.size(); ++k) {
    if (data.curves[k].is_lit) continue;
    words.emplace_back(name_of(data.curves[k]), look.theme->muted, look);
    places.push_back(places_of(words.back(), shown_points(frame, data.curves[k], cost), int(k), obstacles, look.text_scale));
  }
  Arrangement best(words.size(), nullptr);
  for (std::size_t first = 0; first < words.size(); ++first)
    for (const bool is_down : {false, true})
      if (Arrangement names = arranged(places, first, is_down); price_of(names) < price_of(best)) best = std::move(names);
  for (std::size_t i = 0; i < words.size(); ++i) {
    if (best[i] == nullptr) continue;
    if (best[i]->has_leader()) {
      picture.add(Capsule{best[i]->dot, best[i]->foot, kLeaderLine / 2, {look.theme->muted.faded(kLeaderOpacity), {}, 0}});
      picture.add(Ellipse{best[i]->dot, {kLeaderDot, 0}, {0, kLeaderDot}, {look.theme->muted, {}, 0}});
    }
    draw_text(picture, words[i].line, best[i]->corner);
    obstacles.boxes.push_back(best[i]->box);
  }
}

}  // namespace chainreel
