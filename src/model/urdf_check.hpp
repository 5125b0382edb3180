// The first look at a URDF file, by tinyxml2: urdfdom keeps no line numbers and lets most broken files
// through in silence (a malformed <inertial> gives a valid model of mass 0), so every tag and number that
// counts is checked here.
#pragma once

#include <string>

#include "model/urdf_file.hpp"
#include "model/urdf_problems.hpp"

namespace chainreel {

struct CheckedUrdf {
  UrdfFile file;  // names, lines, joint types, rotations and what was given; parent and child are still -1
  std::string plain;  // the same model for urdfdom: only the tags that it shall read, limits complete
  std::vector<std::string> parent_names, child_names;  // per joint
};

// `text` must have passed check_xml_limits. Throws Error where the text is no URDF at all; what is wrong
// inside it goes to `problems`.
CheckedUrdf check_urdf(const std::string& text, const std::string& path, UrdfProblems& problems);

}  // namespace chainreel
