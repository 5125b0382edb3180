// What ties exert on a robot, as vectors that are named like the curves of their multipliers: f = -Jc^T lambda, since lambda is
// what the robot presses on them with.
#pragma once

#include <map>
#include <set>
#include <vector>

#include "draw/layers/vectors.hpp"
#include "draw/page/stage.hpp"
#include "sim/torques_along.hpp"

namespace chainreel {

// The reactions of a run at its samples; what acts at one place is one force, but where constraints of a row each act along one
// direction all along: there each is a share of its own, beside the others, so that it is seen who bears what.
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
    bool of_single_rows = true;  // each of the constraints that hold it has one
    std::vector<double> extremes{};  // at each sample, of their sum or of the vector's length
    std::map<int, std::vector<double>> share_extremes{};  // of each row
    bool is_line = true;      // all along one line, one way or the other: with single rows
    int first_row = -1;       // that ever bears anything
    std::set<int> turned{};   // rows whose multipliers press the other way than its one

    bool has_shares(const Reaction& one) const { return one.rows.size() > 1 && of_single_rows && is_line; }
  };
  std::vector<double> extremes_of(const std::vector<int>& rows, bool as_length) const;
  void look_at_directions(int frame, int k, double close, Place& place) const;
  void find_extremes(const Reaction& one);
  WorldVector vector_of(const Reaction& one, const Workspace& ws, int k) const;
  void add_shares(const Reaction& one, const Workspace& ws, int k, std::vector<WorldVector>& vectors) const;

  const StagedRun* motion_;
  std::vector<std::vector<Reaction>> each_;  // of the constraints, one by one
  std::vector<std::vector<Reaction>> at_;    // of the places
  std::map<int, Place> places_;
};

}  // namespace chainreel
