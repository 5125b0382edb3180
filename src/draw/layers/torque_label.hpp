// What acts at the joints, as the lecture's slides write it: "tau = (10, 10, 10) N m".
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "model/chain.hpp"
#include "scene/scene.hpp"
#include "sim/drive/control.hpp"
#include "sim/drive/torque.hpp"

namespace chainreel {

// In the notation of lay_out_math: first every entry as the scene wrote it, then ever shorter forms for pages
// where that does not fit, the last one naming no entry at all. Unit N m where all joints are revolute, N
// where all are prismatic, none where they differ. No entries mean that no torque acts. Empty for a chain
// that cannot move.
// `control` drives the whole chain instead.
std::vector<std::string> torque_notations(const Chain& chain, const std::vector<TorqueEntry>& torque,
                                          const std::optional<Control>& control = {});

// The same of a scene, with what its contact forces add and what `limit: clamp` leaves of it: "tau = contact force 5 N",
// "tau = (10, 5) N m, cut at 2 N m".
std::vector<std::string> torque_notations(const Chain& chain, const Scene& scene);

// What resists in the joints, behind any of these: "damping 0.1 N m s", a number each where up to four joints differ. Empty where
// nothing does.
std::string resistance_notation(const Chain& chain);

// What a control does, in a word or two: "tau_g(q) + PD".
std::string control_notation(const Control& control);

}  // namespace chainreel
