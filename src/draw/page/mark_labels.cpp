#include "draw/page/mark_labels.hpp"

#include <algorithm>
#include <cmath>

namespace chainreel {
namespace {

constexpr double kPlate = 0.75;       // opacity of what sets a label off from links below it
constexpr double kPlateEdge = 0.004;  // of the plate around the letters
constexpr double kBetweenLabels = 0.008;        // between two labels, units of H
constexpr int kRounds = 80;
constexpr std::size_t kCrowd = 60;  // labels; pushing more apart takes longer than drawing them
constexpr double kTouch = 1e-6;

Point middle(const Rect& r) {
  return {(r.x0 + r.x1) / 2, (r.y0 + r.y1) / 2};
}
Rect moved(const Rect& r, Point by) {
  return {r.x0 + by.x, r.y0 + by.y, r.x1 + by.x, r.y1 + by.y};
}

// How deep they lie in each other, air included; negative: they do not.
Point depth(const Rect& a, const Rect& b, double air) {
  return {std::min(a.x1, b.x1) - std::max(a.x0, b.x0) + air,
          std::min(a.y1, b.y1) - std::max(a.y0, b.y0) + air};
}

Rect held(const Rect& r, const Rect& area) {
  const auto by = [](double low, double high, double least, double most) {
    return low < least ? least - low : high > most ? most - high : 0;
  };
  return moved(r, {by(r.x0, r.x1, area.x0, area.x1), by(r.y0, r.y1, area.y0, area.y1)});
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
        const Point way = middle(boxes[i]) - middle(boxes[j]);
        const Point half =
            d.x < d.y ? Point{std::copysign(d.x / 2, way.x), 0} : Point{0, std::copysign(d.y / 2, way.y)};
        boxes[i] = held(moved(boxes[i], half), area);
        boxes[j] = held(moved(boxes[j], -1 * half), area);
      }
    if (rests) return;
  }
}

}  // namespace

namespace {

// Crowds that no one could read: each label stands where it wishes, unless one before it does so already.
std::vector<PlacedBox> first_come(const std::vector<Rect>& wishes, const Rect& area, double air) {
  std::vector<PlacedBox> placed;
  for (const Rect& wish : wishes) {
    const Rect box = held(wish, area);
    const bool free = std::none_of(placed.begin(), placed.end(), [&](const PlacedBox& other) {
      const Point d = depth(box, other.box, air);
      return other.stands && d.x > kTouch && d.y > kTouch;
    });
    const Point way = middle(box) - middle(wish);
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
    const Point p = middle(wishes[i]);
    const bool inside = p.x >= area.x0 && p.x <= area.x1 && p.y >= area.y0 && p.y <= area.y1;
    placed.push_back({wishes[i], inside});
    if (inside) standing.push_back(i);
  }
  while (!standing.empty()) {
    std::vector<Rect> boxes;
    for (const std::size_t i : standing) boxes.push_back(held(wishes[i], area));
    push_apart(boxes, area, air);
    // Where one cannot stay near, the one that went farthest gives way, and the others begin anew without it.
    std::size_t worst = standing.size();
    double most = 1;
    for (std::size_t k = 0; k < boxes.size(); ++k) {
      const Rect& wish = wishes[standing[k]];
      const Point way = middle(boxes[k]) - middle(wish);
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

void MarkLabels::add(TextLine line, const Rect& box, bool plate) {
  labels_.push_back({std::move(line), box, plate});
}

void MarkLabels::draw(Picture& picture, const Rect& area, Color background, int clip, double farthest) const {
  std::vector<Rect> wishes;
  for (const Label& label : labels_) wishes.push_back(label.wish);
  const std::vector<PlacedBox> placed = boxes_apart(wishes, area, kBetweenLabels, farthest);
  for (std::size_t i = 0; i < labels_.size(); ++i) {
    if (!placed[i].stands) continue;
    const Rect& box = placed[i].box;
    const TextLine& line = labels_[i].line;
    if (labels_[i].plate) {
      const double width = box.x1 - box.x0, height = box.y1 - box.y0, y = (box.y0 + box.y1) / 2;
      const double inset = std::min(width, height) / 2;
      picture.add(Capsule{{box.x0 + inset, y},
                          {box.x1 - inset, y},
                          height / 2 + kPlateEdge,
                          {background.faded(kPlate), {}, 0}},
                  clip);
    }
    draw_text(picture, line, {box.x0 - line.box.x0, box.y0 - line.box.y0}, clip);
  }
}

}  // namespace chainreel
