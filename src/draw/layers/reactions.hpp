// What ties exert on a robot, as vectors that are named like the curves of their multipliers: f = -Jc^T lambda, since lambda is
// what the robot presses on them with.
#pragma once

#include <map>
#include <vector>

#include "draw/layers/vectors.hpp"
#include "draw/page/stage.hpp"
#include "sim/torques_along.hpp"

namespace chainreel {

// The reactions of a run at its samples; what acts at one place is one force.
class ReactionRun {
 public:
  explicit ReactionRun(const StagedRun& motion);

  // After compute_kinematics at sample k.
  std::vector<WorldVector> vectors_at(const Workspace& ws, int k) const;

 private:
  // What is true of the force at a frame in all of the clip.
  struct Place {
    bool is_pushed = true;  // one row alone pushes it towards its link
    bool is_sum = true;     // of multipliers, all along one direction: two equal lines
    bool is_vector = true;  // whose components they are: a pin
    std::vector<double> extremes{};  // at each sample, of their sum or of the vector's length
  };
  void find_extremes(int frame, const std::vector<int>& rows);
  WorldVector vector_of(const Reaction& one, const Workspace& ws, int k) const;

  const StagedRun* motion_;
  std::vector<std::vector<Reaction>> at_;
  std::map<int, Place> places_;
};

}  // namespace chainreel
