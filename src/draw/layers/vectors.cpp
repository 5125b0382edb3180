#include "draw/layers/vectors.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>

#include "core/format.hpp"
#include "draw/page/arrow.hpp"
#include "draw/page/sheet.hpp"
#include "draw/robot/joints.hpp"
#include "picture/point.hpp"

namespace chainreel {
namespace {

using Eigen::Vector3d;

constexpr double kBesideTurn = 50;         // degrees beyond the ends of an arc within which its name stands
constexpr double kVectorLabelGap = 0.010;  // between an arrow's tip or an arc and its label, units of H
constexpr double kFarLabelGap = 0.035;      // ... where there is no room nearer
constexpr double kShareBelowFull = 0.95;  // of a clip's magnitudes
constexpr double kRoundOffBelow = 1e-6;   // of the largest
constexpr double kOfMiddle = 2.4;         // of the middle size, whose arrow is then 0.083 H long: less than half of that has one, too, and half of it on pages higher than wide
constexpr double kRestBeforeRing = 0.3, kRingFade = 0.15;  // s
constexpr double kRingRadius = 0.026;     // units of H: close about a joint's disc
constexpr double kAboutPeak[] = {0.04, 0.08, 0.13, 0.19}, kLeastUntied = 0.1;  // units of H: where numbers of cut arrows stand about their places, and how short arrows then need a line
constexpr std::size_t kNearOfThese = 3;
constexpr double kNearArrow = 0.026;       // units of H: beside the end of an arrow or the disc of its joint, where lines from words end
constexpr double kFarName = 30;            // Tie::cost: a name stands near and goes while a link passes, rather than 0.15 H away; numbers stay
constexpr double kBesideSwept = 0.03, kFarthestSwept = 0.3;  // units of H: from a circle that a link sweeps, half of its width included; words farther off name nothing
constexpr double kLeastLabelled = 0.026;  // units of H: words of torques stand off their joints by more, and arrows that have words are longer
constexpr double kOffDisc = 0.018, kLeastOffDisc = 0.012;  // units of H: short ones of ties begin beside the disc of their joint; of less is a dot
constexpr double kLeastOfTie = 0.034;     // units of H: those of ties begin at a joint's disc, beyond which a head, 0.024 long, is to be seen
constexpr double kWholeRadius = 60;       // degrees: an arc that turns by less has a smaller radius, down to a dot
constexpr double kNearestName = 0.65;     // of an arc's whole radius: where it changes its sense its name stays, rather than run in and out
constexpr double kClearOfJoint = 0.020;   // units of H: arcs of twice that have an edge, those within it none
constexpr double kLegendArc = 1.3;        // of the arc that most of a film's are smaller than: that of the legend at most
constexpr double kTorqueDot = 0.0062;     // radius, units of H
constexpr double kDotAboutTip = 0.0105;   // likewise: a ring about the mark of the end effector
constexpr double kPlaceDot = 0.0050, kTieToPlace = 0.0015, kPlaceCasing = 0.0016;  // units of H: radius, width, on each side
constexpr double kBreakOpens = 0.1;       // a break is open where this much of the length is cut
constexpr double kRoomStep = 0.01;   // units of H: rooms are rounded up to multiples, to have few kinds

Point on_page(const Vector3d& direction, const Camera& camera) {
  return {camera.right.dot(direction), camera.up.dot(direction)};
}

// The circle of an arc about `axis`, radius 1: its top as seen on the page, and a quarter turn on.
struct Circle {
  Vector3d top, quarter;
};
Circle circle_about(const Vector3d& axis, const Camera& camera) {
  Vector3d top = camera.up - camera.up.dot(axis) * axis;
  if (top.norm() < 1e-6) top = -camera.toward_viewer;
  top.normalize();
  return {top, axis.cross(top)};
}

// How far the break in what would be `wished` long and is cut at `most` is open.
double broken(double wished, double most) {
  return std::clamp((wished - most * (1 + 1e-12)) / (kBreakOpens * most), 0.0, 1.0);
}

Rect label_box(const TextLine& label, Point near, Point direction) {
  return place_beyond(label, near, kVectorLabelGap, direction);
}

struct ArrowPlaces {
  std::vector<Rect> boxes;
  std::vector<bool> beyond_tip;  // of each, whether it lies aslant there
};

// Before the tip of an arrow, or beside its head and shaft, `half` off their middle.
ArrowPlaces places_along(const TextLine& label, Point tail, Point v, double half) {
  const Point ahead = unit(v), side = normal_to(ahead), tip = tail + v;
  const Point aslant = std::sqrt(0.5) * ahead, across = std::sqrt(0.5) * side;
  ArrowPlaces places;
  const auto add = [&](const Rect& box, bool beyond_tip) {
    places.boxes.push_back(box);
    places.beyond_tip.push_back(beyond_tip);
  };
  add(label_box(label, tip, ahead), false);
  for (const double way : {1.0, -1.0}) add(label_box(label, tip, aslant + way * across), true);
  for (const double share : {1.0, 0.6, 0.25})
    for (const double way : {1.0, -1.0})
      add(label_box(label, tail + share * v + (way * half) * side, way * side), false);
  for (const double way : {1.0, -1.0}) {
    add(place_beyond(label, tip, kFarLabelGap, aslant + way * across), true);
    add(place_beyond(label, tail + 0.6 * v, half + kFarLabelGap, way * side), false);
  }
  return places;
}

// Whether a place in this direction from the middle of an arc of half axes u and w is at the arc, or at least not across its joint,
// where it would be taken for the name of what stands there.
bool is_beside_turn(Point direction, Point u, Point w, double turn) {
  const auto along = [direction](Point axis) { return dot(direction, axis) / std::max(dot(axis, axis), kRoundOffBelow); };
  return std::abs(std::atan2(along(w), along(u))) <= std::max(turn / 2 + kBesideTurn * std::numbers::pi / 180, std::numbers::pi / 2 + kRoundOffBelow);
}

// Of arrows side by side each has its name on its own side of their middle, which goes through `middle`.
void close_beyond_middle(MarkWord& word, Point middle, Point own_side) {
  word.closed.resize(word.places.size());
  for (std::size_t i = 0; i < word.places.size(); ++i)
    if (dot(center_of(word.places[i]) - middle, own_side) <= 0) word.closed[i] = true;
}

// The same word of the same mark from frame to frame.
std::string word_name(const WorldVector& vector) {
  return std::to_string(int(vector.kind)) + " " + vector.label;
}

}  // namespace

void VectorMagnitudes::add(const WorldVector& vector, double weight) {
  magnitudes_[std::size_t(vector.kind)].push_back({vector.value.norm(), weight});
}

namespace {

// Of those that are more than round-off beside the largest what `share` of the time are at most.
double magnitude_below(std::vector<Magnitude> magnitudes, double share) {
  std::erase_if(magnitudes, [](const Magnitude& one) { return !(one.size > 0) || !std::isfinite(one.size); });
  if (magnitudes.empty()) return 0;
  std::ranges::sort(magnitudes, {}, &Magnitude::size);
  const double least = kRoundOffBelow * magnitudes.back().size;
  std::erase_if(magnitudes, [least](const Magnitude& one) { return one.size < least; });
  const bool count_alike = std::ranges::none_of(magnitudes, [](const Magnitude& one) { return one.weight > 0; });
  const auto weight_of = [count_alike](const Magnitude& one) { return count_alike ? 1 : one.weight; };
  double all = 0, up_to = 0;
  for (const Magnitude& one : magnitudes) all += weight_of(one);
  for (const Magnitude& one : magnitudes)
    if ((up_to += weight_of(one)) >= share * all * (1 - kRoundOffBelow)) return one.size;
  return magnitudes.back().size;
}

}  // namespace

double lasts(const std::vector<double>& t, std::size_t k) {
  if (t.size() < 2) return 0;
  const std::size_t from = std::min(k, t.size() - 2);
  return t[from + 1] - t[from];
}

double full_magnitude(std::vector<Magnitude> magnitudes) {
  return magnitude_below(std::move(magnitudes), kShareBelowFull);
}

double without_needles(double full, std::vector<Magnitude> largest) {
  const double middle = magnitude_below(std::move(largest), 0.5);
  // Dots of arrows that have half of their lengths, too, as beside the edge of their scene.
  return middle > 0 && kLeastArrows * middle * size::kLongestArrow < kLeastOfTie * full ? kOfMiddle * middle : full;
}

std::array<double, kVectorKinds.size()> VectorMagnitudes::full() const {
  std::array<double, kVectorKinds.size()> full{};
  for (std::size_t kind = 0; kind < full.size(); ++kind) full[kind] = full_magnitude(magnitudes_[kind]);
  return full;
}

std::vector<double> rings_along(const std::vector<double>& t, const std::vector<bool>& rests) {
  std::vector<double> rings(t.size());
  for (std::size_t begin = 0; begin < t.size(); ++begin) {
    if (!rests[begin] || (begin > 0 && rests[begin - 1])) continue;
    std::size_t end = begin;
    while (end + 1 < t.size() && rests[end + 1]) ++end;
    if (t[end] - t[begin] < 2 * kRestBeforeRing) continue;
    // At the end of the clip it stays.
    const double gone = end + 1 == t.size() ? t[end] + kRingFade : t[end];
    for (std::size_t k = begin; k <= end; ++k)
      rings[k] = std::clamp(std::min(t[k] - t[begin] - kRestBeforeRing, gone - t[k]) / kRingFade, 0.0, 1.0);
  }
  return rings;
}

double number_of(const WorldVector& vector) {
  if (vector.amount) return vector.amount->value;
  for (const Vector3d& way : {vector.axis, vector.rail})
    if (way.norm() > 0) return vector.value.dot(way);
  return vector.value.norm();
}

VectorScale VectorScales::of(VectorKind kind) const {
  const double value = full[std::size_t(kind)];
  if (kind == VectorKind::torque) return {value, kTurnOfFull * std::numbers::pi / 180};
  return {value, shrink * size::kLongestArrow};
}

Color color_of(VectorKind kind, const Theme& theme) {
  switch (kind) {
    case VectorKind::velocity:
      return theme.velocity;
    case VectorKind::weight:
    case VectorKind::push:
      return theme.force;
    case VectorKind::constraint:
      return theme.constraint;
    default:
      return theme.torque;
  }
}

std::string name_of(VectorKind kind) {
  switch (kind) {
    case VectorKind::torque:
      return "torque";
    case VectorKind::joint_force:
      return "joint force";
    case VectorKind::velocity:
      return "velocity";
    case VectorKind::weight:
      return "weight";
    case VectorKind::constraint:
      return "constraint force";
    case VectorKind::push:
      return "push";
  }
  return "";
}

std::string unit_of(VectorKind kind) {
  return kind == VectorKind::torque ? "N m" : kind == VectorKind::velocity ? "m/s" : "N";
}

std::vector<ScaleEntry> scale_entries(const VectorScales& scales, const std::vector<VectorKind>& shown,
                                      bool named, const Theme& theme) {
  std::vector<ScaleEntry> entries;
  for (const VectorKind kind : shown) {
    const VectorScale scale = scales.of(kind);
    // Those of ties come and go: a number whose arrow is not there needs its name.
    const std::string name = named || kind == VectorKind::push || kind == VectorKind::constraint ? name_of(kind) + " " : "";
    const auto mark = kind == VectorKind::torque       ? ScaleEntry::Mark::turn
                      : kind == VectorKind::constraint ? ScaleEntry::Mark::dashed_arrow
                                                       : ScaleEntry::Mark::arrow;
    if (!(scale.full > 0)) continue;
    // A small arc is hardly more than a head: the number of one that turns a little more than those of the film, rather than of half of them.
    const double value = round_length((kind == VectorKind::torque ? kLegendArc : 1) * scale.full);
    entries.push_back({mark, scale.on_page(value), color_of(kind, theme),
                       name + format_shortest(value) + "\u2009" + unit_of(kind)});
  }
  return entries;
}

namespace {

// "tau_2 = -31 N m" about the axis or along the rail, "lambda_1 = -31 N" of what has an amount; of what may point anywhere its size,
// "|v| = 4.2 m/s". A number that is true at one instant of those at which it stands says so: "peak |v| = 4.2 m/s".
std::string words_with_value(const WorldVector& vector) {
  const bool has_sense = vector.axis.norm() > 0 || vector.rail.norm() > 0;
  const std::string size = "|" + vector.label.substr(vector.label.starts_with('-') ? 1 : 0) + "|";
  const std::string symbol = vector.amount ? vector.amount->of : has_sense ? vector.label : size;
  const double value = vector.peak ? vector.peak->value : number_of(vector);
  return (vector.peak && !vector.peak->is_steady ? "\"peak \"" : "") + symbol + " = " + format_significant(value, 2) + " " + unit_of(vector.kind);
}

}  // namespace

VectorPen::VectorPen(const Theme& theme, const Fonts& fonts, double text_scale, const VectorScales& scales)
    : theme_(&theme), fonts_(&fonts), text_scale_(text_scale), scales_(scales) {}

const TextLine& VectorPen::label(const WorldVector& vector, double marks, bool has_number) const {
  // That of a push has its size in its name.
  const std::string words = has_number && vector.kind != VectorKind::push ? words_with_value(vector) : vector.label;
  const auto key = std::tuple{vector.kind, words, marks};
  const auto known = labels_.find(key);
  if (known != labels_.end()) return known->second;
  const TextStyle style{Face::math, em(marks), color_of(vector.kind, *theme_), Align::left};
  return labels_.emplace(key, lay_out_math(*fonts_, words, style)).first->second;
}

namespace {

// Of a tie, whose arrow would lie under the disc there where it is short.
bool begins_at_joint(const WorldVector& vector) {
  return vector.kind == VectorKind::constraint && !vector.pushes && vector.aside == 0;
}

Point unit_or_zero(Point v) {
  return norm(v) > 0 ? unit(v) : Point{};
}

}  // namespace

VectorPen::Straight VectorPen::straight(const WorldVector& vector, const Camera& camera, double marks, double share) const {
  const VectorScale scale = scales_.of(vector.kind);
  const double magnitude = vector.value.norm();
  double length = scale.on_page(magnitude);
  Straight arrow;
  const double most = scales_.shrink * size::kArrowCut;
  arrow.broken = broken(length, most);
  length = share * std::min(length, most);
  if (!(magnitude > 0) || !std::isfinite(magnitude)) return arrow;
  const Camera seen = camera.seen_at(vector.place);
  arrow.v = (length / magnitude) * on_page(vector.value, seen);
  const Point rail = on_page(vector.rail, seen);
  if (norm(rail) > 0) {
    // On the side where there is no ground.
    Point side = normal_to(unit(rail));
    if (side.y < -1e-9 || (std::abs(side.y) <= 1e-9 && side.x < 0)) side = -1 * side;
    arrow.shift = (marks * size::kBesideRail) * side;
  }
  if (vector.pushes && length > 0) arrow.shift = -(1 + marks * size::kBeforePushed / length) * arrow.v;
  if (begins_at_joint(vector) && length > 0) {
    const double least = marks * kLeastOfTie;
    arrow.shift = arrow.off = (marks * kOffDisc * std::clamp(2 - length / least, 0.0, 1.0)) * unit_or_zero(arrow.v);
  }
  if (const double left = vector.aside + marks * vector.lane; left != 0 && length > 0) arrow.shift = arrow.shift + left * normal_to(unit(arrow.v));
  return arrow;
}

PageLine VectorPen::line_of(const WorldVector& vector, const Camera& camera, double marks) const {
  const Straight arrow = straight(vector, camera, marks);
  const Point tail = camera.project(vector.place) + arrow.shift;
  return {tail, tail + arrow.v};
}

Rect VectorPen::bare_extent(const WorldVector& vector, const Camera& camera, double marks, double share) const {
  if (vector.kind == VectorKind::torque) {
    const double r = marks * (size::kTorqueArc + size::kArrowHeadWidth / 2);
    return {-r, -r, r, r};
  }
  const Straight arrow = straight(vector, camera, marks, share);
  if (norm(arrow.v) < size::kShortestArrow) return {};
  const double half = marks * size::kArrowHeadWidth / 2;
  const Point tail = arrow.shift, tip = arrow.shift + arrow.v;
  return {std::min(tail.x, tip.x) - half, std::min(tail.y, tip.y) - half, std::max(tail.x, tip.x) + half, std::max(tail.y, tip.y) + half};
}

Rect VectorPen::extent(const WorldVector& vector, const Camera& camera, double marks) const {
  const Rect bare = bare_extent(vector, camera, marks);
  if (vector.label.empty()) return bare;
  if (vector.kind == VectorKind::torque) return around(bare, label_box(label(vector, marks), {0, bare.y1}, {0, 1}));
  const Straight arrow = straight(vector, camera, marks);
  if (norm(arrow.v) < size::kShortestArrow) return bare;
  return around(bare, label_box(label(vector, marks), arrow.shift + arrow.v, unit(arrow.v)));
}

void VectorPen::add_to(FitBox& box, const WorldVector& vector, const Camera& camera, double marks, double share) const {
  const Rect r = bare_extent(vector, camera, marks, share);
  const Point place = camera.flat(vector.place);
  const std::array<double, 4> sides{-r.x0, r.x1, -r.y0, r.y1};
  for (int side = 0; side < 4; ++side) {
    const int steps = int(std::ceil(sides[std::size_t(side)] / kRoomStep));
    if (steps <= 0) continue;
    Room room;
    room.in_margin = true;
    (side == 0 ? room.left : side == 1 ? room.right : side == 2 ? room.down : room.up) = steps * kRoomStep;
    box.add(room, place);
  }
}

double VectorPen::cut_beyond(VectorKind kind) const {
  return scales_.of(kind).full * (kind == VectorKind::torque ? kWidestTurn / kTurnOfFull : size::kArrowCut / size::kLongestArrow);
}

void VectorPen::draw_torque(Picture& picture, const WorldVector& vector, const Camera& camera, double marks,
                            int clip, MarkLabels& labels) const {
  const Point center = camera.project(vector.place);
  const double radius = vector.size * marks * size::kTorqueArc;
  const Camera seen = camera.seen_at(vector.place);
  const Circle circle = circle_about(vector.axis, seen);
  const Point u = radius * on_page(circle.top, seen), w = radius * on_page(circle.quarter, seen);
  const VectorScale scale = scales_.of(vector.kind);
  const double value = vector.value.dot(vector.axis);
  ArrowStyle style{color_of(vector.kind, *theme_), marks * std::sqrt(vector.size), false, 0, theme_->lines, theme_->background};
  const double widest = kWidestTurn * std::numbers::pi / 180;
  const double wished = scale.on_page(std::abs(value)), turn = std::min(wished, widest);
  style.broken = broken(wished, widest);
  const double grown = std::min(1.0, turn / (kWholeRadius * std::numbers::pi / 180));
  // What sets an arc off from links would bite into the disc of its joint.
  style.casing = theme_->background.faded(std::clamp(grown * radius / (marks * kClearOfJoint) - 1, 0.0, 1.0));
  draw_turn(picture, center, grown * u, grown * w, value > 0 ? turn : -turn, style, clip);
  if (vector.ring > 0) {
    const double ring = kRingRadius / (size::kTorqueArc * std::sqrt(vector.size));
    draw_ring(picture, center, ring * u, ring * w, style.color.faded(vector.ring), clip);
  }
  const double dot = style.size * kTorqueDot;
  picture.add(Ellipse{center, {dot, 0}, {0, dot}, {style.color, {}, 0}}, clip);
  // A word beside a dot is the name of nothing.
  if (vector.label.empty() || !(turn > kLeastNamed * widest || vector.keeps_name || vector.peak)) return;
  const TextLine& text = label(vector, marks, vector.peak && vector.peak->is_told);
  const double half_head = marks * size::kArrowHeadWidth / 2;
  const double off = std::max({grown * radius, kNearestName * radius, kLeastLabelled * marks}) + half_head + kVectorLabelGap;
  MarkWord word{word_name(vector), text, {}, std::nullopt, Tie{center, grown * radius + half_head, style.color}};
  const double swept = vector.swept * camera.scale + marks * kBesideSwept;
  const bool has_outside = vector.swept > 0 && swept < kFarthestSwept;
  if (!vector.peak && !has_outside) word.tie->cost = kFarName;
  const auto add_places = [&](double far, Point first) {
    for (const Rect& place : places_about(text, center, far, first)) {
      word.places.push_back(place);
      word.closed.push_back(!is_beside_turn(center_of(place) - center, u, w, turn));
    }
  };
  for (const double far : {0.0, kFarLabelGap, 2.2 * kFarLabelGap}) add_places(off + far, {0, 1});
  // Where a link turns all around its joint, no word stays in one place but outside of that circle; aslant, where neither title nor
  // ground is.
  if (has_outside) add_places(swept, std::sqrt(0.5) * Point{-1, 1});
  word.anchor = center;
  labels.add(std::move(word));
}

// Of an arrow that stands aside: a dot where it acts, and a line from there to its tail.
void VectorPen::draw_tie_to_place(Picture& picture, Point place, Point tail, double marks, Color color, int clip) const {
  // It comes as the arrow leaves its place.
  const double dot = std::min(marks * kPlaceDot, norm(tail - place) / 2);
  for (const auto& [tint, around] : {std::pair{theme_->background, marks * kPlaceCasing}, {color, 0.0}}) {
    draw_line(picture, {place, tail}, theme_->lines * marks * kTieToPlace + 2 * around, tint, clip);
    picture.add(Ellipse{place, {dot + around, 0}, {0, dot + around}, {tint, {}, 0}}, clip);
  }
}

void VectorPen::draw(Picture& picture, const WorldVector& vector, const Camera& camera, double marks, int clip,
                     MarkLabels& labels) const {
  const Point place = camera.project(vector.place);
  if (!std::isfinite(place.x) || !std::isfinite(place.y)) return;
  if (vector.kind == VectorKind::torque) return draw_torque(picture, vector, camera, marks, clip, labels);
  const Straight arrow = straight(vector, camera, marks);
  const VectorScale scale = scales_.of(vector.kind);
  const double magnitude = vector.value.norm();
  if (!(magnitude > kRoundOffBelow * scale.full)) return;
  // Those of ties act at joints and ends, whose discs would hide the half of a short one.
  const double least_named = marks * (vector.kind == VectorKind::constraint ? kLeastOfTie : kLeastLabelled);
  const double least_seen = begins_at_joint(vector) ? marks * kLeastOffDisc : vector.kind == VectorKind::constraint ? least_named : size::kShortestArrow;
  const bool is_seen = norm(arrow.v) >= least_seen;
  const Point tail = place + arrow.shift, root = tail - arrow.off;  // what words are about does not turn with a short arrow
  if (is_seen && vector.aside != 0) draw_tie_to_place(picture, place, tail, marks, color_of(vector.kind, *theme_), clip);
  if (is_seen)
    draw_arrow(picture, tail, arrow.v,
               {color_of(vector.kind, *theme_), marks, vector.kind == VectorKind::constraint, arrow.broken, theme_->lines, theme_->background}, clip);
  // What is hardly more than a head, or none, is a dot, lest it be thought that nothing acts.
  if (const double dot = marks * (vector.at_tip ? kDotAboutTip : kPlaceDot); scale.on_page(magnitude) < (begins_at_joint(vector) ? least_seen : least_named) && vector.kind != VectorKind::velocity)
    picture.add(Ellipse{vector.pushes || vector.aside != 0 ? place : tail, {dot, 0}, {0, dot}, {color_of(vector.kind, *theme_), {}, 0}}, clip);
  // A word beside such a one names what nobody sees, unless it is a number that stays: of a push, of a weight, or of a peak.
  const bool is_small = norm(arrow.v) < least_named;
  const bool stays = vector.kind == VectorKind::push || vector.kind == VectorKind::weight || vector.peak;
  if (vector.label.empty() || (is_small && !stays)) return;
  // In a picture by itself that of a peak which is not told there has its place among the words, and no letters.
  const bool is_blank = is_small && vector.peak && !vector.peak->is_told;
  const TextLine text = is_blank ? TextLine{} : label(vector, marks, vector.peak ? vector.peak->is_told : is_small);
  ArrowPlaces places = places_along(text, tail, arrow.v, marks * size::kArrowHeadWidth / 2);
  MarkWord word{word_name(vector), text, {}};
  const bool is_tie = vector.kind == VectorKind::constraint;
  const auto add_about_tail = [&] {
    // A name that is farther off than a number is read with what stands there.
    for (const double off : std::span(kAboutPeak).first(vector.peak ? std::size(kAboutPeak) : kNearOfThese))
      for (const Rect& about : places_about(text, root, off, {0, 1})) word.places.push_back(about);
  };
  // What ties exert is known by where it acts, and turns quicker than an eye follows.
  if (is_tie) add_about_tail();
  const std::size_t along = word.places.size();
  word.places.insert(word.places.end(), places.boxes.begin(), places.boxes.end());
  // Of one that stands beside its link a word beyond its tip is at what acts on the next joint, and would be taken for its name.
  if (vector.aside != 0) {
    word.closed.assign(along, false);
    word.closed.insert(word.closed.end(), places.beyond_tip.begin(), places.beyond_tip.end());
  }
  // Where the arrow grows and turns as quickly, its number rides along with its place.
  word.anchor = is_tie || vector.peak ? root : tail + arrow.v;
  // Of arrows side by side each has half of the places.
  if (is_tie || vector.peak || vector.lane != 0) {
    // An arrow that is longer is near to all of these places.
    const double length = norm(arrow.v);
    if (length < kLeastUntied && !is_blank) word.tie = Tie{root, marks * kNearArrow, color_of(vector.kind, *theme_), tail + arrow.v};
    if (word.tie && !vector.peak) word.tie->cost = kFarName;
    if (!is_tie) add_about_tail();
  }
  if (vector.lane != 0) close_beyond_middle(word, place, vector.lane * normal_to(unit(arrow.v)));
  labels.add(std::move(word));
}

}  // namespace chainreel
