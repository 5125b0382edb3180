#include "draw/layers/trail.hpp"

#include <algorithm>
#include <cmath>

#include "draw/robot/joints.hpp"
#include "picture/theme.hpp"

namespace chainreel {
namespace {

constexpr double kPiece =
    0.006;  // H: a piece this long of a turn of radius 0.03 H misses it by a sixth of a pixel
constexpr int kMostPieces = 24;  // between two frames

// 1 at the head, 0 at the end of the trail.
double freshness(double age) {
  return std::clamp(1 - age / kTrailSeconds, 0.0, 1.0);
}

TrailPoint trail_point(const TipPath& path, double t, double now) {
  const double fresh = freshness(now - t);
  return {path.at(t), size::kTrailTail + fresh * (size::kTrailHead - size::kTrailTail),
          kTrailOpacity * fresh};
}

}  // namespace

void TipPath::add(double t, Point place, Point speed) {
  const bool gap = !(is_drawable(place) && std::isfinite(speed.x) &&
                     std::isfinite(speed.y));
  t_.push_back(t);
  place_.push_back(gap ? Point{} : place);
  speed_.push_back(gap ? Point{} : speed);
  gap_.push_back(gap);
}

Point TipPath::at(double t) const {
  if (t >= t_.back()) return place_.back();
  const std::size_t i = std::size_t(frame_at(t));
  const double h = t_[i + 1] - t_[i], s = (t - t_[i]) / h;
  const double s2 = s * s, s3 = s2 * s;
  return (2 * s3 - 3 * s2 + 1) * place_[i] + ((s3 - 2 * s2 + s) * h) * speed_[i] +
         (3 * s2 - 2 * s3) * place_[i + 1] + ((s3 - s2) * h) * speed_[i + 1];
}

int TipPath::frame_at(double t) const {
  return std::max(0, int(std::upper_bound(t_.begin(), t_.end(), t) - t_.begin()) - 1);
}

int TipPath::pieces(int k, double length, int most) const {
  const std::size_t i = std::size_t(k);
  // A turn between two frames shows in the speeds, not in the distance.
  const double way = std::max(norm(place_[i + 1] - place_[i]),
                              std::max(norm(speed_[i]), norm(speed_[i + 1])) * (t_[i + 1] - t_[i]));
  return int(std::clamp(std::ceil(way / length), 1.0, double(most)));
}

double TipPath::gapless_since(int k, double t) const {
  for (int i = k; i >= 0; --i) {
    if (i < k && t_[std::size_t(i) + 1] - t_[std::size_t(i)] > kLongestTrailStep + 1e-9) return t_[std::size_t(i) + 1];
    if (gap_[std::size_t(i)]) return i == k ? t_[std::size_t(k)] : t_[std::size_t(i) + 1];
    if (t_[std::size_t(i)] <= t) return t;
  }
  return t_.front();
}

void draw_trail(Picture& picture, const TipPath& path, int k, Color color, int clip) {
  const double now = path.time(k);
  const double since = path.gapless_since(k, now - kTrailSeconds);
  if (!(since < now)) return;
  Trail trail;
  trail.color = color;
  for (int i = path.frame_at(since); i < k; ++i) {
    const double from = std::max(since, path.time(i)), to = path.time(i + 1);
    const int pieces = path.pieces(i, kPiece, kMostPieces);
    for (int j = 0; j < pieces; ++j)
      trail.points.push_back(trail_point(path, from + j * ((to - from) / pieces), now));
  }
  trail.points.push_back(trail_point(path, now, now));
  picture.add(std::move(trail), clip);

  // The dots stand still while the trail moves on: they belong to whole tenths of a second of the film.
  const double r = size::kTrailDot / 2;
  for (int i = int(std::ceil(since * kTrailDotsPerSecond)); double(i) / kTrailDotsPerSecond <= now; ++i) {
    const TrailPoint at = trail_point(path, double(i) / kTrailDotsPerSecond, now);
    if (at.alpha > 0) picture.add(Ellipse{at.p, {r, 0}, {0, r}, {color.faded(at.alpha), {}, 0}}, clip);
  }
}

}  // namespace chainreel
