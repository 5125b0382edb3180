// The named states of an SRDF file, the companion of a URDF: `<group_state name="home" group="arm">` gives
// values to joints. All else that such a file says (groups, end effectors, pairs that may touch) is for
// planners and not read.
#pragma once

#include <string>
#include <vector>

#include "core/error.hpp"

namespace chainreel {

struct SrdfValue {
  std::string joint;
  std::vector<double> values;  // rad or m; several of joints with several freedoms
  int line = 0;
};

struct SrdfState {
  std::string name;
  std::string group;  // "" where it has none
  std::vector<SrdfValue> joints;
  int line = 0;
};

struct SrdfFile {
  std::string path;
  std::string robot;
  std::vector<SrdfState> states;  // in document order
};

// Throws Error with every problem of the file (exit 3; exit 7 beyond a limit of model/xml_text). Whether a
// model has these joints is not looked at.
SrdfFile read_srdf(const std::string& path);

}  // namespace chainreel
