// Poses of planar chains that bring the end effector to a point.
#pragma once

#include <optional>
#include <vector>

#include "dynamics/workspace.hpp"

namespace chainreel {

// On which side of the way from the base to the end effector the joints between lie, as seen from the side to which
// the plane's normal points: `up` on the left, where they turn clockwise.
enum class Elbow { up, down };

// How near the end effector comes to the point, m.
inline constexpr double kReached = 1e-10;

// For planar chains of two or three one-freedom joints, whose prismatic ones have limits. Two revolute joints are solved
// in closed form (K. Lynch, F. Park, Modern Robotics, ch. 6.1); of three the joints behind the first one bend alike,
// as little as need be, and points that such poses do not reach have none; two of which one slides are found by damped least squares from several starts (ch. 6.2).
class PointSolver {
 public:
  // Throws Error (usage) for any other chain.
  PointSolver(const Chain& chain, Elbow elbow);

  // The middle of the workspace and the radius about it that no pose passes, m.
  const Eigen::Vector3d& middle() const { return middle_; }
  double reach() const { return reach_; }
  const Eigen::Vector3d& ex() const { return ex_; }
  const Eigen::Vector3d& ey() const { return ey_; }

  // Angles in (-pi, pi]. Absent where no pose within the joints' limits was found. `point` in W, taken in the plane.
  std::optional<std::vector<double>> pose_at(const Eigen::Vector3d& point);

 private:
  struct Start {
    std::vector<double> q;
    Eigen::Vector2d tip;
  };

  Eigen::Vector2d in_plane(const Eigen::Vector3d& x) const { return {ex_.dot(x), ey_.dot(x)}; }
  Eigen::Vector2d tip(const std::vector<double>& q);
  std::optional<std::vector<double>> closed_form(const Eigen::Vector2d& point);
  std::optional<std::vector<double>> bent_alike(const Eigen::Vector2d& point);
  void bend_alike(std::vector<double>& q, double s) const;  // s: of half a turn, or of a slider's way
  bool improve(std::vector<double>& q, const Eigen::Vector2d& point);
  bool accept(std::vector<double>& q, const Eigen::Vector2d& point);
  double joint_sign(int body) const;
  void find_reach();
  void make_starts();

  const Chain& chain_;
  Elbow elbow_;
  Workspace ws_;
  std::vector<double> at_rest_;
  Eigen::Vector3d ex_, ey_, middle_;
  double reach_ = 0;
  std::vector<Start> starts_;
};

}  // namespace chainreel
