// Where a motion takes place.
#pragma once

#include <array>

#include "model/chain.hpp"

namespace chainreel {

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
