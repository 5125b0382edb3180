#include "draw/legend.hpp"

#include <algorithm>

#include "core/format.hpp"
#include "draw/sheet.hpp"

namespace chainreel {

std::vector<ScaleEntry> scale_entries(const VectorScales& scales, const std::vector<VectorKind>& shown,
                                      bool named, const Theme& theme) {
  std::vector<ScaleEntry> entries;
  for (const VectorKind kind : shown) {
    const VectorScale scale = scales.of(kind);
    const std::string name = named ? name_of(kind) + " " : "";
    const auto mark = kind == VectorKind::torque       ? ScaleEntry::Mark::turn
                      : kind == VectorKind::constraint ? ScaleEntry::Mark::dashed_arrow
                                                       : ScaleEntry::Mark::arrow;
    if (scale.largest > 0) {
      const double value = round_length(scale.largest);
      entries.push_back({mark, scale.on_page(value), color_of(kind, theme),
                         name + format_shortest(value) + "\u2009" + unit_of(kind)});
    } else if (kind == VectorKind::torque) {
      // Rings are drawn where nothing acts; arrows are not.
      entries.push_back({mark, 0, color_of(kind, theme), name + "0"});
    }
  }
  return entries;
}

std::vector<VectorKind> kinds_shown(const Chain& chain, const ActingLayers& layers) {
  bool turns = false, slides = false;
  for (std::size_t b = 1; b < chain.bodies.size(); ++b) {
    turns |= chain.bodies[b].joint.kind == JointKind::revolute;
    slides |= chain.bodies[b].joint.kind == JointKind::prismatic;
  }
  std::vector<VectorKind> kinds;
  if (layers.torque && turns) kinds.push_back(VectorKind::torque);
  if (layers.torque && slides) kinds.push_back(VectorKind::joint_force);
  if (layers.velocity) kinds.push_back(VectorKind::velocity);
  if (layers.gravity) kinds.push_back(VectorKind::weight);
  if (layers.constraint_force) kinds.push_back(VectorKind::constraint);
  return kinds;
}

std::string equation_of_motion(bool constrained) {
  return constrained ? "M(q) qdd + h(q, qd) + J_c^T lambda = tau" : "M(q) qdd + h(q, qd) = tau";
}

std::vector<SymbolColor> equation_colors(const ActingLayers& layers, const Theme& theme) {
  std::vector<SymbolColor> colors;
  if (layers.torque) colors.push_back({"tau", theme.torque});
  if (layers.constraint_force) colors.push_back({"lambda", theme.constraint});
  return colors;
}

}  // namespace chainreel
