#include "draw/section.hpp"

#include <algorithm>
#include <cmath>

namespace chainreel {

std::vector<MassAxis> section_axes(const EffectiveMass& effective, const Eigen::Matrix<double, 3, 2>& plane,
                                   EllipseReading reading) {
  const double largest = effective.mobility.size() < 3 ? 0 : effective.mobility.maxCoeff();
  if (!(largest > 0)) return mass_axes(effective);
  const double least = kSingularFraction * largest;  // 1/kg: smaller counts as none
  // The form of the curve of `energy` grows without bounds at singular poses, where the curve is a segment: a
  // mass beyond all that counts stands for it.
  constexpr double kBeyondAll = 1e-3;
  auto values = effective.mobility;
  for (double& m : values) {
    if (reading == EllipseReading::mass) m = m * m;
    if (reading == EllipseReading::energy) m = 1 / std::max(m, kBeyondAll * least);
  }
  const PlaneForm form = form_on_plane(effective, values, plane);
  std::vector<MassAxis> axes;
  for (int i = 0; i < 2; ++i) {
    // As kg, whatever the form says.
    double mobility = form.values[i];
    if (reading == EllipseReading::mass) mobility = std::sqrt(mobility);
    if (reading == EllipseReading::energy) mobility = mobility > 0 ? 1 / mobility : 0;
    MassAxis axis;
    axis.direction = form.directions.col(i);
    if (mobility > least) axis.mass = 1 / mobility;
    axes.push_back(axis);
  }
  if (reading == EllipseReading::energy) std::swap(axes[0], axes[1]);
  return axes;
}

}  // namespace chainreel
