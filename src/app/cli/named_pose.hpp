// Poses that an SRDF beside a model names: `<group_state name="ready">`.
#pragma once

#include <string>

#include "model/chain.hpp"

namespace chainreel {

// "ready" as "joint1=0.1,joint2=0", by the .srdf files of this robot in the folder of `model` (a path of a URDF) and in srdf
// beside that folder; any other text stays as it is. Throws Error (usage, naming `what`) for a name that none of these files
// has, where there are such files, and for a state that gives numbers to joints that the chain has not.
std::string named_pose_text(const Chain& chain, const std::string& model, const std::string& text, const std::string& what);

}  // namespace chainreel
