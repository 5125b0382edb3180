// Feedback in the space of the task: a spring and a damper pull a frame of the chain to a place that moves.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/error.hpp"
#include "model/chain.hpp"
#include "sim/drive/probe.hpp"
#include "sim/drive/reference.hpp"

namespace chainreel {

class TorqueLaw;

// As the scene wrote it.
struct TaskFeedback {
  std::string frame;                      // a link, or a name of `frames`; "": the end effector
  std::vector<double> kp{0}, kd{0};       // N/m, N s/m: one for all axes, or one an axis
  std::vector<Entry> x, xd;               // expressions in t, m and m/s, in W, or along the axes of the plane in which the chain moves
  std::vector<std::string> lists_of_one;  // keys whose number stands in brackets, which is none for all
  Place place;
};

// tau = J^T (kp (x_ref - x) + kd (xd_ref - xd)). Throws Error (bad input) with what does not fit the chain.
std::unique_ptr<TorqueLaw> make_task_torque(const Chain& chain, const TaskFeedback& task, const Parameters& parameters,
                                            const NamedFrames& frames = {});

}  // namespace chainreel
