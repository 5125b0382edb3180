#include "draw/layers/beside_links.hpp"

#include <algorithm>
#include <numbers>

#include "picture/point.hpp"

namespace chainreel {
namespace {

// The angle between an arrow and a link at which it stands beside it for good, and at which it lies over it as it would: at 12
// degrees an arrow of 0.12 H has left a link of usual width with half of its length.
constexpr double kAlong = 12, kAcross = 24;  // degrees
constexpr double kLeastHidden = 0.35, kMuchHidden = 0.6;  // of the arrow's length, over a link
constexpr double kShortArrow = 0.03, kLongArrow = 0.06;   // units of H: a short one hides little, and its tie would be as long
constexpr double kAirBeside = 0.004;                      // between the link's edge and the arrow's head, units of H
constexpr double kGoesAside = 0.3;    // s of the film, for the way there or back
constexpr double kLeastHiding = 0.25;  // s of the film: what a link hides for less is seen as it swings past

// From 0 at `from` to 1 at `to`.
double share_of_way(double x, double from, double to) {
  return std::clamp((x - from) / (to - from), 0.0, 1.0);
}

// The share of a-b that lies in the strip of `half` to both sides of the link, between its ends.
double share_over(const PageLine& arrow, const PageLine& link, double half) {
  const Point along = unit(link.b - link.a), side = normal_to(along);
  const auto place = [&](Point p) { return Point{dot(p - link.a, along), dot(p - link.a, side)}; };
  Point a = place(arrow.a), b = place(arrow.b);
  const double whole = norm(b - a);
  return whole > 0 && cut_segment({0, -half, norm(link.b - link.a), half}, a, b) ? norm(b - a) / whole : 0;
}

// What is wished for at each frame, 0 to 1, reached in time and left in time: the least course that is never below it and takes
// `frames` for the whole way.
std::vector<double> eased(std::vector<double> wished, double frames) {
  const double step = 1 / frames;
  for (std::size_t k = 1; k < wished.size(); ++k) wished[k] = std::max(wished[k], wished[k - 1] - step);
  for (std::size_t k = wished.size(); k-- > 1;) wished[k - 1] = std::max(wished[k - 1], wished[k] - step);
  for (double& one : wished) one *= one * (3 - 2 * one);
  return wished;
}

}  // namespace

std::vector<PageLine> links_on_page(const Panel& panel, const Workspace& ws) {
  std::vector<PageLine> links;
  for (const LinkSegment& link : panel.motion().skeleton().links) {
    const Eigen::Isometry3d X_WB = pose_of(ws, link.body);
    const PageLine line{panel.camera().project(X_WB * link.from), panel.camera().project(X_WB * link.to)};
    if (is_drawable(line.a) && is_drawable(line.b)) links.push_back(line);
  }
  return links;
}

LiesAlong lies_along(const PageLine& arrow, const PageLine& link, double half) {
  const Point a = arrow.b - arrow.a, b = link.b - link.a;
  if (!(norm(a) > 0) || !(norm(b) > 0)) return {};
  const double angle = std::atan2(std::abs(cross(a, b)), std::abs(dot(a, b))) * 180 / std::numbers::pi;
  // The way that the link goes from where the arrow begins, whichever of its ends is there.
  const double way = dot(a, b) > 0 ? 1 : -1;
  return {share_of_way(angle, kAcross, kAlong) * share_of_way(share_over(arrow, link, half), kLeastHidden, kMuchHidden) *
              share_of_way(norm(a), kShortArrow, kLongArrow),
          way * cross(a, b) / (norm(a) * norm(b))};
}

double way_beside(const ChainLook& look) {
  return look.link_width / 2 + look.stroke * size::kLinkOutline / 2 + kAirBeside + look.marks * size::kArrowHeadWidth / 2;
}

std::vector<double> ways_aside(const std::vector<LiesAlong>& along, double fps) {
  const std::size_t frames = along.size();
  std::vector<double> left(frames), right(frames);
  for (std::size_t begin = 0, end = 0; begin < frames; begin = end + 1) {
    end = begin;
    double hiding = 0, leans = 0;
    for (; end < frames && along[end].much > 0; ++end) {
      hiding += along[end].much / fps;
      leans += along[end].much * along[end].leans;
    }
    // The first frame and the last one are looked at for long.
    const bool is_looked_at = end > begin && (begin == 0 || end == frames);
    if (!is_looked_at && hiding < kLeastHiding) continue;
    std::vector<double>& wished = leans > 0 ? right : left;
    for (std::size_t k = begin; k < end; ++k) wished[k] = along[k].much;
  }
  const std::vector<double> to_left = eased(std::move(left), kGoesAside * fps), to_right = eased(std::move(right), kGoesAside * fps);
  std::vector<double> ways(frames);
  for (std::size_t k = 0; k < frames; ++k) ways[k] = to_left[k] - to_right[k];
  return ways;
}

}  // namespace chainreel
