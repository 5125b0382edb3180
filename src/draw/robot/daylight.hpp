// How open to the sky the bodies of a robot are, which the renderer takes from their light: crannies, and where links meet, are
// darker.
#pragma once

#include "draw/robot/body_shapes.hpp"

namespace chainreel {

// Sets the openness of all shapes, of which those with few triangles get finer ones. A body is in the shade of its own shapes and
// of those of the bodies that its joints lead to, bodies without shapes skipped, at poses over the joints' ranges: what does not
// change with the pose of the robot is reckoned once and costs next to nothing a frame. So a folded arm does not darken itself.
void put_in_daylight(BodyShapes& shapes, const Chain& chain);

}  // namespace chainreel
