// Film time: frame k is shown from k den / num to (k + 1) den / num seconds.
#pragma once

#include <cmath>
#include <string>

namespace chainreel {

struct FrameRate {
  int num = 60;
  int den = 1;
  double value() const { return double(num) / den; }
  friend bool operator==(const FrameRate&, const FrameRate&) = default;
};

// round(duration * fps), by integer index so that nothing accumulates.
inline int frame_count(double duration, FrameRate fps) {
  return int(std::lround(duration * fps.num / fps.den));
}

inline double frame_time(int k, FrameRate fps) {
  return double(k) * fps.den / fps.num;
}

}  // namespace chainreel
