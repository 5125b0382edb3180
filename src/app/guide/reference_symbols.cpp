// What the letters mean, and which sign has what.
#include "app/guide/reference.hpp"

namespace chainreel {

std::string symbols_page() {
  const std::vector<std::vector<std::string>> letters{
      {"symbol", "unit", "what it is"},
      {"`q qd qdd`", "rad or m, per s, per s^2", "joint positions, rates, accelerations; of a floating base x y z and the quaternion x y z w, and the twist in its own axes"},
      {"`M(q)`", "kg m^2, kg m, kg", "the mass matrix; a `payload` is part of it"},
      {"`nle(q, qd)`", "N m or N", "C qd + tau_g: Coriolis, centrifugal and gravity"},
      {"`tau_g(q)`", "N m or N", "what holds the robot against gravity: positive where gravity pulls the joint backwards"},
      {"`tau_f(qd)`", "N m or N", "damping and friction of the joints, which resist: positive for qd > 0"},
      {"`h(q, qd)`", "N m or N", "nle + tau_f: the h of the lecture"},
      {"`tau`", "N m or N", "what drives the joints: torques of the scene, its controls and its contact_force, as `limit: clamp` leaves them"},
      {"`tau_push`", "N m or N", "J^T F of what `push:` exerts from outside"},
      {"`J_c`, `phi`", "", "Jacobian of the constraints' rows, and how far they are missed: phi = 0, J_c qd = 0"},
      {"`lambda`", "N or N m", "a multiplier a row: what the robot presses on its ties with"},
      {"`J`, `Jd_qd`", "", "Jacobian of the end effector (in the plane of the chain, or world x y z); its acceleration at qdd = 0"},
      {"`Lambda_inv`", "1/kg", "J M^-1 J^T, finite at every pose; under constraints of what they leave free"},
      {"`Lambda`", "kg", "its inverse, J^-T M J^-1 where J is square: the effective mass. Null where a direction is singular"},
      {"`E`", "J", "kinetic + potential, and in tables and plots that of springs (torques that are texts linear in their joint's own coordinate and rate; none of `pd`); potential energy is zero at the world's origin"},
  };
  const std::vector<std::vector<std::string>> rows{
      {"constraint", "its rows", "lambda > 0: the robot presses .."},
      {"`line`", "the normal to the left of `direction`; in space two normals", "along that normal"},
      {"`plane`", "`normal`", "along it"},
      {"`point`", "world x, y (z)", "towards +x, +y (+z)"},
      {"`distance`", "along the rod", "its ends apart: the rod is in tension"},
      {"`close`", "world x, y (z)", "`a` presses on `b`, or on the place, towards +x, +y (+z)"},
      {"`close` with `axis` or `weld`", "besides, axes that stay parallel", "a moment about u x z, u an axis of `b` and z one of `a`, which are at right angles; the sign is told by a run"},
      {"`curve`", "the normal to the left of rising s", "along that normal"},
      {"`joint`", "the coordinate", "towards larger values"},
      {"`linear`", "the sum", "towards a larger sum"},
  };
  return "# Symbols and signs\n\n"
         "    M qdd + h + J_c^T lambda = tau + tau_push,   h = nle + tau_f = C qd + tau_g + tau_f\n\n" +
         markdown_table(letters) +
         "\nA revolute joint is positive by the right hand about its axis, counter-clockwise in pictures whose axis points at the viewer; a slider\n"
         "along its axis. Worlds of planar scenes: x right, y up, z to the viewer. SI units and radians throughout; degrees are for scene files and labels.\n\n"
         "## Signs of lambda\n\n"
         "`dynamics SCENE --at 1.5` prints `lambda` and, of constraints on places, `contact_forces`, the same force as a vector: what the robot exerts on its tie. Arrows of the\n"
         "layer `constraint_force` act on the robot, and point the other way.\n\n" +
         markdown_table(rows) +
         "\nHow far constraints are missed in a run is told by `simulate --json` as constraint_error, by the columns `constraint_error` of a table, and by `plot:\n"
         "constraint_error`; `stabilize` says what holds it down.\n";
}

}  // namespace chainreel
