// What one camera must hold for a whole clip: on the page, places in metres, each with the room that what is drawn
// there needs; in the world, the box in which the motion takes place.
#pragma once

#include <array>
#include <compare>
#include <map>

#include "model/chain.hpp"
#include "picture/camera.hpp"

namespace chainreel {

// Half sizes of what is drawn around a place: those on the page, or `metres` x scale + `beyond` where that is
// less.
struct Room {
  double left = 0, right = 0, down = 0, up = 0;  // units of H
  double metres = -1;                            // negative: no such bound
  double beyond = 0;                             // units of H
  bool in_margin = false;                        // it may stand in the margin around all the rest

  auto operator<=>(const Room&) const = default;
};

inline Room room_around(double radius) {
  return {radius, radius, radius, radius};
}

// Grows over all frames of a clip; places that need the same room share one box, so that its size never depends on
// the clip's length.
class FitBox {
 public:
  // `place_m`: along the camera's right and up, m. Places that are not finite are passed over.
  void add(const Room& room, Point place_m);
  void add(const FitBox& other);  // everything that it holds

  bool empty() const { return places_.empty(); }
  // The whole in metres when one metre measures `scale`, with that margin, a fraction of its sides, around it.
  Rect box(double scale, double margin = 0) const;

 private:
  std::map<Room, Rect> places_;
};

// Scale and origin of the camera such that everything, margins included, just fills `area`; where what may stand in the margin
// needs more, that.
void fit_to(Camera& camera, const FitBox& box, const Rect& area, double margin);
// The same; what is wished for is held, too, where that takes at most a share 1 - kKeptForWishes of the scale. Else
// that is what it has, and the rest is cut at opposite edges alike, as far as the box leaves room to move.
inline constexpr double kKeptForWishes = 0.85;
void fit_to(Camera& camera, const FitBox& box, const FitBox& wishes, const Rect& area, double margin);

// Against gravity; +z where there is none.
Eigen::Vector3d up_of(const Chain& chain);

// A box around places in W that stands upright.
class MotionBox {
 public:
  explicit MotionBox(const Eigen::Vector3d& up);

  void add(const Eigen::Vector3d& place) { box_.extend(upright_ * place); }
  void add(const MotionBox& other) { box_.extend(other.box_); }  // of the same up

  bool empty() const { return box_.isEmpty(); }
  const Eigen::Vector3d& up() const { return up_; }
  Eigen::Vector3d middle() const { return upright_.transpose() * box_.center(); }
  std::array<Eigen::Vector3d, 8> corners() const;
  double lowest() const { return box_.min().z(); }  // m above the plane through the world's origin
  double size() const { return box_.diagonal().norm(); }
  double width() const { return box_.diagonal().head<2>().norm(); }  // its diagonal on the ground

 private:
  Eigen::Vector3d up_;
  Eigen::Matrix3d upright_;  // rows: two directions on the ground, and up
  Eigen::AlignedBox3d box_;
};

}  // namespace chainreel
