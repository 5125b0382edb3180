// Which torques are a spring's or a damper's: those of which the scene's own text says so, by exact algebra on it
// (expr/affine), never by looking at values. What is not proven to be linear is not in the list.
#pragma once

#include <span>
#include <vector>

#include "expr/affine.hpp"
#include "model/chain.hpp"
#include "sim/drive/probe.hpp"

namespace chainreel {

// tau = -stiffness (q - rest) - damping qd + bias at one freedom, plus what is not told where it is no `whole`.
struct LinearDrive {
  int freedom = 0;
  double stiffness = 0;  // N m/rad or N/m, 0 or above
  double damping = 0;    // N m s/rad or N s/m, 0 or above; one of the two is above zero
  double rest = 0;       // rad or m, where there is stiffness and nothing is followed
  double bias = 0;       // N m or N, constant; 0 where there is stiffness, whose `rest` holds it
  bool follows = false;  // the rest is that of a reference motion, see TorqueLaw::reference_at
  bool whole = true;     // nothing else drives this freedom

  bool is_spring() const { return stiffness > 0; }
};

// Of a law that is an affine form a freedom in time, coordinates, rates and places of frames: the freedoms that are
// driven by their own coordinate and rate alone, with the signs of springs and dampers and without time. Places and
// speeds of frames count as coordinates where only sliders lead to them. `forms`: over the slots of the probe; of those
// that are no affine form, nothing. None with floating joints.
std::vector<LinearDrive> linear_drives_of(const Chain& chain, const Probe& probe,
                                          std::span<const std::optional<AffineForm<double>>> forms);

// The body that freedom i moves; -1 where it is one of a floating joint.
int body_of_freedom(const Chain& chain, int freedom);

}  // namespace chainreel
