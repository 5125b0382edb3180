#include "sim/tip_reader.hpp"

namespace chainreel {

void require_frame_of(const Chain& chain, const Probe& probe, int slot, const Place& place) {
  // No other frame may be called G.
  const std::string& name = probe.names()[std::size_t(slot)];
  if (chain.end_effector >= 0 || !probe.is_kinematic(slot) || !name.ends_with("_G")) return;
  try {
    require_end_effector(chain);
  } catch (const Error& error) {
    throw Error(error.code(), name + " is of the end effector: " + error.problems().front().message, place);
  }
}

}  // namespace chainreel
