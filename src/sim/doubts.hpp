// What speaks against a run that came to its end: the method did what it could, and that is not the motion.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/names.hpp"
#include "sim/accuracy.hpp"
#include "sim/audit.hpp"

namespace chainreel {

// A share of the Audit's energy_moved: an audit error beyond it is told.
inline constexpr double kDoubtfulEnergy = 0.01;
// m or rad, off a constraint.
inline constexpr double kDoubtfulConstraint = 1e-3;
// A share of a freedom's largest rate in the run: what one step may differ by from two of half its length.
inline constexpr double kDoubtfulStep = 0.1;

// What doubts are about.
std::span<const Name> doubt_names();

struct Doubt {
  std::string kind;    // one of those
  double amount = 0;   // of what the constants above measure, and those of between_samples
  std::string words;   // what, and how much
  std::string remedy;  // what to type instead
};

// Nothing of a run that ended otherwise than it was told to: its status says so.
//
// Energy is blind where little of it is at stake: a small link whose friction is too steep for the step shakes with
// next to none. So a few of the steps are taken again, whole and in two halves. Where the step lies within the
// method's region of stability and resolves the motion both agree, since their difference is of the method's order;
// where it does not, they differ by as much as the motion itself. A tenth of the steps looked at must do so, since
// one of them may hold a jump of the torques.
// `chosen_by`: what `method: auto` chose the method by, none where it was named: what helps depends on it.
std::vector<Doubt> doubts_of(const Simulation& simulation, const Trajectory& trajectory, const Audit& audit,
                             const std::optional<Accuracy>& chosen_by);

// Of its events: of one that turns round at every look, or strays between them, some is missed.
std::optional<Doubt> doubt_of_events(const Simulation& simulation, const Trajectory& trajectory, const std::optional<Accuracy>& chosen_by);

// Of its energy alone, by what the audit saw.
std::optional<Doubt> doubt_of_energy(const Simulation& simulation, const Trajectory& trajectory, const Audit& audit,
                                     const std::optional<Accuracy>& chosen_by);

}  // namespace chainreel
