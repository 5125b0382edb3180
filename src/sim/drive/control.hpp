// What may drive the joints besides numbers and expressions; the parts that are given add up.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/csv.hpp"
#include "core/names.hpp"
#include "sim/drive/probe.hpp"
#include "sim/drive/reference.hpp"
#include "sim/drive/task_torque.hpp"
#include "sim/drive/torque_function.hpp"

namespace chainreel {

class TorqueLaw;

// What a table stands for at instants before its first row and behind its last one.
enum class Outside {
  hold,    // the row at that end: its torque, or its pose at rest
  zero,    // no torque of its
  refuse,  // nothing: the run must not be longer
};
std::span<const Name> names_of(Outside);

// Feedback to a reference motion, given by expressions in t or by a CSV.
struct Feedback {
  std::vector<double> kp, kd;  // one a freedom, or one for all
  std::vector<Entry> q, qd, qdd;
  std::string trajectory;  // path of a CSV instead of q, qd, qdd; "": none
  std::optional<Outside> outside{};  // of the CSV; absent: held, and said
  std::vector<std::string> lists_of_one{};  // keys of it whose number stands in brackets, which is none for all
};

struct Control {
  std::string csv;                          // t,tau1..: linear between the rows
  ColumnNames columns{};                    // of the csv, where its maker has names of his own
  bool since_first_row = false;             // the csv's clock is another one: t = 0 is its first row
  std::string inverse_of;                   // t,q1..: the torques that this motion takes
  std::optional<Outside> outside{};         // of these two tables; absent: held, and said
  std::optional<Feedback> pd;               // kp (q_ref - q) + kd (qd_ref - qd)
  std::optional<Feedback> computed_torque;  // M (qdd_ref + kd (qd_ref - qd) + kp (q_ref - q)) + nle + tau_f
  std::optional<TaskFeedback> task{};       // J^T (kp (x_ref - x) + kd (xd_ref - xd)); of the whole chain alone
  bool gravity_compensation = false;        // tau_g(q)
  std::vector<Entry> plus{};                // expressions that are added: one a freedom, or one for all; of a joint one
  bool plus_is_list_of_one = false;         // it stands in brackets, and is none for all
  std::optional<OwnTorque> function{};      // of the calling program, which no file can hold
  Place place;
};

// The law for the whole chain, or as the entry of one joint, which does not hold its `plus`: make_torque_law adds that. Computed torque of one joint that says nothing of the others
// asks for no acceleration of theirs. Throws Error with what does not fit.
std::unique_ptr<TorqueLaw> make_control(const Chain& chain, const Control& control, const Parameters& parameters,
                                        std::optional<std::size_t> joint = {}, const NamedFrames& frames = {});

}  // namespace chainreel
