#include "draw/page/mark_labels.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

namespace chainreel {
namespace {

constexpr double kBetweenLabels = 0.008;        // between two labels, units of H
constexpr int kRounds = 80;
constexpr std::size_t kCrowd = 60;  // labels; pushing more apart takes longer than drawing them
constexpr double kTouch = 1e-6;

Point turned(Point v, double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  return {c * v.x - s * v.y, s * v.x + c * v.y};
}

void fade(TextLine& line, double opacity) {
  for (GlyphRun& run : line.runs) run.color.a *= opacity;
  for (Shape& mark : line.marks) {
    if (auto* rule = std::get_if<Capsule>(&mark)) rule->paint.fill.a *= opacity;
    if (auto* dot = std::get_if<Ellipse>(&mark)) dot->paint.fill.a *= opacity;
  }
}

// How deep they lie in each other, air included; negative: they do not.
Point depth(const Rect& a, const Rect& b, double air) {
  return {std::min(a.x1, b.x1) - std::max(a.x0, b.x0) + air,
          std::min(a.y1, b.y1) - std::max(a.y0, b.y0) + air};
}

// Each pair that overlaps goes apart the shorter way, half of it each, over and over.
void push_apart(std::vector<Rect>& boxes, const Rect& area, double air) {
  for (int round = 0; round < kRounds; ++round) {
    bool rests = true;
    for (std::size_t i = 0; i < boxes.size(); ++i)
      for (std::size_t j = 0; j < i; ++j) {
        const Point d = depth(boxes[i], boxes[j], air);
        if (!(d.x > kTouch && d.y > kTouch)) continue;
        rests = false;
        const Point way = center_of(boxes[i]) - center_of(boxes[j]);
        const Point half =
            d.x < d.y ? Point{std::copysign(d.x / 2, way.x), 0} : Point{0, std::copysign(d.y / 2, way.y)};
        boxes[i] = moved_into(area, moved(boxes[i], half));
        boxes[j] = moved_into(area, moved(boxes[j], -1 * half));
      }
    if (rests) return;
  }
}

}  // namespace

Rect moved_into(const Rect& area, const Rect& r) {
  const auto by = [](double low, double high, double least, double most) {
    return low < least ? least - low : high > most ? most - high : 0;
  };
  return moved(r, {by(r.x0, r.x1, area.x0, area.x1), by(r.y0, r.y1, area.y0, area.y1)});
}

namespace {

// Crowds that no one could read: each label stands where it wishes, unless one before it does so already.
std::vector<PlacedBox> first_come(const std::vector<Rect>& wishes, const Rect& area, double air) {
  std::vector<PlacedBox> placed;
  for (const Rect& wish : wishes) {
    const Rect box = moved_into(area, wish);
    const bool free = std::none_of(placed.begin(), placed.end(), [&](const PlacedBox& other) {
      const Point d = depth(box, other.box, air);
      return other.stands && d.x > kTouch && d.y > kTouch;
    });
    const Point way = center_of(box) - center_of(wish);
    placed.push_back({box, free && norm(way) < kTouch});
  }
  return placed;
}

}  // namespace

std::vector<PlacedBox> boxes_apart(const std::vector<Rect>& wishes, const Rect& area, double air,
                                   double farthest) {
  if (wishes.size() > kCrowd) return first_come(wishes, area, air);
  std::vector<PlacedBox> placed;
  std::vector<std::size_t> standing;
  for (std::size_t i = 0; i < wishes.size(); ++i) {
    const Point p = center_of(wishes[i]);
    const bool inside = p.x >= area.x0 && p.x <= area.x1 && p.y >= area.y0 && p.y <= area.y1;
    placed.push_back({wishes[i], inside});
    if (inside) standing.push_back(i);
  }
  while (!standing.empty()) {
    std::vector<Rect> boxes;
    for (const std::size_t i : standing) boxes.push_back(moved_into(area, wishes[i]));
    push_apart(boxes, area, air);
    // Where one cannot stay near, the one that went farthest gives way, and the others begin anew without it.
    std::size_t worst = standing.size();
    double most = 1;
    for (std::size_t k = 0; k < boxes.size(); ++k) {
      const Rect& wish = wishes[standing[k]];
      const Point way = center_of(boxes[k]) - center_of(wish);
      double strain = norm(way) / (farthest * (wish.y1 - wish.y0));
      for (std::size_t m = 0; m < k; ++m) {
        const Point d = depth(boxes[k], boxes[m], 0);
        if (d.x > kTouch && d.y > kTouch) strain = std::max(strain, 2.0);
      }
      if (strain > most) most = strain, worst = k;
    }
    if (worst == standing.size()) {
      for (std::size_t k = 0; k < boxes.size(); ++k) placed[standing[k]].box = boxes[k];
      return placed;
    }
    placed[standing[worst]].stands = false;
    standing.erase(standing.begin() + std::ptrdiff_t(worst));
  }
  return placed;
}

Rect place_beyond(const TextLine& line, Point near, double gap, Point direction) {
  const double half_width = line.box.width() / 2, half_height = line.box.height() / 2;
  const double reach = std::abs(direction.x) * half_width + std::abs(direction.y) * half_height;
  const Point middle = near + (reach + gap) * direction;
  return {middle.x - half_width, middle.y - half_height, middle.x + half_width, middle.y + half_height};
}

std::vector<Rect> places_about(const TextLine& line, Point middle, double off, Point first) {
  std::vector<Rect> places;
  for (const int eighths : {0, 1, -1, 2, -2, 3, -3, 4})
    places.push_back(place_beyond(line, middle, off, turned(first, eighths * std::numbers::pi / 4)));
  return places;
}

namespace {

constexpr double kLeaderWidth = 0.0025, kLeaderDot = 0.0055, kLeaderGap = 0.008;  // units of H
constexpr double kTieWidth = 0.0018, kTieHalo = 0.0012;  // what lines cross stays

// From the side of the box that is nearest.
void draw_leader(Picture& picture, const Leader& leader, const Rect& box, Color background, double opacity, int clip) {
  const Color color = leader.color.faded(opacity), halo = background.faded(opacity);
  if (const std::optional<TieLine> line = line_of(leader, box)) {
    picture.add(Capsule{line->from, line->to, kLeaderWidth / 2 + kTieHalo, {halo, {}, 0}}, clip);
    picture.add(Capsule{line->from, line->to, kLeaderWidth / 2, {color, {}, 0}}, clip);
  }
  picture.add(Ellipse{leader.to, {kLeaderDot, 0}, {0, kLeaderDot}, {color, halo, kWordHalo}}, clip);
}

void draw_tie(Picture& picture, const Tie& tie, const Rect& box, Color background, double opacity, int clip) {
  const std::optional<TieLine> line = line_of(tie, box);
  const Color color = tie.color.faded(opacity), halo = background.faded(opacity);
  if (line) {
    picture.add(Capsule{line->from, line->to, kTieWidth / 2 + kTieHalo, {halo, {}, 0}}, clip);
    picture.add(Capsule{line->from, line->to, kTieWidth / 2, {color, {}, 0}}, clip);
  }
  if (tie.dot) picture.add(Ellipse{tie.to, {kLeaderDot, 0}, {0, kLeaderDot}, {color, halo, kWordHalo}}, clip);
}

}  // namespace

std::optional<TieLine> line_of(const Tie& tie, const Rect& box) {
  const Rect air = widened(box, kLeaderGap);
  const auto way_from = [&](Point end) { return nearest_in(air, end) - end; };
  const Point end = tie.other_end && norm(way_from(*tie.other_end)) < norm(way_from(tie.to)) ? *tie.other_end : tie.to, way = way_from(end);
  if (!(norm(way) > tie.near + tie.shortest)) return {};
  return TieLine{end + way, end + (tie.near / norm(way)) * way};
}

std::optional<TieLine> line_of(const Leader& leader, const Rect& box) {
  const Point from = nearest_in(widened(box, kLeaderGap), leader.to);
  if (!(norm(leader.to - from) > kLeaderDot)) return {};
  return TieLine{from, leader.to};
}

const TextLine& MarkWord::shape_for(const Rect& box) const {
  const auto unlike = [&box](const TextLine& shape) {
    return std::abs(shape.box.width() - box.width()) + std::abs(shape.box.height() - box.height());
  };
  const TextLine* best = &line;
  for (const TextLine& shape : other_shapes)
    if (unlike(shape) < unlike(*best)) best = &shape;
  return *best;
}

StandingWord standing_at(const MarkWord& word, const ChosenPlace& chosen, const Rect& area) {
  if (chosen.place == ChosenPlace::kNowhere || std::size_t(chosen.place) >= word.places.size()) return {{}, 0, word.anchor};
  return {moved_into(area, word.places[std::size_t(chosen.place)]), chosen.opacity, word.anchor};
}

void MarkLabels::add(MarkWord word) {
  words_.push_back(std::move(word));
}

void MarkLabels::add(const std::string& name, TextLine line, const Rect& box, std::optional<Point> anchor) {
  std::vector<Rect> places{box};
  for (const Point way : {Point{0, 1}, {0, -1}, {1, 0}, {-1, 0}, {1, 1}, {-1, 1}, {1, -1}, {-1, -1}})
    places.push_back(moved(box, {way.x * (box.width() + kBetweenLabels), way.y * (box.height() + kBetweenLabels)}));
  words_.push_back({name, std::move(line), std::move(places)});
  words_.back().anchor = anchor;
}

void MarkLabels::close_nearer_to_others(std::size_t from) {
  constexpr double kApart = 0.05, kNearer = 0.8;  // units of H between what is told apart; of the way to its own
  for (std::size_t i = from; i < words_.size(); ++i) {
    MarkWord& word = words_[i];
    if (!word.anchor) continue;
    word.closed.resize(word.places.size(), false);
    for (std::size_t j = from; j < words_.size(); ++j) {
      if (j == i || !words_[j].anchor || norm(*words_[j].anchor - *word.anchor) < kApart) continue;
      for (std::size_t p = 0; p < word.places.size(); ++p) {
        const auto way = [&](Point to) { return norm(nearest_in(word.places[p], to) - to); };
        if (way(*words_[j].anchor) < kNearer * way(*word.anchor)) word.closed[p] = true;
      }
    }
  }
}

void MarkLabels::draw(Picture& picture, const Rect& area, Color background, int clip, double farthest) const {
  std::vector<StandingWord> standing(plan_.begin(), plan_.end());
  for (std::size_t i = 0; i < std::min(chosen_.size(), words_.size()); ++i) standing.push_back(standing_at(words_[i], chosen_[i], area_));
  if (standing.empty()) {
    std::vector<Rect> wishes;
    for (const MarkWord& word : words_) wishes.push_back(word.places.front());
    for (const PlacedBox& placed : boxes_apart(wishes, area, kBetweenLabels, farthest))
      standing.push_back({placed.box, placed.stands ? 1.0 : 0.0, {}});
  }
  if (standing.size() != words_.size()) throw std::logic_error("words that are drawn are not those that were planned");
  for (std::size_t i = 0; i < words_.size(); ++i) {
    const Rect& box = standing[i].box;
    const double opacity = standing[i].opacity;
    if (!(opacity > 0)) continue;
    TextLine line = words_[i].shape_for(box);
    fade(line, opacity);
    const Point anchor{box.x0 - line.box.x0, box.y0 - line.box.y0};
    constexpr double kSeen = 1e-3;  // units of H: pictures of a sheet have words that nobody sees, and no lines to them
    const bool is_seen = box.height() > kSeen;
    if (words_[i].leader && is_seen) draw_leader(picture, *words_[i].leader, box, background, opacity, clip);
    if (words_[i].tie && is_seen) draw_tie(picture, *words_[i].tie, box, background, opacity, clip);
    draw_halo(picture, line, anchor, background.faded(opacity), kWordHalo, clip);
    draw_text(picture, line, anchor, clip);
  }
}

}  // namespace chainreel
