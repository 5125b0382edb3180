// Each name has places in 24 directions about its tip, ever farther out. Names take the cheapest one in turn, given where the
// others stand, until none moves: their cost falls with each move, so that comes to an end.
#include "draw/figures/pose_labels.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "draw/figures/pose_panels.hpp"
#include "draw/layers/fading.hpp"

namespace chainreel {
namespace {

constexpr int kDirections = 24, kCurvePlaces = 48;
constexpr double kOff[] = {0.022, 0.04, 0.06, 0.09, 0.13, 0.18, 0.24};  // units of H, from the tip to the name
constexpr int kRounds = 20;
constexpr double kBetweenNumbers = 0.8;  // of their height
constexpr double kAirOfName = 0.010, kTipAir = 0.010;  // units of H, around a name and a tip
constexpr double kOtherCurve = 0.025;  // a name that is so near to the curve of another would be taken for that one's
// What a name pays for what it does, inwards from the middle of all tips at most kInward: for a unit it goes 0.1 H farther to
// avoid it.
constexpr double kOnName = 50, kCrossing = 8, kOnTip = 8, kOnCurve = 2, kBesideCurve = 1, kOnLine = 2, kOnBar = 0.5, kInward = 0.3, kPerH = 10;
constexpr double kAtEnd = 0.1;  // of a name at an end of its curve
constexpr double kLeastAtEnd = 0.03;  // units of H: a shorter leader to an end of a curve would be a blot on it
constexpr double kOutward = 0.3;  // cosine: there it stands no farther aside
constexpr double kOwnAtEnd = 0.8;  // of the same, of a name at the end of a curve
constexpr double kOwnByFar = 0.6;  // of the way to the next tip: nearer names need no leader

struct Candidate {
  Rect box;
  Point foot;  // where its leader begins
  Point to;    // ... and where it leads
  double cost = 0;  // whatever the others do
};

bool segments_cross(Point a, Point b, Point c, Point d) {
  const double s = cross(b - a, c - a), t = cross(b - a, d - a), u = cross(d - c, a - c), v = cross(d - c, b - c);
  return s * t < 0 && u * v < 0;
}

// Any of some places in the box within the curve, or of the curve within the box.
bool is_on_curve(const Rect& box, const NamedPlace& place) {
  const Point u = place.curve[0], v = place.curve[1];
  const double uu = dot(u, u), vv = dot(v, v);
  if (!(uu > 0) || !(vv > 0)) return false;
  for (int i = 0; i < 15; ++i) {
    const Point p = Point{box.x0 + (i % 5) * box.width() / 4, box.y0 + (i / 5) * box.height() / 2} - place.tip;
    if (std::hypot(dot(p, u) / uu, dot(p, v) / vv) < 1) return true;
  }
  for (int i = 0; i < kCurvePlaces; ++i) {
    const double angle = i * 2 * std::numbers::pi / kCurvePlaces;
    const Point p = place.tip + std::cos(angle) * u + std::sin(angle) * v;
    if (overlap(box, {p.x, p.y, p.x, p.y})) return true;
  }
  return false;
}

// Whether a line from a name to its own place runs over the curve of another.
bool runs_over(Point from, Point to, const NamedPlace& other) {
  constexpr int kPieces = 8;
  const Point u = other.curve[0], v = other.curve[1];
  const double uu = dot(u, u), vv = dot(v, v);
  if (!(uu > 0) || !(vv > 0)) return false;
  for (int i = 0; i < kPieces; ++i) {
    const Point p = from + double(i) / kPieces * (to - from) - other.tip;
    if (std::hypot(dot(p, u) / uu, dot(p, v) / vv) < 1) return true;
  }
  return false;
}

// A copy of the segment is cut.
bool meets(const Rect& box, Point a, Point b) {
  return cut_segment(box, a, b);
}

// A place that a name may stand about; the ends of curves only outside of them.
struct Anchor {
  Point at;
  std::optional<Point> outward;
};
std::vector<Anchor> anchors_of(const NamedPlace& place, const Rect& area) {
  std::vector<Anchor> anchors{{place.tip, {}}};
  const Point u = place.curve[0];
  for (const double side : {1.0, -1.0})
    if (norm(u) > kOff[0] && contains(area, place.tip + side * u)) anchors.push_back({place.tip + side * u, side * unit(u)});
  return anchors;
}

std::vector<Candidate> candidates_of(std::size_t i, std::span<const NamedPlace> places, std::span<const Bar> bars,
                                     const Rect& area, std::span<const Obstacle> lines) {
  const NamedPlace& own = places[i];
  Point mean;
  for (const NamedPlace& place : places) mean = mean + (1.0 / double(places.size())) * place.tip;
  const Point outward = unit(own.tip - mean);
  std::vector<Candidate> candidates;
  for (const Anchor& anchor : anchors_of(own, area))
    for (const double off : kOff)
      for (int k = 0; k < kDirections; ++k) {
        const double angle = std::numbers::pi / 2 + k * 2 * std::numbers::pi / kDirections;
        const Point way{std::cos(angle), std::sin(angle)};
        if (anchor.outward && dot(way, *anchor.outward) < kOutward) continue;
        const Rect box = place_beyond(own.name, anchor.at, off, way);
        if (box.x0 < area.x0 || box.x1 > area.x1 || box.y0 < area.y0 || box.y1 > area.y1) continue;
        Candidate one{box, nearest_in(box, anchor.at), anchor.at, anchor.outward ? kAtEnd : 0};
        one.cost += kPerH * norm(anchor.at - one.foot) + kInward * (1 - dot(way, outward)) / 2;
        for (std::size_t j = 0; j < places.size(); ++j) {
          if (is_on_curve(widened(box, kAirOfName / 2), places[j]))
            one.cost += kOnCurve;
          else if (j != i && is_on_curve(widened(box, kOtherCurve), places[j]))
            one.cost += kBesideCurve;
          if (j == i || norm(places[j].tip - own.tip) < kTipAir) continue;
          if (norm(places[j].tip - nearest_in(box, places[j].tip)) < kTipAir) one.cost += kOnTip;
          if (distance_to(places[j].tip, one.foot, anchor.at) < kTipAir) one.cost += kCrossing;
          if (runs_over(one.foot, anchor.at, places[j])) one.cost += kOnCurve;
        }
        for (const Bar& bar : bars)
          if (meets(widened(box, bar.half_width), bar.a, bar.b)) one.cost += kOnBar;
        if (std::ranges::any_of(lines, [&](const Obstacle& line) { return meets(widened(box, line.radius + kAirOfName / 2), line.a, line.b); }))
          one.cost += kOnLine;
        candidates.push_back(one);
      }
  if (candidates.empty()) {
    const Rect box = moved_into(area, place_beyond(own.name, own.tip, kOff[0], {0, 1}));
    candidates.push_back({box, nearest_in(box, own.tip), own.tip, 0});
  }
  return candidates;
}

double cost_beside(const Candidate& one, const Candidate& other) {
  double cost = 0;
  if (overlap(widened(one.box, kAirOfName / 2), widened(other.box, kAirOfName / 2))) cost += kOnName;
  if (segments_cross(one.foot, one.to, other.foot, other.to)) cost += kCrossing;
  if (meets(one.box, other.foot, other.to)) cost += kCrossing;
  if (meets(other.box, one.foot, one.to)) cost += kCrossing;
  return cost;
}

}  // namespace

bool curves_overlap(const NamedPlace& one, const NamedPlace& other) {
  // Of circles that would be apart nothing meets; of others some place of one lies in the other.
  if (norm(one.tip - other.tip) > norm(one.curve[0]) + norm(other.curve[0])) return false;
  const auto reaches_into = [](const NamedPlace& from, const NamedPlace& into) {
    const Point u = into.curve[0], v = into.curve[1];
    const double uu = dot(u, u), vv = dot(v, v);
    if (!(uu > 0) || !(vv > 0)) return false;
    for (int i = 0; i < kCurvePlaces; ++i) {
      const double angle = i * 2 * std::numbers::pi / kCurvePlaces;
      const Point p = from.tip + std::cos(angle) * from.curve[0] + std::sin(angle) * from.curve[1] - into.tip;
      if (std::hypot(dot(p, u) / uu, dot(p, v) / vv) < 1) return true;
    }
    return false;
  };
  return reaches_into(one, other) || reaches_into(other, one);
}

std::vector<PlacedName> place_names(std::span<const NamedPlace> places, std::span<const Bar> bars, const Rect& area,
                                    std::span<const Obstacle> lines) {
  const std::size_t count = places.size();
  std::vector<std::vector<Candidate>> candidates;
  for (std::size_t i = 0; i < count; ++i) candidates.push_back(candidates_of(i, places, bars, area, lines));
  std::vector<std::size_t> taken(count, 0);
  const auto at = [&](std::size_t i) -> const Candidate& { return candidates[i][taken[i]]; };
  for (int round = 0; round < kRounds; ++round) {
    bool rests = true;
    for (std::size_t i = 0; i < count; ++i) {
      const auto cost_of = [&](const Candidate& one) {
        double cost = one.cost;
        // In the first round those that follow have no place yet.
        for (std::size_t j = 0; j < (round == 0 ? i : count); ++j)
          if (j != i) cost += cost_beside(one, at(j));
        return cost;
      };
      std::size_t best = taken[i];
      double least = cost_of(candidates[i][best]);
      for (std::size_t c = 0; c < candidates[i].size(); ++c)
        if (const double cost = cost_of(candidates[i][c]); cost < least) least = cost, best = c;
      rests = rests && best == taken[i];
      taken[i] = best;
    }
    if (rests && round > 0) break;
  }
  std::vector<PlacedName> placed;
  for (std::size_t i = 0; i < count; ++i) {
    double next = HUGE_VAL;
    for (std::size_t j = 0; j < count; ++j)
      for (const Anchor& other : j == i ? std::vector<Anchor>() : anchors_of(places[j], area))
        next = std::min(next, norm(other.at - nearest_in(at(i).box, other.at)));
    bool stands = true;
    for (std::size_t j = 0; j < i; ++j) stands = stands && !(placed[j].word.opacity > 0 && overlap(at(i).box, at(j).box));
    const double way = norm(at(i).to - at(i).foot);
    const bool would_be_blot = norm(at(i).to - places[i].tip) > 0 && way < kLeastAtEnd && way < kOwnAtEnd * next;
    placed.push_back({{at(i).box, stands ? 1.0 : 0.0}, way > kOwnByFar * next && !would_be_blot, at(i).to});
  }
  return placed;
}

namespace {

// What words take up that are drawn, without their halos.
std::vector<Rect> boxes_of_words(const Picture& picture) {
  constexpr double kLetter = 0.6, kHeight = 0.75;  // of their size: the last letter's width, that of capitals
  std::vector<Rect> boxes;
  for (const Item& item : picture.items)
    if (const auto* run = std::get_if<GlyphRun>(&item.shape); run != nullptr && run->stroke_width == 0 && !run->glyphs.empty())
      boxes.push_back({run->origin.x, run->origin.y, run->origin.x + run->glyphs.back().x + kLetter * run->size, run->origin.y + kHeight * run->size});
  return boxes;
}

// Takes from each word the places whose line would run through another that stands already, but for the last of them.
void leave_words(std::vector<MarkWord>& words, const std::vector<Rect>& standing) {
  for (MarkWord& word : words) {
    if (!word.tie) continue;
    const auto runs_through = [&](const Rect& box) {
      const auto line = line_of(*word.tie, box);
      return line && std::ranges::any_of(standing, [&](const Rect& other) { return meets(other, line->from, line->to); });
    };
    std::vector<Rect> others;
    std::ranges::remove_copy_if(word.places, std::back_inserter(others), runs_through);
    if (!others.empty()) word.places = std::move(others);
  }
}

constexpr int kRoundsOfTies = 6;  // each has fewer places than the one before

// Takes from each word the places that lie on the line of one before it, or whose own line would cross that; whether any stood there.
bool leave_ties(std::vector<MarkWord>& words, const std::vector<StandingWord>& standing) {
  bool is_changed = false;
  for (std::size_t i = 0; i < words.size(); ++i) {
    const auto line = words[i].tie && standing[i].opacity > 0 ? line_of(*words[i].tie, standing[i].box) : std::nullopt;
    if (!line) continue;
    for (std::size_t j = 0; j < words.size(); ++j) {
      const auto meets_line = [&](const Rect& box) {
        const auto own = words[j].tie ? line_of(*words[j].tie, box) : std::nullopt;
        return meets(widened(box, kAirOfName / 2), line->from, line->to) || (own && segments_cross(line->from, line->to, own->from, own->to));
      };
      if (j == i || !(standing[j].opacity > 0) || !meets_line(standing[j].box)) continue;
      std::vector<Rect> others;
      std::ranges::remove_copy_if(words[j].places, std::back_inserter(others), meets_line);
      if (others.empty()) continue;
      words[j].places = std::move(others);
      is_changed = true;
    }
  }
  return is_changed;
}

}  // namespace

int draw_clear_of(Picture& picture, std::size_t first, const MarkLabels& words, std::vector<Obstacle> obstacles, const Rect& scene,
                   const Theme& theme, int clip, bool most_or_none) {
  // An axis that fades out of the panel at both ends has its number at one of them, or beside it there.
  std::vector<MarkWord> others;
  int nobodys = 0;
  const Rect room = widened(scene, -kLabelInset);
  for (MarkWord word : words.words()) {
    const bool is_at_edge = word.name == kLengthAtEdge;
    if (is_at_edge && most_or_none) {  // at the edge of a picture of several poses nobody sees whose it is
      ++nobodys;
      continue;
    }
    if (is_at_edge)
      for (Rect& place : word.places) place = moved_into(room, place);
    const bool is_other_end = is_at_edge && !others.empty() && others.back().name == kLengthAtEdge && others.back().places.size() == word.places.size();
    if (is_other_end)
      others.back().places.insert(others.back().places.end(), word.places.begin(), word.places.end());
    else
      others.push_back(word);
  }
  Picture drawn;
  drawn.items.assign(picture.items.begin() + std::ptrdiff_t(first), picture.items.end());
  for (const Obstacle& one : obstacles_of(drawn)) obstacles.push_back(one);
  leave_words(others, boxes_of_words(drawn));
  // Two numbers side by side are two where more than a blank is between them.
  double between = kBetweenWords;
  for (const MarkWord& word : others) between = std::max(between, kBetweenNumbers * word.line.box.height());
  const auto placed_now = [&] {
    WordPlan plan(room, kLooksPerSecond, between);
    plan.add(others, obstacles);
    return plan.standing().front();
  };
  std::vector<StandingWord> standing = placed_now();
  for (int round = 0; round < kRoundsOfTies && leave_ties(others, standing); ++round) standing = placed_now();
  const auto left_out = std::count_if(standing.begin(), standing.end(), [](const StandingWord& word) { return !(word.opacity > 0); });
  MarkLabels placed(standing);
  for (MarkWord& word : others) placed.add(std::move(word));
  if (most_or_none && 2 * left_out > std::ptrdiff_t(standing.size())) return int(standing.size()) + (nobodys + 1) / 2;
  placed.draw(picture, scene, theme.background, clip);
  return int(left_out) + (nobodys + 1) / 2;  // one at each end of an axis
}

}  // namespace chainreel
