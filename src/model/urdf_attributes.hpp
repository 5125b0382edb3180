// Attributes that nothing reads: `xzy` where `xyz` was meant would leave a link at its parent's origin in silence.
#pragma once

#include <tinyxml2.h>

#include "model/urdf_problems.hpp"

namespace chainreel {

// A remark for each attribute of a tag that is read which is none of its own. Below tags that are not read nothing is
// looked at.
void examine_attributes(const tinyxml2::XMLElement& robot, UrdfProblems& problems);

}  // namespace chainreel
