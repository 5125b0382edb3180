// Luma and chroma of BT.709 as sums of integers: the same bytes on every machine. Internal.
#pragma once

namespace chainreel {

struct Weights {
  int b, g, r;
};

constexpr int dot(const Weights& w, int b, int g, int r) {
  return w.b * b + w.g * g + w.r * r;
}

struct LumaChroma {
  Weights y, cb, cr;

  constexpr int white() const { return y.b + y.g + y.r; }
  constexpr bool grey_is_grey() const { return cb.b + cb.g + cb.r == 0 && cr.b + cr.g + cr.r == 0; }
};

}  // namespace chainreel
