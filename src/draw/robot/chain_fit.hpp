// Which part of the world a clip of a chain shows.
#pragma once

#include <vector>

#include "draw/robot/body_shapes.hpp"
#include "draw/robot/fit.hpp"
#include "draw/robot/skeleton.hpp"

namespace chainreel {

// Gathers the places of a chain for the fit of a camera whose axes are set.
class ChainFit {
 public:
  // `marks`: as in ChainLook. `shapes`: as in ChainDrawing.
  ChainFit(const Chain& chain, const Skeleton& skeleton, const Camera& camera, double marks = 1,
           const BodyShapes* shapes = nullptr);
  // Poses with a place farther than `limit` from the base are passed over (runs that diverged): false.
  bool add_pose(const Workspace& ws, double limit);
  // Further places with room of their own.
  void add(const Eigen::Vector3d& place, const Room& room) { box_.add(room, camera_.flat(place)); }
  const FitBox& box() const { return box_; }

 private:
  void add_base();

  const Chain& chain_;
  const Skeleton& skeleton_;
  const Camera& camera_;
  double marks_;
  const BodyShapes* shapes_;
  FitBox box_;
  Room link_, point_, joint_, tip_, corner_;
  std::vector<Room> rail_;  // one a rail
};

// Whether any of a chain as it stands comes into this part of the page.
bool covers(const Chain& chain, const Skeleton& skeleton, const BodyShapes* shapes, const Workspace& ws,
            const Camera& camera, const Rect& part);

// Lets the box in W hold the chain as it stands, but places farther than `limit` from the origin.
void extend(MotionBox& box, const Chain& chain, const Skeleton& skeleton, const BodyShapes* shapes,
            const Workspace& ws, double limit);
// The same for configurations at which the chain stands in turn.
MotionBox box_around(const Chain& chain, const Skeleton& skeleton, const BodyShapes* shapes, Workspace& ws,
                     const std::vector<std::vector<double>>& configurations);

}  // namespace chainreel
