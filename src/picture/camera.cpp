#include "picture/camera.hpp"

#include <algorithm>
#include <cmath>

namespace chainreel {

void fit(Camera& camera, const Rect& box_m, const Rect& area, double margin) {
  double width_m = box_m.width() * (1 + 2 * margin);
  double height_m = box_m.height() * (1 + 2 * margin);
  if (!(width_m > 0) && !(height_m > 0)) width_m = height_m = 1;

  // A box that is only a line is bounded by one of the two quotients; the other is infinite.
  const double scale_x = width_m > 0 ? area.width() / width_m : HUGE_VAL;
  const double scale_y = height_m > 0 ? area.height() / height_m : HUGE_VAL;
  camera.scale = std::min(scale_x, scale_y);
  const Point center_m = {(box_m.x0 + box_m.x1) / 2, (box_m.y0 + box_m.y1) / 2};
  const Point center = {(area.x0 + area.x1) / 2, (area.y0 + area.y1) / 2};
  camera.origin = center - camera.scale * center_m;
}

}  // namespace chainreel
