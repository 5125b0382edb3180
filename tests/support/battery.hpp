// Random scenes whose torques have corners: pushes down to milliseconds, jumps, ramps, abs, min, max, waves
// that are cut off, feedback and dry friction. The same for a seed on every machine.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace chainreel::test {

struct CorneredScene {
  std::string model;  // in models/, with as many freedoms as there are torques
  std::vector<double> q0, qd0;
  std::vector<std::string> torque;
  double duration = 2;  // s

  std::string text() const;  // of one line, for messages
};

CorneredScene cornered_scene(std::uint64_t seed);

}  // namespace chainreel::test
