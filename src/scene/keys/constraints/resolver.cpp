// Numbers and frames of an entry in the chain of its scene.
#include "dynamics/kinematics.hpp"
#include "scene/keys/constraints/kind.hpp"

namespace chainreel {

Eigen::Vector3d ConstraintResolver::world(const std::vector<double>& numbers, const std::string& what) {
  if (numbers.size() == 3) return {numbers[0], numbers[1], numbers[2]};
  if (numbers.size() == 2 && chain_.planar)
    return chain_.planar->plane.ex * numbers[0] + chain_.planar->plane.ey * numbers[1];
  problems_.add(what + " has " + std::to_string(numbers.size()) + " numbers, but " +
                    (chain_.planar ? "two are needed, along the plane of motion, or three: world x y z"
                                   : "this chain moves in space: three are needed, world x y z"),
                place_);
  return Eigen::Vector3d::UnitX();
}

bool ConstraintResolver::ends_at_place(const std::string& b) const {
  return b.empty() || (b == "world" && find_frame(chain_, "world") < 0);
}

Eigen::Vector3d ConstraintResolver::place_of(const std::string& b, const std::vector<double>& at,
                                             const std::string& what) {
  return b == "world" ? Eigen::Vector3d::Zero().eval() : world(at, what);
}

}  // namespace chainreel
