#include "draw/layers/arcs_apart.hpp"

#include <algorithm>
#include <cstddef>

#include "picture/point.hpp"
#include "picture/theme.hpp"

namespace chainreel {
namespace {

constexpr double kArcAir = size::kArrowHeadWidth + 0.004;  // units of H: between two arcs there is room for a head
constexpr double kInside = 0.45;      // of its radius: the smallest arc ...
constexpr double kAroundDisc = 0.022;  // units of H: ... which still goes around the disc of its joint
constexpr double kMostGrown = 1.25;   // of its radius: an arc around another one
constexpr double kCounts = 0.020;     // units of H: an arc of this radius has its whole say, a smaller one is hardly in the way

struct PairSizes {
  double first = 1, second = 1;
};

// For a distance d of their joints.
PairSizes sizes_of(double first, double second, double d, double marks) {
  const double air = marks * kArcAir, inside = std::clamp(marks * kAroundDisc / std::min(first, second), kInside, 1.0);
  if (d >= first + second + air) return {};
  const double beside = (d - air) / (first + second);
  if (beside >= inside) return {beside, beside};
  // Between these two distances they cross, since there is room neither beside nor inside.
  const double last_beside = air + inside * (first + second);
  const double first_inside = std::clamp(kMostGrown * first - inside * second - air, 0.0, last_beside);
  if (d > first_inside) {
    const double way = (last_beside - d) / (last_beside - first_inside);
    return {inside + way * (kMostGrown - inside), inside};
  }
  return {std::clamp((d + inside * second + air) / first, 1.0, kMostGrown), inside};
}

}  // namespace

std::vector<double> arcs_apart(const std::vector<TorqueArc>& arcs, double marks) {
  std::vector<double> least(arcs.size(), 1), most(arcs.size(), 1);
  for (std::size_t j = 0; j < arcs.size(); ++j)
    for (std::size_t i = 0; i < j; ++i) {
      if (!(arcs[i].radius > 0 && arcs[j].radius > 0)) continue;
      const PairSizes pair = sizes_of(arcs[i].radius, arcs[j].radius, norm(arcs[j].center - arcs[i].center), marks);
      const double counts = std::min(1.0, std::min(arcs[i].radius, arcs[j].radius) / (marks * kCounts));
      const auto note = [&](std::size_t of, double size) {
        const double counted = 1 + counts * (size - 1);
        least[of] = std::min(least[of], counted);
        most[of] = std::max(most[of], counted);
      };
      note(i, pair.first);
      note(j, pair.second);
    }
  // What is in the way of one counts for more than what another has inside.
  std::vector<double> sizes(arcs.size());
  for (std::size_t i = 0; i < arcs.size(); ++i) sizes[i] = least[i] < 1 ? least[i] : most[i];
  return sizes;
}

}  // namespace chainreel
