// The points of a chain by which a viewer tells one run from another.
#pragma once

#include <string>
#include <vector>

#include "dynamics/workspace.hpp"
#include "sim/simulate.hpp"

namespace chainreel {

// Of every moving body: its joint, its centre of mass, and corners around what can be seen of it. The displacement of a
// rigid body is largest at a corner of any hull around it, so that nothing within moves further. A body without an
// outline counts as the uniform box of its mass and inertia; one that has none of either shows its joint alone. Besides
// the ends of links and the end effector.
class SeenPoints {
 public:
  explicit SeenPoints(const Simulation& simulation);

  // After compute_kinematics: in W, m; the first bars() of them are those of the bars as which chains are drawn.
  void read(const Workspace& ws, std::vector<Eigen::Vector3d>& places) const;
  std::size_t bars() const { return bars_; }

 private:
  struct Point {
    int body;
    Eigen::Vector3d place;  // in the body's frame
  };

  std::vector<Point> points_;
  std::size_t bars_ = 0;
};

// The freedoms that move no point at any of some states of a run: nothing can be said of their errors, nor seen.
std::vector<std::string> unseen_freedoms(const Simulation& simulation, const Trajectory& run);

}  // namespace chainreel
