#include "draw/page/word_plan.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>
#include <numbers>
#include <ranges>
#include <span>

namespace chainreel {
namespace {

constexpr double kPale = 0.3;           // opacity: fainter lines may lie below words
constexpr double kPieceOfArc = 0.3;     // rad
constexpr double kFadeSeconds = 0.12;
constexpr double kLeavesWith = 0.03;    // units of H: a place that sticks out of the area by more is none
constexpr std::size_t kCrowdOfWords = 60;      // words: of more each has its best place or none
// What it costs: a second without the word, on what may yield, at a place for each one before it in the list; and a
// change of places.
constexpr double kHidden = 9, kPoorGround = 2.7, kWorsePlace = 0.12, kChange = 1.2;
constexpr double kWorseOfMany = 0.005;  // the same of a place of words with a leader, which have many
constexpr double kCrossedByLeader = 0.3;  // the same for each piece of what is drawn that its line crosses
constexpr double kEndOfLeader = 0.03;  // units of H: what lies so near to its end is what it leads to
constexpr int kMostCrossed = 5;
constexpr double kMiddleOfLetters = 0.3;  // of their size, above the line and to either side
constexpr int kPlanRounds = 2;  // each word is placed again when all others have places

struct ShapeObstacles {
  std::vector<Obstacle>* found;

  void line(Point a, Point b, double radius) const {
    if (std::isfinite(a.x + a.y + b.x + b.y + radius)) found->push_back({a, b, radius, false});
  }
  static bool is_seen(const Paint& paint) { return paint.fill.a >= kPale || paint.stroke.a >= kPale; }

  void operator()(const Capsule& c) const {
    if (is_seen(c.paint)) line(c.a, c.b, c.radius + c.paint.stroke_width / 2);
  }
  void operator()(const Ellipse& e) const {
    if (!is_seen(e.paint)) return;
    const double wide = std::max(norm(e.u), norm(e.v));
    if (e.paint.fill.a >= kPale) return line(e.center, e.center, wide + e.paint.stroke_width / 2);
    const std::size_t first = found->size();
    curve(e.center, e.u, e.v, 0, 2 * std::numbers::pi, e.paint.stroke_width / 2);
    if (!e.fade.any()) return;
    const Rect seen = e.fade.inset(kPale);
    const auto is_unseen = [&](Obstacle& piece) { return !cut_segment(seen, piece.a, piece.b); };
    found->erase(std::remove_if(found->begin() + std::ptrdiff_t(first), found->end(), is_unseen), found->end());
  }
  void operator()(const Arc& a) const {
    if (a.color.a >= kPale) curve(a.center, {a.radius, 0}, {0, a.radius}, a.start, a.sweep, a.width / 2);
  }
  // Its edges and spokes: nothing as large as a word fits between.
  void operator()(const Polygon& p) const {
    if (!is_seen(p.paint)) return;
    Point middle;
    for (int i = 0; i < p.count; ++i) middle = middle + (1.0 / p.count) * p.corners[std::size_t(i)];
    for (int i = 0; i < p.count; ++i) {
      const Point a = p.corners[std::size_t(i)];
      line(a, p.corners[std::size_t((i + 1) % p.count)], p.paint.stroke_width / 2);
      if (p.paint.fill.a >= kPale) line(a, middle, 0);
    }
  }
  void operator()(const Trail& t) const {
    for (std::size_t i = 1; i < t.points.size(); ++i)
      if (t.color.a * t.points[i].alpha >= kPale) line(t.points[i - 1].p, t.points[i].p, t.points[i].width / 2);
  }
  void operator()(const Cells& c) const {
    for (const double share : {0.0, 0.5, 1.0}) {
      const double x = c.rect.x0 + share * c.rect.width();
      line({x, c.rect.y0}, {x, c.rect.y1}, 0);
    }
  }
  // About the middle of small letters.
  void operator()(const GlyphRun& run) const {
    if (run.glyphs.empty() || run.color.a < kPale || run.stroke_width > 0) return;
    const Point middle = run.origin + Point{0, kMiddleOfLetters * run.size};
    line(middle, middle + Point{run.glyphs.back().x + kMiddleOfLetters * run.size, 0}, kMiddleOfLetters * run.size);
  }
  void operator()(const Solids&) const {}

 private:
  void curve(Point center, Point u, Point v, double start, double sweep, double radius) const {
    const int pieces = std::max(1, int(std::ceil(std::abs(sweep) / kPieceOfArc)));
    const auto at = [&](int i) {
      const double angle = start + sweep * i / pieces;
      return center + std::cos(angle) * u + std::sin(angle) * v;
    };
    for (int i = 0; i < pieces; ++i) line(at(i), at(i + 1), radius);
  }
};

// An obstacle in its outer rectangle.
struct Blocked {
  Rect room;
  Obstacle by;
};

Rect room_of(const Obstacle& one) {
  return {std::min(one.a.x, one.b.x) - one.radius, std::min(one.a.y, one.b.y) - one.radius,
          std::max(one.a.x, one.b.x) + one.radius, std::max(one.a.y, one.b.y) + one.radius};
}

bool reaches(const Rect& one, const Rect& room) {
  return one.x1 >= room.x0 && one.x0 <= room.x1 && one.y1 >= room.y0 && one.y0 <= room.y1;
}

bool moves_on(const Rect& before, const Rect& now) {
  return norm(center_of(now) - center_of(before)) <= kWordStep;
}

// What a line from a word crosses, or runs along.
double cost_of_line(Point from, Point to, const std::vector<Blocked>& near) {
  int crossed = 0;
  const Rect room{std::min(from.x, to.x), std::min(from.y, to.y), std::max(from.x, to.x), std::max(from.y, to.y)};
  for (const auto& [outside, obstacle] : near) {
    if (!reaches(outside, room)) continue;
    const Point line = to - from, piece = obstacle.b - obstacle.a;
    const double s = cross(line, obstacle.a - from), t = cross(line, obstacle.b - from);
    const double u = cross(piece, from - obstacle.a), v = cross(piece, to - obstacle.a);
    const bool is_on = (s * t < 0 && u * v < 0) || distance_to(0.5 * (from + to), obstacle.a, obstacle.b) < obstacle.radius;
    if (is_on && ++crossed == kMostCrossed) break;
  }
  return crossed * kCrossedByLeader;
}

// On its way, but not at its end.
double cost_of_leader(const Leader& leader, const Rect& box, const std::vector<Blocked>& near) {
  const Point from{std::clamp(leader.to.x, box.x0, box.x1), std::clamp(leader.to.y, box.y0, box.y1)};
  const double length = norm(leader.to - from);
  if (!(length > kEndOfLeader)) return 0;
  return cost_of_line(from, leader.to - (kEndOfLeader / length) * (leader.to - from), near);
}

double cost_of_tie(const Tie& tie, const Rect& box, const std::vector<Blocked>& near) {
  const std::optional<TieLine> line = line_of(tie, box);
  return line ? cost_of_line(line->from, line->to, near) : 0;
}

// What lies there; of words that insist nothing takes it.
WordPlan::Ground ground_of(const Rect& box, const std::vector<Blocked>& near, bool insists) {
  WordPlan::Ground ground = WordPlan::Ground::free;
  const Rect room = widened(box, kWordAir);
  for (const auto& [outside, obstacle] : near) {
    if (!reaches(outside, room)) continue;
    Point from = obstacle.a, to = obstacle.b;
    if (!cut_segment(widened(box, obstacle.radius + kWordAir), from, to)) continue;
    if (insists) return WordPlan::Ground::poor;
    if (!obstacle.may_yield) return WordPlan::Ground::taken;
    ground = WordPlan::Ground::poor;
  }
  return ground;
}

// Those that any place of a word, or its line from there, may meet.
void find_near(const MarkWord& word, const Rect& area, const std::vector<Blocked>& all, std::vector<Blocked>& near) {
  Rect room = moved_into(area, word.places.front());
  for (const Rect& place : word.places) room = around(room, moved_into(area, place));
  for (const Point to : {word.leader ? word.leader->to : center_of(room), word.tie ? word.tie->to : center_of(room)})
    room = around(room, {to.x, to.y, to.x, to.y});
  room = widened(room, kWordAir);
  near.clear();
  std::copy_if(all.begin(), all.end(), std::back_inserter(near), [&](const Blocked& one) { return reaches(one.room, room); });
}

constexpr int kNowhere = -1;

}  // namespace

std::vector<Obstacle> obstacles_of(const Picture& picture, bool may_yield) {
  std::vector<Obstacle> found;
  for (const Item& item : picture.items) std::visit(ShapeObstacles{&found}, item.shape);
  for (Obstacle& obstacle : found) obstacle.may_yield = may_yield;
  return found;
}

// The one of its name that is nearest to where the word is wished, and has no word at this frame yet.
WordPlan::Track& WordPlan::track_of(const MarkWord& word, int frame) {
  std::vector<std::size_t>& named = by_name_[word.name];
  std::size_t nearest = tracks_.size();
  double least = std::numeric_limits<double>::infinity();
  for (const std::size_t i : named) {
    const Moment& last = tracks_[i].back();
    const double way = norm(center_of(last.places.front()) - center_of(word.places.front()));
    if (last.frame < frame && way < least) least = way, nearest = i;
  }
  if (nearest == tracks_.size()) {
    named.push_back(nearest);
    tracks_.emplace_back();
  }
  return tracks_[nearest];
}

void WordPlan::add(const std::vector<MarkWord>& words, const std::vector<Obstacle>& obstacles) {
  const int frame = int(counts_.size());
  counts_.push_back(int(words.size()));
  std::vector<Blocked> all, near;
  all.reserve(obstacles.size());
  for (const Obstacle& one : obstacles) all.push_back({room_of(one), one});
  const std::size_t most = words.size() > kCrowdOfWords ? 1 : std::numeric_limits<std::size_t>::max();
  for (std::size_t i = 0; i < words.size(); ++i) {
    Moment now{frame, int(i), {}, {}, words[i].leader.has_value(), {}};
    find_near(words[i], area_, all, near);
    for (const Rect& wish : words[i].places) {
      if (now.places.size() == most) break;
      const Rect box = moved_into(area_, wish);
      const bool is_inside = norm(center_of(box) - center_of(wish)) <= kLeavesWith;
      const bool is_closed = now.places.size() < words[i].closed.size() && words[i].closed[now.places.size()];
      const Ground ground = is_inside && !is_closed ? ground_of(box, near, now.insists) : Ground::taken;
      now.places.push_back(box);
      now.grounds.push_back(ground);
      if (words[i].leader) now.leaders.push_back(ground == Ground::taken ? 0 : cost_of_leader(*words[i].leader, box, near));
      if (words[i].tie && !words[i].leader) now.leaders.push_back(ground == Ground::taken ? 0 : cost_of_tie(*words[i].tie, box, near));
    }
    track_of(words[i], frame).push_back(std::move(now));
  }
}

namespace {

// The places of one word from frame to frame, kNowhere where it is left out: the way of least cost through all that are
// free, by dynamic programming. `cost_of`: of a second there, infinite where the place is taken.
template <class Track, class Cost>
std::vector<int> best_way(const Track& track, double fps, Cost cost_of) {
  const double never = std::numeric_limits<double>::infinity();
  struct State {
    double cost = 0;
    int before = kNowhere;
  };
  std::vector<std::vector<State>> states(track.size());  // the last one of each: left out
  for (std::size_t m = 0; m < track.size(); ++m) {
    const auto& now = track[m];
    const int places = int(now.places.size());
    states[m].resize(std::size_t(places) + 1);
    const bool goes_on = m > 0 && track[m - 1].frame + 1 == now.frame;
    // The best of the frame before, from where any place is taken with a change.
    int best = kNowhere;
    double least = 0;
    if (m > 0) {
      least = states[m - 1].back().cost;
      for (int p = 0; p + 1 < int(states[m - 1].size()); ++p) {
        const double cost = states[m - 1][std::size_t(p)].cost + kChange / 2;
        if (cost < least) least = cost, best = p;
      }
    }
    for (int p = 0; p < places; ++p) {
      State& state = states[m][std::size_t(p)];
      state = {never, kNowhere};
      const double cost = cost_of(m, p);
      if (cost == never) continue;
      state = {least + kChange / 2, best};
      if (goes_on && p + 1 < int(states[m - 1].size()) &&
          moves_on(track[m - 1].places[std::size_t(p)], now.places[std::size_t(p)]) &&
          states[m - 1][std::size_t(p)].cost <= state.cost)
        state = {states[m - 1][std::size_t(p)].cost, p};
      state.cost += cost / fps;
    }
    states[m].back() = {least + kHidden / fps, best};
  }
  std::vector<int> way(track.size());
  int place = kNowhere;
  double least = states.back().back().cost;
  for (int p = 0; p + 1 < int(states.back().size()); ++p)
    if (states.back()[std::size_t(p)].cost < least) least = states.back()[std::size_t(p)].cost, place = p;
  for (std::size_t m = track.size(); m-- > 0;) {
    way[m] = place;
    place = place == kNowhere ? states[m].back().before : states[m][std::size_t(place)].before;
  }
  return way;
}

// Full strength but for the first and the last frames of a stay; a film begins and ends with its words.
template <class Track>
std::vector<double> opacities(const Track& track, const std::vector<int>& way, double fps, int frames) {
  const int fade = std::max(1, int(std::lround(kFadeSeconds * fps)));
  const auto goes_on = [&](std::size_t m) {  // from the frame before
    return m > 0 && way[m] != kNowhere && way[m - 1] == way[m] && track[m - 1].frame + 1 == track[m].frame &&
           moves_on(track[m - 1].places[std::size_t(way[m - 1])], track[m].places[std::size_t(way[m])]);
  };
  std::vector<double> strength(track.size(), 0);
  for (std::size_t begin = 0, end = 1; begin < track.size(); begin = end, ++end) {
    while (end < track.size() && goes_on(end)) ++end;
    if (way[begin] == kNowhere) continue;
    const bool opens = track[begin].frame == 0, closes = track[end - 1].frame == frames - 1;
    for (std::size_t m = begin; m < end; ++m) {
      const int in = opens ? fade : int(m - begin) + 1, out = closes ? fade : int(end - m);
      strength[m] = std::min({1.0, double(in) / (fade + 1), double(out) / (fade + 1)});
      if (in >= fade && out >= fade) strength[m] = 1;
    }
  }
  return strength;
}

}  // namespace

std::vector<std::vector<StandingWord>> WordPlan::standing() const {
  const int frames = int(counts_.size());
  std::vector<std::vector<StandingWord>> words(counts_.size());
  for (std::size_t k = 0; k < counts_.size(); ++k) words[k].resize(std::size_t(counts_[k]), {{}, 0});
  for (int round = 0; round < kPlanRounds; ++round)
    // What is drawn above others has words first: vectors before the letters of axes.
    for (const Track& track : std::views::reverse(tracks_)) {
      for (const Moment& now : track) words[std::size_t(now.frame)][std::size_t(now.index)].opacity = 0;
      const auto cost_of = [&](std::size_t m, int p) {
        const Moment& now = track[m];
        const double never = std::numeric_limits<double>::infinity();
        const Ground ground = now.grounds[std::size_t(p)];
        if (ground == Ground::taken) return never;
        const Rect box = widened(now.places[std::size_t(p)], between_);
        const bool meets = std::any_of(words[std::size_t(now.frame)].begin(), words[std::size_t(now.frame)].end(),
                            [&](const StandingWord& other) { return other.opacity > 0 && overlap(box, other.box); });
        const double poor = ground == Ground::poor ? kPoorGround : 0;
        if (now.insists) return p * kWorseOfMany + now.leaders[std::size_t(p)] + poor + (meets ? kPoorGround : 0);
        const double line = now.leaders.empty() ? 0 : now.leaders[std::size_t(p)];
        return meets ? never : p * kWorsePlace + line + poor;
      };
      const std::vector<int> way = best_way(track, fps_, cost_of);
      const std::vector<double> strength = opacities(track, way, fps_, frames);
      for (std::size_t m = 0; m < track.size(); ++m)
        if (way[m] != kNowhere)
          words[std::size_t(track[m].frame)][std::size_t(track[m].index)] = {
              track[m].places[std::size_t(way[m])], strength[m]};
    }
  return words;
}

}  // namespace chainreel
