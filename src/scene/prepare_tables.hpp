// What the tables that drive a scene say of its start and of its duration.
#pragma once

#include "model/chain.hpp"
#include "scene/scene.hpp"

namespace chainreel {

// Where torques are those of a motion, that motion's own start is the scene's, unless `start:` names another one. Where
// a table begins later than the run or ends before it, what it is taken for there is refused, or said in scene.notices
// unless `outside:` has said it. Throws Error.
void prepare_tables(Scene& scene, const Chain& chain);

}  // namespace chainreel
