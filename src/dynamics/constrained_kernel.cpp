#include "dynamics/constrained_kernel.hpp"

#include <algorithm>

namespace chainreel {

namespace {

using Row = ConstrainedKernel::Row;

// Adds sign times the place of an anchor: per link in r_x, r_y, the constant part in at.
void add_anchor(const Chain& chain, const PlanarKernel& kernel, const ConstraintSet::Anchor& anchor,
                double sign, ConstrainedKernel::PerLink& r_x, ConstrainedKernel::PerLink& r_y,
                Eigen::Vector2d& at) {
  if (anchor.body == 0) {
    at += sign * Eigen::Vector2d(anchor.point.x, anchor.point.y);
    return;
  }
  at += sign * chain.planar->bodies[1].p_PJ;
  const auto last = std::size_t(anchor.body - 1);
  for (std::size_t i = 0; i < last; ++i) {
    r_x[i] += sign * kernel.l_x[i];
    r_y[i] += sign * kernel.l_y[i];
  }
  r_x[last] += sign * anchor.point.x;
  r_y[last] += sign * anchor.point.y;
}

Row row_of(const Chain& chain, const PlanarKernel& kernel, const ConstraintSet& set,
           const ConstraintSet::Row& source) {
  Row row;
  Eigen::Vector2d at(0, 0);
  ConstrainedKernel::PerLink r_x{}, r_y{};
  add_anchor(chain, kernel, set.anchors()[std::size_t(source.a)], 1, r_x, r_y, at);
  if (source.b >= 0) add_anchor(chain, kernel, set.anchors()[std::size_t(source.b)], -1, r_x, r_y, at);
  row.rod = source.kind == ConstraintSet::Kind::distance;
  if (row.rod) {
    row.a = r_x;
    row.b = r_y;
    row.d_x = at.x();
    row.d_y = at.y();
    row.length_inv = 1 / source.offset;
    return row;
  }
  for (std::size_t i = 0; i < r_x.size(); ++i) {
    row.a[i] = source.direction.y * r_x[i] - source.direction.x * r_y[i];
    row.b[i] = -(source.direction.x * r_x[i] + source.direction.y * r_y[i]);
  }
  return row;
}

}  // namespace

ConstrainedKernel constrained_kernel_of(const Chain& chain, const ConstraintSet& set) {
  ConstrainedKernel kernel;
  const PlanarKernel links = planar_kernel_of(chain);
  if (links.joints < 2 || chain.has_dissipation) return kernel;
  int rows = 0;
  for (const ConstraintSet::Row& source : set.row_list()) {
    const bool simple =
        source.kind == ConstraintSet::Kind::along || source.kind == ConstraintSet::Kind::distance;
    if (!simple) return kernel;
    const Row row = row_of(chain, links, set, source);
    const auto known = std::find(kernel.row.begin(), kernel.row.begin() + rows, row);
    if (known == kernel.row.end()) return kernel;
    const int place = int(known - kernel.row.begin());
    if (place == rows) kernel.row[std::size_t(rows++)] = row;
    kernel.group.push_back(place);
  }
  if (rows == 0) return kernel;
  for (int k = 0; k < rows; ++k)
    kernel.share[std::size_t(k)] = 1.0 / double(std::count(kernel.group.begin(), kernel.group.end(), k));
  kernel.rows = rows;
  kernel.doubled = int(kernel.group.size()) > rows;
  const bool wide = __builtin_cpu_supports("avx2");
  kernel.run =
      (wide ? constrained_kernel_for_avx2 : constrained_kernel_for_any_processor)(links.joints, rows);
  return kernel;
}

}  // namespace chainreel
