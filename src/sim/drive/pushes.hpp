// What pushes a robot from outside, each for a while: forces in the world on frames of the chain. They act beside the joints'
// torques and are none: no effort limits them, and no foot bears them as it bears what its ankle does.
#pragma once

#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "core/error.hpp"
#include "dynamics/equation_of_motion.hpp"
#include "dynamics/workspace.hpp"
#include "sim/drive/torque.hpp"

namespace chainreel {

// As the scene wrote it.
struct PushEntry {
  std::string frame;           // a link or joint; "": the end effector
  std::vector<double> force;   // N, in W: x y z, or two along the axes of the plane in which the chain moves
  std::vector<std::string> words{};  // one a number: the expression of the scene's parameters that gives it; "" of a plain one
  double from = 0;             // s
  double until = std::numeric_limits<double>::infinity();
  Place place;
};

struct ActingPush {
  int frame = 0;  // index into Chain::frames
  Eigen::Vector3d force = Eigen::Vector3d::Zero();  // N, in W
  double from = 0, until = 0;                       // s: at `from` it acts, at `until` no more

  bool acts_at(double t) const { return from <= t && t < until; }
};

// tau += J^T F of a force in W at the origin of a frame, where `ws` holds the chain.
void add_force(const Chain& chain, const Workspace& ws, int frame, const Eigen::Vector3d& force, Vec tau);

class Pushes {
 public:
  explicit Pushes(std::vector<ActingPush> list);

  const std::vector<ActingPush>& list() const { return list_; }
  // tau += J^T F of those that act at t; nv numbers. Writes kinematics into ws, allocates nothing.
  void add_to(const Chain& chain, Workspace& ws, double t, ConstVec q, ConstVec qd, Vec tau) const;
  // All that act at t, about the world's origin. Writes kinematics into ws.
  Wrench wrench(const Chain& chain, Workspace& ws, double t, ConstVec q, ConstVec qd) const;

  // As of a TorqueLaw.
  std::vector<double> breaks(double end) const;
  void enter_piece(double t);
  void leave_pieces() { in_piece_ = false; }

 private:
  bool acts(std::size_t i, double t) const;

  std::vector<ActingPush> list_;
  std::vector<bool> acts_in_piece_;
  bool in_piece_ = false;
};

// The law, with pushes beside what it evaluates: see TorqueLaw::pushes.
std::unique_ptr<TorqueLaw> make_pushed_law(std::unique_ptr<TorqueLaw> law, std::vector<ActingPush> pushes);

}  // namespace chainreel
