#include "draw/layers/ghosts.hpp"

#include <algorithm>
#include <cmath>

namespace chainreel {

int ghost_spacing(FrameRate fps) {
  return std::max(1, int(std::lround(fps.value() * kGhostSeconds / kMostGhosts)));
}

std::vector<Ghost> ghosts_at(const std::vector<double>& times, int frame, FrameRate fps) {
  const double spacing = frame_time(ghost_spacing(fps), fps), half_frame = 0.5 / fps.value();
  std::vector<Ghost> ghosts;
  for (int age = kMostGhosts; age >= 1; --age) {
    const double t = times[std::size_t(frame)] - age * spacing;
    if (t < times.front() - 1e-9) continue;
    const auto after = std::lower_bound(times.begin(), times.end(), t - half_frame / 2);
    int nearest = int(after - times.begin());
    while (nearest + 1 < frame &&
           std::abs(times[std::size_t(nearest) + 1] - t) < std::abs(times[std::size_t(nearest)] - t))
      ++nearest;
    const double fade = double(age - 1) / (kMostGhosts - 1);
    ghosts.push_back(
        {nearest, kStrongestGhost + fade * (kFaintestGhost - kStrongestGhost), age <= kFilledGhosts});
  }
  return ghosts;
}

}  // namespace chainreel
