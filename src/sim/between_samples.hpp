// What happens between the samples of a run, where neither arrows nor tables show it (plots look there, too): a torque faster than the
// frames, or a push between two of them.
#pragma once

#include <optional>

#include "sim/doubts.hpp"

namespace chainreel {

// Shares of the range of a curve: by so much what is between two samples may go beyond both. The sharp peaks of a smooth
// motion at 60 Hz hide up to a tenth; of torques between whose kinks is looked, as of pulses and tables, all is known.
inline constexpr double kDoubtfulSamples = 0.15, kDoubtfulPulse = 0.05;

// Rates, torques and multipliers at some instants between the samples and at the
// kinks of the torques there; nothing where they keep to what the samples show. Kind "samples". The torques' instants are
// exact, the states between come from a cubic through the samples (brought back onto the constraints, where the run is),
// of floating bases from their rates. A jump from one sample to the next is not hidden. A run sampled at its steps
// shows what its method did, and is not looked at.
std::optional<Doubt> doubt_between(const Simulation& simulation, const Trajectory& trajectory);

}  // namespace chainreel
