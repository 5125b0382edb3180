// World to page. Parallel rays: a point's page position is its components along `right` and `up`, scaled and
// shifted. With an eye at a finite distance they grow towards it; the page then is a plane across `nearing`, so that lines across
// that stay parallel: where it is horizontal, what stands upright is drawn upright (two-point perspective).
#pragma once

#include <Eigen/Core>

#include "picture/picture.hpp"

namespace chainreel {

struct Camera {
  Eigen::Vector3d right = Eigen::Vector3d::UnitX();
  Eigen::Vector3d up = Eigen::Vector3d::UnitY();
  Eigen::Vector3d toward_viewer = Eigen::Vector3d::UnitZ();  // right x up
  Eigen::Vector3d focus = Eigen::Vector3d::Zero();           // the point looked at, m
  Eigen::Vector3d nearing = Eigen::Vector3d::Zero();  // 1/m: at focus + r all is 1 / (1 - nearing . r) times as large; 0: parallel rays
  double scale = 1;                                          // units of H per metre at `focus`
  Point origin;                                              // page position of `focus`

  bool has_eye() const { return nearing != Eigen::Vector3d::Zero(); }
  // How far the eye stands from `focus`, along toward_viewer, m.
  double distance() const { return 1 / nearing.dot(toward_viewer); }

  // Where the ray to a point meets the plane through `focus`, m along right and up; no numbers for points
  // beside or behind the eye.
  Point flat(const Eigen::Vector3d& x) const;
  // The same of a small vector at `x`: the derivative of flat().
  Point flat_vector(const Eigen::Vector3d& v, const Eigen::Vector3d& x) const;

  Point project(const Eigen::Vector3d& x) const { return origin + scale * flat(x); }
  Point project_vector(const Eigen::Vector3d& v, const Eigen::Vector3d& x) const {
    return scale * flat_vector(v, x);
  }
  // Parallel rays along the one to `x`: what is drawn there in a size of its own points as small vectors do
  // that end there.
  Camera seen_at(const Eigen::Vector3d& x) const;
  double depth(const Eigen::Vector3d& x) const { return toward_viewer.dot(x); }
};

// Sets scale and origin so that the box (in metres as of Camera::flat) fills `area` with `margin`
// (a fraction of the box's sides) around it. A box without extent gets one metre.
void fit(Camera& camera, const Rect& box_m, const Rect& area, double margin);

}  // namespace chainreel
