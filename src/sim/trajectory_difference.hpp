// What differs between two runs of a model, in words: which freedom parts first, when, and how far.
#pragma once

#include <string>
#include <vector>

#include "model/chain.hpp"
#include "sim/system/trajectory.hpp"

namespace chainreel {

// A number of q or qd: what it is called in words, "q2 (elbow)", and its unit: "rad", "m", "rad/s", .., ""
// where it is not known. Four neighbours of unit "quaternion" are one rotation.
struct SampledNumber {
  std::string label, unit;
};

struct SampledEvent {
  std::string name;
  double t = 0;  // s
};

// A run as it is kept: fewer samples than it had.
struct SampledTrajectory {
  std::vector<SampledNumber> q_numbers, qd_numbers;
  std::vector<double> t;             // s, rising
  std::vector<double> q, qd;         // a number each of q_numbers, qd_numbers a sample
  std::vector<SampledEvent> events;  // that happened, in the order of time
  std::string status = "finished";
  double end_time = 0;  // s

  std::size_t size() const { return t.size(); }
};

// Every 2^n-th sample, so that runs of other lengths share instants, at most `most`, and the last one.
// Without events.
SampledTrajectory sampled(const Chain& chain, const Trajectory& trajectory, int most = 200);

// Of numbers that have names alone: NAME.qx NAME.qy NAME.qz NAME.qw, as position_names has them, become one
// rotation.
void join_rotations(std::vector<SampledNumber>& numbers);

struct FreedomDifference {
  std::string label, unit;
  double first_time =
      0;  // s: the first instant that both have at which they are apart by more than the tolerance
  double at_first = 0;      // how far then
  double largest = 0;       // over all instants that both have
  double largest_time = 0;  // s
  double range = 0;         // of the number, over both runs
};

struct TrajectoryDifference {
  // Those that part, the first one first; of several at one instant that which is farthest for its range.
  std::vector<FreedomDifference> freedoms;
  std::vector<FreedomDifference> numbers;  // all that part, rates behind positions
  std::vector<std::string> others;  // in words: events, the end, other freedoms, no instants in common
  int instants = 0;                 // that both have

  bool empty() const { return freedoms.empty() && others.empty(); }
};

inline constexpr double kSameOfRange = 1e-9;
// Apart are numbers that differ by more than `of_range` of their range, and by more than 1e-12. Quaternions are
// compared by the angle between them, in rad. Rates count where no position parts.
TrajectoryDifference difference_of(const SampledTrajectory& before, const SampledTrajectory& after, double of_range = kSameOfRange);

// Whether they part by no more than what other sums of the same motion do: 1e-8 of 1 and of each number's range.
bool is_rounding(const TrajectoryDifference& difference);

// "q2 (elbow) differs by 3.1e-4 rad from t = 0.81 s on (largest 0.02 rad at t = 3.2 s)"; "" where none does.
std::string freedom_words(const TrajectoryDifference& difference);

}  // namespace chainreel
