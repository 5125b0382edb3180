// Which way the camera looks at a chain.
#pragma once

#include <array>
#include <functional>

#include "draw/robot/fit.hpp"
#include "model/chain.hpp"
#include "picture/camera.hpp"
#include "scene/scene.hpp"

namespace chainreel {

// Planar chains: along the normal of their plane, up against gravity (its part in the plane), else +y, else
// +z, and that side of the plane from which x, else the first link, points to the right. Others: from azimuth
// 35 deg (0 sees x to the right) and elevation 20 deg, +z up. Angles of the entry turn either about up and
// about the page's right. Scale 1, origin 0 and parallel rays: fitting comes later.
Camera view_of(const Chain& chain, const CameraEntry& entry = {});

// In space, or with an angle of the camera named, be it zero: bodies may hide one another, and are seen from
// an eye.
bool is_oblique(const Chain& chain, const CameraEntry& entry);
// The rays come from an eye at a finite distance: as the entry says, else wherever the view is oblique.
bool has_eye(const Chain& chain, const CameraEntry& entry);

// Lets the camera look at the middle of `motion` from an eye as far away as the entry says, else so far that
// 30 deg hold a scene of this height (units of H). `fit` sets scale and origin for the camera as it stands;
// it is called several times. Throws Error (bad input) at `place` where the eye would be among the bodies.
void place_eye(Camera& camera, const MotionBox& motion, const CameraEntry& entry, double height,
               const std::function<void(Camera&)>& fit, const Place& place);

// Scale and origin as `fit` of the entry says; false where it says nothing.
bool fit_as_told(Camera& camera, const CameraEntry& entry, const Rect& area);

// What of the world lies in this part of the page, as the entry's `fit` has it.
std::array<double, 4> part_shown(const Camera& camera, const Rect& area);

// A camera by numbers, so that what it looks at cannot move it, m.
struct KeptCamera {
  std::array<double, 4> part{};              // that is shown: left, bottom, right, top
  std::optional<std::array<double, 4>> eye;  // x y z where it looks, and how far away it stands; absent: parallel rays
};
KeptCamera kept_camera(const Camera& camera, const Rect& area);

// The camera of a figure: view_of, with an eye where it has one, and fitted to `area`.
Camera aimed_camera(const Chain& chain, const CameraEntry& entry, const MotionBox& motion, const Rect& area,
                    const std::function<void(Camera&)>& fit);

}  // namespace chainreel
