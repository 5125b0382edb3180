// Prints the SHA-256 of some trajectories, a line each: the same on every machine, or the program is at
// fault. trajectory_hashes STEP runs them with that step, in seconds.
//
// RRR under torque and the arm are chaotic: a last bit that differs anywhere grows by a factor of 1e7 and
// more within the run. Together the runs read files with angles (rpy), take both algebras and every way to
// forward dynamics, all methods and all functions that torques may use.
#include <algorithm>
#include <cstdio>
#include <exception>
#include <span>
#include <string>
#include <vector>

#include "core/error.hpp"
#include "core/format.hpp"
#include "core/hash.hpp"
#include "dynamics/kinematics.hpp"
#include "model/read_chain.hpp"
#include "sim/audit.hpp"
#include "sim/batch.hpp"
#include "sim/simulate.hpp"

namespace chainreel {
namespace {

// The last joint of a chain follows the one before it.
Chain with_last_joint_coupled(Chain chain) {
  Joint& last = chain.bodies.back().joint;
  --last.q_index;
  --last.v_index;
  last.ratio = 0.5;
  last.offset = 0.1;
  --chain.nq;
  --chain.nv;
  chain.coordinate_names.pop_back();
  chain.has_mimic = true;
  return chain;
}

struct Case {
  std::string name;
  Chain chain;
  std::vector<std::string> torque;  // filled up with the last entry
  double duration = 1;              // s
};

std::vector<Case> cases() {
  const Chain arm = read_chain("tests/bench/models/arm7.urdf");
  ModelOptions floating;
  floating.floating_base = true;
  return {
      {"rr", read_chain("models/rr.urdf"), {"1"}, 5},
      {"rrr", read_chain("models/rrr.urdf"), {"10"}, 3},
      {"pp", read_chain("models/pp.urdf"), {"0", "-100 * y_G"}, 2},
      {"rr_functions",
       read_chain("models/rr.urdf"),
       {"sin(3*t) + exp(-q1^2) - 0.3*tan(0.2*q2) + log(2 + qd1^2)^0.3",
        "cos(q1*t) + atan2(qd1, 1 + q2^2) + min(xd_G, sqrt(1 + abs(y_G)))"},
       1},
      {"arm7", arm, {"0"}, 1},
      {"arm7_coupled", with_last_joint_coupled(arm), {"0"}, 1},
      {"arm7_floating", read_chain("tests/bench/models/arm7.urdf", floating), {"sin(5*t)"}, 0.25},
  };
}

// Adaptive methods take a tolerance and a longest step (of a whole run of 1000 steps) that follow the step; implicit ones, slow on
// an emulated processor, a part of the duration. Empty where the method does not take the chain.
std::string hash_of(const Case& c, const Method& method, double step) {
  Simulation run;
  run.q0 = zero_configuration(c.chain);
  run.qd0.assign(std::size_t(c.chain.nv), 0.1);
  std::vector<TorqueEntry> entries(std::size_t(c.chain.nv));
  for (std::size_t i = 0; i < entries.size(); ++i)
    entries[i].text = c.torque[std::min(i, c.torque.size() - 1)];
  run.torque = make_torque_law(c.chain, entries, {});
  run.chain = c.chain;
  run.method = &method;
  run.step = method.adaptive ? 0 : step;
  if (method.adaptive) run.options.tolerance = 1e-6 * step, run.whole_duration = 1000 * step;
  run.duration =
      method.form == Form::second_order && !method.plain_coordinates ? c.duration : 0.1 * c.duration;
  try {
    check_method(run);
  } catch (const Error&) {
    return {};
  }
  const Trajectory trajectory = simulate_every_step(run);
  return audit_of(run, trajectory).sha256 + " " + to_string(trajectory.status);
}

// Of instances that differ in state, torque and step, stepped together by two threads. Chains that are stepped one by one
// show with few what single runs show already.
std::string hash_of_batch(const Chain& chain, double step) {
  const bool in_lanes = bool(chain.planar) && !chain.has_mimic;
  const int instances = in_lanes ? 37 : 3;  // no multiple of any width
  const auto nv = std::size_t(chain.nv);
  std::vector<double> q = zero_configuration(chain), qd(nv);
  BatchSimulator batch(chain, instances);
  for (int i = 0; i < instances; ++i) {
    batch.set_state(i, q, std::vector<double>(nv, 0.3 - 0.01 * i));
    advance(chain, q, std::vector<double>(nv, 1.0), 0.05);
    batch.set_torque(i, std::vector<double>(nv, 0.2 * i));
    batch.set_step(i, step * (1 + 0.01 * i));
  }
  batch.run(in_lanes ? 500 : 50, 2);
  Sha256 sha;
  for (int i = 0; i < instances; ++i) {
    batch.read_state(i, q, qd);
    sha.add(std::span<const double>(q));
    sha.add(std::span<const double>(qd));
  }
  return sha.finish();
}

void print_hashes(double step) {
  for (const Case& c : cases()) {
    for (const Method& method : methods()) {
      const std::string hash = hash_of(c, method, step);
      if (!hash.empty()) std::printf("%s %s %s\n", c.name.c_str(), method.name.c_str(), hash.c_str());
    }
    std::printf("%s batch %s\n", c.name.c_str(), hash_of_batch(c.chain, step / 4).c_str());
  }
}

}  // namespace
}  // namespace chainreel

int main(int argc, char** argv) {
  try {
    const std::optional<double> step = argc > 1 ? chainreel::parse_number(argv[1]) : 0.004;
    if (!step) return 2;
    chainreel::print_hashes(*step);
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
