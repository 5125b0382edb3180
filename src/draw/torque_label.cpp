#include "draw/torque_label.hpp"

#include "core/format.hpp"

namespace chainreel {
namespace {

std::string unit_of(const Chain& chain) {
  bool revolute = false, prismatic = false;
  for (std::size_t b = 1; b < chain.bodies.size(); ++b) {
    const JointKind kind = chain.bodies[b].joint.kind;
    revolute |= kind != JointKind::prismatic;
    prismatic |= kind != JointKind::revolute;  // a floating joint has forces and torques
  }
  if (revolute == prismatic) return "";
  return revolute ? " N m" : " N";
}

// The first entries and the last one, `shown` in all.
std::string list_of(const std::vector<std::string>& entries, std::size_t shown) {
  std::string list;
  for (std::size_t i = 0; i < entries.size(); ++i) {
    if (shown < entries.size() && i + 1 == shown) {
      list += "\u2026, ";
      i = entries.size() - 1;
    }
    list += entries[i] + (i + 1 < entries.size() ? ", " : "");
  }
  return list;
}

}  // namespace

std::vector<std::string> torque_notations(const Chain& chain, const std::vector<TorqueEntry>& torque) {
  std::vector<std::string> entries;
  for (const TorqueEntry& entry : torque) entries.push_back(entry.text);
  if (entries.empty()) entries.assign(std::size_t(chain.nv), "0");
  if (entries.empty()) return {};
  if (entries.size() == 1 && parse_number(entries[0])) return {"tau = " + entries[0] + unit_of(chain)};
  std::vector<std::string> forms;
  for (std::size_t shown = entries.size(); shown >= 2; --shown) {
    if (shown == entries.size() || shown <= 8)
      forms.push_back("tau = (" + list_of(entries, shown) + ")" + unit_of(chain));
  }
  if (entries.size() == 1) forms.push_back("tau = (" + entries[0] + ")" + unit_of(chain));
  forms.push_back("tau = tau(t, q, qd)");
  return forms;
}

}  // namespace chainreel
