// The way of the end effector behind it: the last second, thinner and fainter with age, with dots every 0.1
// s.
#pragma once

#include <vector>

#include "picture/picture.hpp"

namespace chainreel {

inline constexpr double kTrailSeconds = 1.0;
inline constexpr int kTrailDotsPerSecond = 10;
inline constexpr double kTrailOpacity = 0.7;
// Frames further apart, where a film shows the motion much faster than it was, do not say how it went between them.
inline constexpr double kLongestTrailStep = 0.1;  // s

// Where the end effector was on the page and how fast it moved there, at the frames.
class TipPath {
 public:
  // `speed` in page units a second. A place off the page by far, or not finite, is a gap: no trail crosses
  // it.
  void add(double t, Point place, Point speed);

  int size() const { return int(t_.size()); }
  double time(int k) const { return t_[std::size_t(k)]; }
  Point place(int k) const { return place_[std::size_t(k)]; }
  // Between the frames: the cubic that has their places and speeds. `t` within the path.
  Point at(double t) const;
  int frame_at(double t) const;  // the last one not after t
  // Into how many straight pieces the way from frame k to the next one is to be cut for none to be longer
  // than `length`.
  int pieces(int k, double length, int most) const;
  // The frame after which no gap lies before frame k, not earlier than `t`.
  double gapless_since(int k, double t) const;

 private:
  std::vector<double> t_;
  std::vector<Point> place_, speed_;
  std::vector<bool> gap_;
};

// The trail as it stands at frame k.
void draw_trail(Picture& picture, const TipPath& path, int k, Color color, int clip);

}  // namespace chainreel
