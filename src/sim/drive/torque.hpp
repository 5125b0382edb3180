// Torque laws: what acts at the joints at each instant, N m for revolute and N for prismatic joints.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "core/error.hpp"
#include "dynamics/kernels/taylor_planar.hpp"
#include "expr/expression.hpp"
#include "sim/drive/control.hpp"
#include "sim/drive/linear_drive.hpp"
#include "sim/drive/probe.hpp"

namespace chainreel {

class Pushes;
class StateCorners;

// Where feedback in the space of the task pulls a frame to.
struct TaskTarget {
  int frame = 0;          // index into Chain::frames
  Eigen::Vector3d place;  // in W, along the axes that have one
  struct Pull {
    Eigen::Vector3d axis;  // of length 1, in W
    double kp = 0;         // N/m
  };
  std::vector<Pull> pulls;  // one an axis

  // Where the springs would have a frame that is at `p`: at its own place along axes without one.
  Eigen::Vector3d wished(const Eigen::Vector3d& p) const;
  // Whether they pull like one spring between both, the same along all axes.
  bool is_one_spring() const;
};

class TorqueLaw {
 public:
  virtual ~TorqueLaw() = default;
  // Writes nv numbers for the chain that the law was made for. Allocates nothing; a value that cannot be had
  // is written as NaN, which stops the run.
  virtual void evaluate(const Chain& chain, Workspace& ws, double t, ConstVec q, ConstVec qd, Vec tau) = 0;
  // What that costs, ns, see sim/drive/prices. No default: a law without it does not compile.
  virtual double price(const Chain& chain) const = 0;
  virtual bool is_constant() const { return false; }  // then the work done is tau . (q - q(0)) exactly
  // Whether the joints' torques are, whatever pushes besides.
  virtual bool drives_are_constant() const { return is_constant(); }
  virtual bool depends_on_velocity() const { return !is_constant(); }
  // Instants up to `end` at which the torque has a kink or a jump, in any order: steps end there, so that
  // methods keep their order. Throws Error (limit) where there are too many.
  virtual std::vector<double> breaks(double) const { return {}; }
  // From here on all evaluations are for steps between two breaks, around t: at the breaks themselves the law
  // goes on as it is between them. `leave_pieces` ends that.
  virtual void enter_piece(double) {}
  virtual void leave_pieces() {}
  // What the torque bends or jumps at where that depends on the state; null: nothing.
  virtual StateCorners* corners() { return nullptr; }
  // The law as polynomials in t plus multiples of q and qd, where it is one.
  virtual std::optional<AffineTorque> affine() const { return {}; }
  // The springs and dampers that the law is, or has; at most one a freedom.
  virtual std::vector<LinearDrive> linear_drives(const Chain&) const { return {}; }
  // What acts from outside beside these torques; null: nothing. A law that has some is not constant, and no polynomial.
  virtual const Pushes* pushes() const { return nullptr; }
  // The coordinates of the reference motion that feedback follows, nv numbers; false where there is none.
  virtual bool reference_at(double, Vec) { return false; }
  // Whether feedback has this freedom follow that: by gains, or by a model.
  virtual bool follows(std::size_t) const { return false; }
  virtual std::optional<TaskTarget> task_at(double) { return {}; }
  // The law with the digits of Quad; false where it has none.
  virtual bool evaluate_in_quad(Quad, std::span<const Quad>, std::span<const Quad>, std::span<Quad>) const {
    return false;
  }
};

// Of one freedom, what both have of it together.
void add_row(AffineTorque& sum, const AffineTorque& other, std::size_t freedom);

// One joint's entry as the scene wrote it: a number, an expression, or a control of this joint alone.
struct TorqueEntry {
  std::string text = "0";
  Place place;
  std::optional<Control> control;  // then `text` says nothing
};

// One entry per degree of freedom. Throws Error with every problem of the entries.
std::unique_ptr<TorqueLaw> make_torque_law(const Chain& chain, const std::vector<TorqueEntry>& entries,
                                           const Parameters& parameters, const NamedFrames& frames = {});

// Torques that are expressions of time, state, end effector and parameters.

// One entry a freedom, parsed with the probe's names.
std::unique_ptr<TorqueLaw> make_expression_torque(Probe probe, std::vector<Expression> entries);

}  // namespace chainreel
