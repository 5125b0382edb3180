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

constexpr double kPale = 0.3, kPaleOfTrail = 0.15;  // opacity: fainter lines may lie below words; a trail is one long line that words would hang on
constexpr double kPieceOfArc = 0.3;     // rad
constexpr double kLeavesWith = 0.03;    // units of H: a place that sticks out of the area by more is none
constexpr std::size_t kCrowdOfWords = 60;      // words: of more each has its best place or none
// What it costs: a second without the word, on what may yield, at a place for each one before it in the list; and a
// change of places.
constexpr double kHidden = 9, kPoorGround = 4, kWorsePlace = 0.12, kChange = 1.2;
constexpr double kStandsLonger = 0.5;  // s, for which the first and the last frame of a film count more: as posters and when it is over
constexpr double kWorseOfMany = 0.005;  // the same of a place of words with a leader, which have many
constexpr double kCrossedByLeader = 0.3;  // the same for each piece of what is drawn that its line crosses
constexpr double kFirm = 4;  // times that, to a name that rather goes than is led far: one on which no word may stand, as a link
constexpr double kEndOfLeader = 0.03;  // units of H: what lies so near to its end is what it leads to
constexpr int kMostCrossed = 5;
constexpr double kMiddleOfLetters = 0.3;  // of their size, above the line and to either side
constexpr int kStretch = 1800;  // frames of a film that are decided upon together
constexpr double kAhead = 2, kSure = 0.5, kBehind = 0.5;  // s: how far it is looked beyond them, what of that stays as it was decided, what is kept of those before
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
      if (t.color.a * t.points[i].alpha >= kPaleOfTrail) line(t.points[i - 1].p, t.points[i].p, t.points[i].width / 2);
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

// Asked millions of times in a film.
[[gnu::always_inline]] inline bool reaches(const Rect& one, const Rect& room) {
  return one.x1 >= room.x0 && one.x0 <= room.x1 && one.y1 >= room.y0 && one.y0 <= room.y1;
}

// What a line from a word crosses, or runs along. `firm`: what is no ground for words counts so many times.
double cost_of_line(Point from, Point to, const std::vector<Blocked>& near, double firm = 1) {
  int crossed = 0;
  double cost = 0;
  const Rect room{std::min(from.x, to.x), std::min(from.y, to.y), std::max(from.x, to.x), std::max(from.y, to.y)};
  for (const auto& [outside, obstacle] : near) {
    if (!reaches(outside, room)) continue;
    const Point line = to - from, piece = obstacle.b - obstacle.a;
    const double s = cross(line, obstacle.a - from), t = cross(line, obstacle.b - from);
    const double u = cross(piece, from - obstacle.a), v = cross(piece, to - obstacle.a);
    const bool is_on = (s * t < 0 && u * v < 0) || distance_to(0.5 * (from + to), obstacle.a, obstacle.b) < obstacle.radius;
    if (!is_on) continue;
    cost += kCrossedByLeader * (obstacle.may_yield ? 1 : firm);
    if (++crossed == kMostCrossed) break;
  }
  return cost;
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
  return line ? cost_of_line(line->from, line->to, near, tie.cost > 0 ? kFirm : 1) : 0;
}

bool reaches(const Rect& box, const Obstacle& obstacle) {
  Point from = obstacle.a, to = obstacle.b;
  return cut_segment(widened(box, obstacle.radius + kWordAir), from, to);
}

// What lies there; of words that insist nothing takes it.
WordPlan::Ground ground_of(const Rect& box, const std::vector<Blocked>& near, bool insists) {
  WordPlan::Ground ground = WordPlan::Ground::free;
  const Rect room = widened(box, kWordAir);
  for (const auto& [outside, obstacle] : near) {
    if (!reaches(outside, room) || !reaches(box, obstacle)) continue;
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

constexpr int kNowhere = ChosenPlace::kNowhere;

}  // namespace

bool moves_on(const StandingWord& before, const StandingWord& now) {
  const Point way = center_of(now.box) - center_of(before.box);
  if (norm(way) <= kWordStep) return true;
  if (!before.anchor || !now.anchor) return false;
  const Point ride = *now.anchor - *before.anchor;
  return norm(ride) <= kAnchorStep && norm(way - ride) <= kWordStep;
}

std::vector<Obstacle> obstacles_of(const Picture& picture, bool may_yield) {
  std::vector<Obstacle> found;
  for (const Item& item : picture.items) std::visit(ShapeObstacles{&found}, item.shape);
  for (Obstacle& obstacle : found) obstacle.may_yield = may_yield;
  return found;
}

bool lies_on(const Rect& box, const std::vector<Obstacle>& obstacles, bool on_what_yields) {
  return std::ranges::any_of(obstacles, [&](const Obstacle& one) { return (on_what_yields || !one.may_yield) && reaches(box, one); });
}

// The one of its name that is nearest to where the word is wished, and has no word at this frame yet.
WordPlan::Track& WordPlan::track_of(const MarkWord& word, int frame) {
  std::vector<std::size_t>& named = by_name_[word.name];
  std::size_t nearest = tracks_.size();
  double least = std::numeric_limits<double>::infinity();
  for (const std::size_t i : named) {
    const double way = norm(tracks_[i].last_wish - center_of(word.places.front()));
    if (tracks_[i].last_frame < frame && way < least) least = way, nearest = i;
  }
  if (nearest == tracks_.size()) {
    named.push_back(nearest);
    tracks_.emplace_back();
  }
  return tracks_[nearest];
}

void WordPlan::add(const std::vector<MarkWord>& words, const std::vector<Obstacle>& obstacles) {
  const int frame = frames();
  counts_.push_back(int(words.size()));
  std::vector<Blocked> all, near;
  all.reserve(obstacles.size());
  for (const Obstacle& one : obstacles) all.push_back({room_of(one), one});
  const std::size_t most = words.size() > kCrowdOfWords ? 1 : std::numeric_limits<std::size_t>::max();
  for (std::size_t i = 0; i < words.size(); ++i) {
    Moment now{frame, int(i), {}, {}, words[i].leader.has_value(), {}, words[i].anchor, {}, {}, words[i].leader};
    if (!now.insists) now.tie = words[i].tie;
    find_near(words[i], area_, all, near);
    const std::size_t places = std::min(words[i].places.size(), most);
    now.places.reserve(places);
    now.grounds.reserve(places);
    if (words[i].leader || now.tie) now.leaders.reserve(places);
    for (const Rect& wish : words[i].places) {
      if (now.places.size() == most) break;
      const Rect box = moved_into(area_, wish);
      const bool is_inside = norm(center_of(box) - center_of(wish)) <= kLeavesWith;
      const bool is_closed = now.places.size() < words[i].closed.size() && words[i].closed[now.places.size()];
      const Ground ground = is_inside && !is_closed ? ground_of(box, near, now.insists) : Ground::taken;
      now.places.push_back(box);
      now.grounds.push_back(ground);
      if (words[i].leader) now.leaders.push_back(ground == Ground::taken ? 0 : cost_of_leader(*words[i].leader, box, near));
      if (now.tie) now.leaders.push_back(ground == Ground::taken ? 0 : cost_of_tie(*now.tie, box, near));
    }
    Track& track = track_of(words[i], frame);
    track.last_frame = frame;
    track.last_wish = center_of(now.places.front());
    track.moments.push_back(std::move(now));
  }
  const int ahead = frames_in(kAhead);
  if (frames() - settled_ >= kStretch + ahead) settle(frames() - ahead);
}

namespace {

// What it costs to stand at a place up to a moment.
struct Stay {
  int frames = 0;  // for how long it has been to be had there
  double along = 0;  // what these cost
  double least = std::numeric_limits<double>::infinity();  // of all ways that end there
  int begins = 0;  // of that way: it has come there so many frames ago; 0: it was there before
};
// The way of least cost through the moments before one, and where it ends.
struct Before {
  double cost = 0;
  int place = kNowhere;
};

// Whether a word that stands at a place at moment m has stood there at the one before.
template <class Track>
bool goes_on(const Track& track, std::size_t m, int place) {
  return m > 0 && track[m - 1].frame + 1 == track[m].frame && place < int(track[m - 1].places.size()) &&
         moves_on(track[m - 1].at(place), track[m].at(place));
}

// The places of one word from frame to frame, kNowhere where it is left out: the way of least cost through all that are
// free, by dynamic programming, with stays of `shortest` frames at least but at the first and the last of all `frames`, which stand
// longer than the others. `cost_of`: of being there for a moment, infinite where the place is taken; `hidden`: of being nowhere.
template <class Track, class Cost, class Hidden>
std::vector<int> best_way(const Track& track, int frames, int shortest, Cost cost_of, Hidden hidden) {
  std::vector<std::vector<Stay>> stays(track.size());
  std::vector<Before> before(track.size() + 1);  // with half the change of places, if it ends at one
  Before last;
  for (std::size_t m = 0; m < track.size(); ++m) {
    stays[m].resize(track[m].places.size());
    last = {before[m].cost + hidden(m), kNowhere};
    before[m + 1] = last;
    for (int p = 0; p < int(stays[m].size()); ++p) {
      Stay& stay = stays[m][std::size_t(p)];
      const double cost = cost_of(m, p);
      if (!std::isfinite(cost)) continue;
      const Stay earlier = goes_on(track, m, p) ? stays[m - 1][std::size_t(p)] : Stay{};
      stay.frames = earlier.frames + 1;
      stay.along = earlier.along + cost;
      const int from = track[m].frame == 0 || track[m].frame == frames - 1 || track[m].fixed ? 1 : shortest;
      for (int ago = from; ago <= std::min(shortest, stay.frames); ++ago) {
        const std::size_t begin = m + 1 - std::size_t(ago);
        const double passed = stay.frames > ago ? stays[begin - 1][std::size_t(p)].along : 0;
        const double least = before[begin].cost + kChange / 2 + stay.along - passed;
        if (least < stay.least) stay.least = least, stay.begins = ago;
      }
      if (earlier.least + cost <= stay.least) stay.least = earlier.least + cost, stay.begins = 0;
      if (stay.least < last.cost) last = {stay.least, p};
      if (stay.least + kChange / 2 < before[m + 1].cost) before[m + 1] = {stay.least + kChange / 2, p};
    }
  }
  std::vector<int> way(track.size());
  int place = last.place;
  for (std::size_t m = track.size(); m > 0;) {
    const int begins = place == kNowhere ? 1 : stays[m - 1][std::size_t(place)].begins;
    for (int ago = std::max(1, begins); ago > 0; --ago) way[--m] = place;
    if (begins > 0) place = before[m].place;
  }
  return way;
}

// Full strength but for the first and the last frames of a stay; a film begins and ends with its words.
template <class Track>
std::vector<double> opacities(const Track& track, const std::vector<int>& way, double fps, int frames) {
  const int fade = std::max(1, int(std::lround(kFadeSeconds * fps)));
  std::vector<double> strength(track.size(), 0);
  for (std::size_t begin = 0, end = 1; begin < track.size(); begin = end, ++end) {
    while (end < track.size() && way[end] == way[begin] && way[end] != kNowhere && goes_on(track, end, way[end])) ++end;
    if (way[begin] == kNowhere) continue;
    const bool opens = track[begin].frame == 0, closes = track[end - 1].frame == frames - 1;
    // A stay too short for that is whole at the film's end of it, unless the word stands elsewhere next: posters have whole words.
    const auto is_away = [&](std::size_t m) { return way[m] == kNowhere; };
    const bool is_alone = (begin == 0 || is_away(begin - 1)) && (end == track.size() || is_away(end));
    const int whole = is_alone ? std::min(fade + 1, int(end - begin)) : fade + 1;
    for (std::size_t m = begin; m < end; ++m) {
      const int in = opens ? fade : int(m - begin) + 1, out = closes ? fade : int(end - m);
      strength[m] = std::min({1.0, double(in) / (closes ? whole : fade + 1), double(out) / (opens ? whole : fade + 1)});
      if (in >= fade && out >= fade) strength[m] = 1;
    }
  }
  return strength;
}

bool crosses(const std::optional<TieLine>& line, const Rect& box) {
  if (!line) return false;
  Point from = line->from, to = line->to;
  return cut_segment(box, from, to);
}

}  // namespace

struct WordPlan::Placed {
  StandingWord word{{}, 0, {}};
  std::optional<TieLine> line{};  // that leads there
  int place = kNowhere;

  ChosenPlace chosen() const { return {std::int16_t(place), float(word.opacity)}; }
  // Whether one hides the other, or is struck by its line.
  bool meets(const Rect& box, const std::optional<TieLine>& other, double between) const {
    if (!(word.opacity > 0)) return false;
    const Rect wide = widened(box, between);
    return overlap(wide, word.box) || crosses(line, wide) || crosses(other, widened(word.box, between));
  }
};

// Those that insist have words first, to which others yield with their lines; then what is drawn above others: vectors before the
// letters of axes.
std::vector<const WordPlan::Track*> WordPlan::in_order() const {
  std::vector<const Track*> order;
  for (const Track& track : std::views::reverse(tracks_))
    if (!track.moments.empty()) order.push_back(&track);
  std::ranges::stable_partition(order, [](const Track* track) { return track->moments.front().insists; });
  return order;
}

int WordPlan::frames_in(double seconds) const {
  return std::max(1, int(std::lround(seconds * fps_)));
}

// `is_whole`: the last frame is that of the film.
WordPlan::Decisions WordPlan::decide(bool is_whole) const {
  const int all = is_whole ? frames() : std::numeric_limits<int>::max();
  const int shortest = std::clamp(frames_in(kShortestStay), 1, std::max(1, all));
  Decisions placed(counts_.size());
  for (std::size_t k = 0; k < counts_.size(); ++k) placed[k].resize(std::size_t(counts_[k]));
  // Figures keep ties apart themselves, where words have many more of them (draw/figures/pose_labels).
  const auto line_at = [all](const Moment& now, int place) {
    return all > 1 || now.leader ? now.line_at(place) : std::nullopt;
  };
  const auto frame_of = [&](const Moment& now) -> std::vector<Placed>& { return placed[std::size_t(now.frame - first_)]; };
  for (int round = 0; round < kPlanRounds; ++round)
    for (const Track* one : in_order()) {
      const std::vector<Moment>& track = one->moments;
      for (const Moment& now : track) frame_of(now)[std::size_t(now.index)].word.opacity = 0;
      // How long a frame is looked at, s.
      const auto stands = [&](std::size_t m) {
        const bool is_end = track[m].frame == 0 || track[m].frame == all - 1;
        return 1 / fps_ + (is_end && all > 1 ? kStandsLonger : 0);
      };
      const double never = std::numeric_limits<double>::infinity();
      const auto cost_of = [&](std::size_t m, int p) {
        const Moment& now = track[m];
        if (now.fixed) return *now.fixed == p ? 0 : never;
        const Ground ground = now.grounds[std::size_t(p)];
        if (ground == Ground::taken) return never;
        const std::optional<TieLine> own = line_at(now, p);
        const bool is_met = std::ranges::any_of(frame_of(now), [&](const Placed& other) {
          return other.meets(now.places[std::size_t(p)], own, between_);
        });
        const double poor = ground == Ground::poor ? kPoorGround * stands(m) : 0;
        if (now.insists) return (p * kWorseOfMany + now.leaders[std::size_t(p)]) / fps_ + poor + (is_met ? kPoorGround * stands(m) : 0);
        const double line = now.leaders.empty() ? 0 : now.leaders[std::size_t(p)];
        const double tied = own && now.tie ? now.tie->cost * norm(own->to - own->from) : 0;
        return is_met ? never : (p * kWorsePlace + line + tied) / fps_ + poor;
      };
      const auto hidden = [&](std::size_t m) {
        const auto& fixed = track[m].fixed;
        return !fixed ? kHidden * stands(m) : *fixed == kNowhere ? 0 : never;
      };
      const std::vector<int> way = best_way(track, all, track.front().insists ? 1 : shortest, cost_of, hidden);
      const std::vector<double> strength = opacities(track, way, fps_, all);
      for (std::size_t m = 0; m < track.size(); ++m) {
        const Moment& now = track[m];
        Placed& here = frame_of(now)[std::size_t(now.index)];
        here.place = way[m];
        if (way[m] != kNowhere) here.word = now.at(way[m], strength[m]), here.line = line_at(now, way[m]);
      }
    }
  return placed;
}

// Of those that are not settled the ones before `end`.
void WordPlan::add_frames(const Decisions& placed, int end, PlannedWords& planned) const {
  std::vector<ChosenPlace> words;
  for (int frame = settled_; frame < end; ++frame) {
    words.clear();
    for (const Placed& one : placed[std::size_t(frame - first_)]) words.push_back(one.chosen());
    planned.add_frame(words);
  }
}

// Frames before `end` are decided for good. What comes soon behind is, too, so that a word which fades there has begun to.
void WordPlan::settle(int end) {
  const Decisions placed = decide(false);
  add_frames(placed, end, planned_);
  settled_ = end;
  const int sure = end + frames_in(kSure), kept = std::max(first_, end - frames_in(kBehind));
  for (Track& track : tracks_) {
    for (Moment& now : track.moments)
      if (now.frame < sure) now.fixed = placed[std::size_t(now.frame - first_)][std::size_t(now.index)].place;
    std::erase_if(track.moments, [&](const Moment& now) { return now.frame < kept; });
  }
  counts_.erase(counts_.begin(), counts_.begin() + (kept - first_));
  first_ = kept;
}

PlannedWords WordPlan::planned() const {
  PlannedWords all = planned_;
  add_frames(decide(true), frames(), all);
  return all;
}

std::vector<std::vector<StandingWord>> WordPlan::standing() const {
  std::vector<std::vector<StandingWord>> words;
  for (const std::vector<Placed>& frame : decide(true)) {
    words.emplace_back();
    for (const Placed& one : frame) words.back().push_back(one.word);
  }
  return words;
}

}  // namespace chainreel
