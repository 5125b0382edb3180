// swing MODEL.urdf: simulates a second from rest by dop853 and prints ten instants, with the energy that is to stay.
#include <chainreel/sim.hpp>

#include <cstdio>

int main(int count, char** words) try {
  if (count != 2) return std::fprintf(stderr, "usage: swing MODEL.urdf\n"), 2;
  chainreel::Simulation run;
  run.chain = chainreel::read_chain(words[1], {.friction = false});
  run.q0 = chainreel::zero_configuration(run.chain);
  run.qd0.assign(std::size_t(run.chain.nv), 0.0);
  run.torque = chainreel::make_torque_law(run.chain, std::vector<chainreel::TorqueEntry>(run.qd0.size()), {});  // "0" each
  run.duration = 1;
  chainreel::apply({&chainreel::find_method("dop853"), {.tolerance = 1e-10}, 0}, run);  // {&find_method("rk4"), {}, 0.001}: a fixed step, s

  std::vector<double> times;
  for (int k = 0; k <= 10; ++k) times.push_back(0.1 * k);
  const chainreel::Trajectory motion = chainreel::simulate(run, times);
  chainreel::Workspace ws(run.chain);
  for (int k = 0; k < motion.size(); ++k)
    std::printf("t = %.1f s  q1 = %+.6f  E = %+.9f J\n", motion.t[std::size_t(k)], motion.q_at(k)[0],
                chainreel::energy_of(run.chain, ws, motion.q_at(k), motion.qd_at(k)).total());
} catch (const chainreel::Error& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return int(error.code());
}
