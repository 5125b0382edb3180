#include "picture/plot_hatch.hpp"

#include <algorithm>
#include <cmath>

#include "picture/theme.hpp"

namespace chainreel {
namespace {

constexpr double kSpacing = size::kGroundSpacing;  // across the lines
constexpr double kLine = size::kGroundHatch * 0.75;

struct Hatcher {
  Picture& picture;
  const Rect& box;
  int nx, ny;
  const std::vector<bool>& marked;
  Color color;

  bool is_marked(Point p) const {
    const int i = std::clamp(int((p.x - box.x0) / box.width() * nx), 0, nx - 1);
    const int j = std::clamp(int((p.y - box.y0) / box.height() * ny), 0, ny - 1);
    return marked[std::size_t(j) * std::size_t(nx) + std::size_t(i)];
  }

  // The line y = x + offset, from x0 to x1: cut where it passes from one cell to the next.
  void draw_line(double offset, double x0, double x1) const {
    std::vector<double> cuts = {x0, x1};
    for (int i = 1; i < nx; ++i) cuts.push_back(box.x0 + i * box.width() / nx);
    for (int j = 1; j < ny; ++j) cuts.push_back(box.y0 + j * box.height() / ny - offset);
    std::erase_if(cuts, [&](double x) { return x < x0 || x > x1; });
    std::sort(cuts.begin(), cuts.end());
    for (std::size_t k = 0; k + 1 < cuts.size();) {
      const auto inside = [&](std::size_t n) {
        const double x = (cuts[n] + cuts[n + 1]) / 2;
        return is_marked({x, x + offset});
      };
      const std::size_t first = k++;
      if (!inside(first)) continue;
      while (k + 1 < cuts.size() && inside(k)) ++k;
      const Point from = {cuts[first], cuts[first] + offset}, to = {cuts[k], cuts[k] + offset};
      picture.add(Capsule{from, to, kLine / 2, {color, {}, 0}});
    }
  }
};

}  // namespace

void draw_hatch(Picture& picture, const Rect& box, int nx, int ny, const std::vector<bool>& marked,
                Color color) {
  if (nx < 1 || ny < 1 || marked.size() != std::size_t(nx) * std::size_t(ny)) return;
  const Hatcher hatcher{picture, box, nx, ny, marked, color};
  const double pitch = kSpacing * std::sqrt(2.0);
  for (double offset = box.y0 - box.x1 + pitch / 2; offset < box.y1 - box.x0; offset += pitch) {
    const double x0 = std::max(box.x0, box.y0 - offset), x1 = std::min(box.x1, box.y1 - offset);
    if (x1 > x0) hatcher.draw_line(offset, x0, x1);
  }
}

}  // namespace chainreel
