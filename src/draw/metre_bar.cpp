#include "draw/metre_bar.hpp"

#include "core/format.hpp"

namespace chainreel {

double metre_bar_length(double scale, double scene_width) {
  return round_length(0.25 * scene_width / scale);
}

void draw_metre_bar(Picture& picture, const Camera& camera, const Sheet& sheet, const Fonts& fonts) {
  const double metres = metre_bar_length(camera.scale, sheet.scene.width());
  const double length = metres * camera.scale, text_size = scaled(size::kTick, sheet.text_scale);
  const Point at{sheet.scene.x0, sheet.scene.y0 + 0.6 * text_size};
  draw_scale_bar(picture, at, length, sheet.theme->ink);
  const TextStyle style{Face::label, text_size, sheet.theme->ink, Align::left};
  draw_text(picture, lay_out_text(fonts, format_shortest(metres) + " m", style),
            {at.x + length + 0.014, at.y - 0.36 * text_size});
}

}  // namespace chainreel
