// A pose at which constraints that were independent depend on each other: the change point of a closed loop, a pen's arm that is stretched out. Ways
// cross there, or end; which of them goes on is not said by the equations, and lambda is none of theirs.
#pragma once

#include <limits>
#include <optional>
#include <vector>

#include "sim/doubts.hpp"
#include "sim/simulate.hpp"

namespace chainreel {

// Of RankLoss::part. About the distance from such a pose in rad: lengths that miss it by a millionth of themselves do not reach it.
inline constexpr double kDependentRows = 1e-3;

struct RankLoss {
  double t = 0;       // s
  double part = 1;    // how independent the rows are there, of how much they are at most in this run
};

// Of G = Jc M^-1 Jc^T, its rows each divided by the largest size it has in the run: the root of the smallest of those eigenvalues that are not zero
// throughout, which is linear in the distance from such a pose. Between samples it is sought on the cubic through both.
// The poses with a part below kDependentRows in the order of time, one each time that the run passes there.
std::vector<RankLoss> rank_losses_of(const Simulation& simulation, const Trajectory& trajectory);

// Of poses until then, s. Its remedy is typed as it stands, but where the run starts there.
std::optional<Doubt> doubt_of_rank(const Simulation& simulation, const Trajectory& trajectory, double until = std::numeric_limits<double>::infinity());

}  // namespace chainreel
