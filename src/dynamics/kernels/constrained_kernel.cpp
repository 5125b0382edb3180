#include "dynamics/kernels/constrained_kernel.hpp"

#include <algorithm>

namespace chainreel {

namespace {

using KernelRow = ConstrainedKernel::Row;

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

KernelRow row_of(const Chain& chain, const PlanarKernel& kernel, const ConstraintSet& set,
           const ConstraintSet::Row& source) {
  KernelRow row;
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

// The anchor's place among those of the kernel.
int anchor_in_space(const Chain& chain, const ConstraintSet::Anchor& source, SpatialRows& rows) {
  SpatialRows::Anchor anchor;
  anchor.body = source.body;
  Eigen::Vector3d point(source.point.x, source.point.y, source.point.z);
  if (source.body > 0)
    point = kernel_axes(chain.bodies[std::size_t(source.body)].joint.axis).transpose() * point;
  for (int k = 0; k < 3; ++k) anchor.point[k] = {point[k], point[k], point[k], point[k]};
  const auto known = std::find(rows.anchors.begin(), rows.anchors.end(), anchor);
  const int place = int(known - rows.anchors.begin());
  if (known == rows.anchors.end()) rows.anchors.push_back(anchor);
  return place;
}

SpatialRows::Row row_in_space(const Chain& chain, const ConstraintSet& set, const ConstraintSet::Row& source,
                              SpatialRows& rows) {
  const auto anchor_of = [&](int k) {
    const ConstraintSet::Anchor origin{};
    return anchor_in_space(chain, k < 0 ? origin : set.anchors()[std::size_t(k)], rows);
  };
  SpatialRows::Row row;
  row.a = anchor_of(source.a);
  row.b = anchor_of(source.b);
  row.rod = source.kind == ConstraintSet::Kind::distance;
  if (row.rod)
    row.length_inv = 1 / source.offset;
  else
    row.direction = {source.direction.x, source.direction.y, source.direction.z, 0};
  return row;
}

// Whether the kernels know all rows.
bool are_simple(const ConstraintSet& set) {
  return std::all_of(set.row_list().begin(), set.row_list().end(), [](const ConstraintSet::Row& row) {
    return row.kind == ConstraintSet::Kind::along || row.kind == ConstraintSet::Kind::distance;
  });
}

// Finds the different ones of the set's rows; false where these are too many.
template <class Row, class MakeRow>
bool collect(const ConstraintSet& set, std::array<Row, ConstrainedKernel::kMostRows>& row,
             const MakeRow& make_row, ConstrainedKernel& kernel) {
  int rows = 0;
  for (const ConstraintSet::Row& source : set.row_list()) {
    const Row one = make_row(source);
    const auto end = row.begin() + rows;
    const auto known = std::find(row.begin(), end, one);
    if (known == row.end()) return false;
    if (known == end) row[std::size_t(rows++)] = one;
    kernel.group.push_back(int(known - row.begin()));
  }
  if (rows == 0) return false;
  for (int k = 0; k < rows; ++k)
    kernel.share[std::size_t(k)] = 1.0 / double(std::count(kernel.group.begin(), kernel.group.end(), k));
  kernel.rows = rows;
  kernel.doubled = int(kernel.group.size()) > rows;
  return true;
}

}  // namespace

ConstrainedKernel constrained_kernel_of(const Chain& chain, const ConstraintSet& set) {
  if (!are_simple(set)) return {};
  ConstrainedKernel kernel;
  if (const PlanarKernel links = planar_kernel_of(chain); links.joints >= 2) {
    const auto make_row = [&](const ConstraintSet::Row& row) { return row_of(chain, links, set, row); };
    if (!collect(set, kernel.row, make_row, kernel)) return {};
    kernel.run = constrained_run(links, kernel.rows);
    return kernel;
  }
  const SpatialKernel links = spatial_kernel_of(chain);
  if (chain.planar || links.joints == 0) return {};
  const auto make_row = [&](const ConstraintSet::Row& row) {
    return row_in_space(chain, set, row, kernel.in_space);
  };
  if (!collect(set, kernel.in_space.row, make_row, kernel)) return {};
  kernel.run = constrained_run(links, kernel.rows);
  return kernel;
}

}  // namespace chainreel
