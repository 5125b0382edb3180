// One state of a run, with all that its equation of motion holds there:
//
//   tau = M qdd + nle + tau_f + Jc^T lambda,   Jc qdd + Jcd_qd = 0
//
// by the system that the run steps, so that numbers of an instant are those of the film.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "dynamics/workspace.hpp"
#include "sim/simulate.hpp"

namespace chainreel {

struct Instant {
  std::vector<double> tau;  // as the run feels it: with what presses on constraints, cut by the limit policy; N m or N
  std::vector<double> qdd;  // nv

  // The names of the constraints' rows; empty where there are none.
  std::vector<std::string> rows;
  std::vector<double> phi;     // m or rad
  Eigen::MatrixXd Jc;          // rows x nv
  std::vector<double> Jcd_qd;  // the rows' accelerations at qdd = 0
  std::vector<double> lambda;  // N or N m; +Jc^T lambda is what the robot exerts on its surroundings
  std::string status;          // "regular", "redundant", ..

  // A constraint each: its name, and the force that the robot exerts at its (first) frame, N along W.
  std::vector<std::string> constraints;
  std::vector<Eigen::Vector3d> forces;
};

// At t in the state q, qd, which lie on the constraints.
Instant instant_of(const Simulation& simulation, double t, ConstVec q, ConstVec qd);

}  // namespace chainreel
