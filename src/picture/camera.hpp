// World to page. Orthographic: a point's page position is its components along `right` and `up`, scaled and
// shifted.
#pragma once

#include <Eigen/Core>

#include "picture/picture.hpp"

namespace chainreel {

struct Camera {
  Eigen::Vector3d right = Eigen::Vector3d::UnitX();
  Eigen::Vector3d up = Eigen::Vector3d::UnitY();
  Eigen::Vector3d toward_viewer = Eigen::Vector3d::UnitZ();  // right x up
  double scale = 1;                                          // units of H per metre
  Point origin;                                              // page position of the world's origin

  Point project(const Eigen::Vector3d& x) const {
    return {origin.x + scale * right.dot(x), origin.y + scale * up.dot(x)};
  }
  Point project_vector(const Eigen::Vector3d& v) const { return {scale * right.dot(v), scale * up.dot(v)}; }
  double depth(const Eigen::Vector3d& x) const { return toward_viewer.dot(x); }
};

// Sets scale and origin so that the page-plane box (in metres along right and up) fills `area` with `margin`
// (a fraction of the box's sides) around it. A box without extent gets one metre.
void fit(Camera& camera, const Rect& box_m, const Rect& area, double margin);

}  // namespace chainreel
