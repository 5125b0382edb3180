// Vectors over a chain: torques as arcs, forces and velocities as arrows. Each has one scale a clip, all forces the same, which no single
// peak decides on: the magnitude below which 95 % of those lie that the clip has measures 0.20 H, or turns by 240 degrees.
// Larger ones grow with it up to 1.25 times that; beyond, a break in the shaft says that they are cut. No arrow leaves its
// scene: the camera holds them at kLeastArrows of these lengths, and they are as long as what it then shows has room for.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

#include "draw/layers/peaks.hpp"
#include "draw/page/mark_labels.hpp"
#include "draw/page/scales.hpp"
#include "draw/page/sheet.hpp"
#include "draw/robot/fit.hpp"
#include "draw/robot/joints.hpp"
#include "picture/camera.hpp"
#include "picture/text.hpp"
#include "picture/theme.hpp"

namespace chainreel {

enum class VectorKind { torque, joint_force, velocity, weight, constraint, push };
inline constexpr std::array<VectorKind, 6> kVectorKinds{VectorKind::torque, VectorKind::joint_force,
                                                        VectorKind::velocity, VectorKind::weight,
                                                        VectorKind::constraint, VectorKind::push};

// What the number beside a vector is of, in math notation, where that is another thing than its size.
struct Amount {
  std::string of{};
  double value = 0;
};

// What is to be shown at one instant, in W.
struct WorldVector {
  VectorKind kind = VectorKind::velocity;
  Eigen::Vector3d place = Eigen::Vector3d::Zero();  // m: where it acts
  Eigen::Vector3d value = Eigen::Vector3d::Zero();  // N, N m or m/s; of a torque: along the axis of its sense
  Eigen::Vector3d axis = Eigen::Vector3d::Zero();   // of a torque, unit, so that one of zero has a ring
  Eigen::Vector3d rail = Eigen::Vector3d::Zero();   // of a joint force, unit: it is drawn beside its rail
  std::string label{};                              // a symbol in math notation
  double ring = 0;  // of a torque: opacity of the ring which says that it rests
  std::optional<Peak> peak{};  // its name says this number, as where it is cut
  bool keeps_name = false;  // of a torque: it is small for a moment only, as where it changes its sense, and does not lose its name for that
  double swept = 0;  // m: of a torque about a joint of the ground, how far from it the link reaches that it turns
  double size = 1;  // of a torque's arc: less where links are short on the page
  bool at_tip = false;  // at the end effector, whose mark would hide a dot
  bool pushes = false;  // a force whose arrow ends where it acts: from there it would lie on the link that it pushes
  std::optional<Amount> amount{};
  std::optional<double> extreme{};  // its number where that is largest between the frames beside this one
  double lane = 0;      // units of H at usual marks, to the left of its own way: beside others that act at its place along its line
  double aside = 0;     // units of H, to the left of its own way: it stands beside what it would hide, and a line ties it to its place
};

// What an arrow on the page is worth.
struct VectorScale {
  double full = 0;          // N, N m, m/s; 0: nothing of this kind is to be drawn
  double page_of_full = 0;  // its length, units of H; for torques the angle, rad

  double on_page(double magnitude) const { return full > 0 ? magnitude / full * page_of_full : 0; }
};
struct VectorScales {
  std::array<double, kVectorKinds.size()> full{};  // by kind; 0: there is none
  double shrink = 1;  // of all lengths; below 1 where panels share a page
  std::array<double, kVectorKinds.size()> largest{};  // ... no size is above, HUGE_VAL where that is not known

  VectorScale of(VectorKind kind) const;
};
// What it is in one number: along its axis or rail, its amount, else its size.
double number_of(const WorldVector& vector);
inline constexpr double kTurnOfFull = 240, kWidestTurn = 300;  // degrees
// Of the widest turn that arcs have: arcs of less lie on the disc of their joint, and have no name.
inline constexpr double kLeastNamed = 0.08;
// Of their lengths, for which the camera makes room.
inline constexpr double kLeastArrows = 0.5;
// Below this fraction of the full one a torque rests.
inline constexpr double kRestBelow = 0.01;

// What something is at a sample, and how long that stands for, s of the motion.
struct Magnitude {
  double size = 0, weight = 1;
};
// What 95 % of the motion's time are at most, of those that are more than round-off beside the largest; 0 where there is none: the
// full one. Where all weights are zero, as of a picture by itself, they count alike.
double full_magnitude(std::vector<Magnitude> magnitudes);
// How long sample k stands for what is moving, s: up to the next one, and the last one like that before it.
double lasts(const std::vector<double>& t, std::size_t k);
// The same of forces that have needles, as ties have near singular poses: where what `full` makes of the sizes of most of the time are dots, 2.4
// times the middle one. What is larger is cut, and has its number.
double without_needles(double full, std::vector<Magnitude> largest);

// The magnitudes of a clip, of which its scales are made.
class VectorMagnitudes {
 public:
  void add(const WorldVector& vector, double weight = 1);
  // Of each kind the full one.
  std::array<double, kVectorKinds.size()> full() const;

 private:
  std::array<std::vector<Magnitude>, kVectorKinds.size()> magnitudes_;
};

// How strongly the ring of a torque that rests is seen at each of the instants `t` (s, rising), 0 to 1: from 0.3 s of rest
// on, where it rests for 0.6 s at least, so that no ring is a flash; it comes and goes in 0.15 s.
std::vector<double> rings_along(const std::vector<double>& t, const std::vector<bool>& rests);

Color color_of(VectorKind kind, const Theme& theme);
// "torque", "N m": what the legend says.
std::string name_of(VectorKind kind);
std::string unit_of(VectorKind kind);

// One entry a kind of vector that is shown, each with a mark of 1, 2 or 5 x 10^n: the scale is printed
// whenever the layer is on. `named`: the legend is on, and says what each one is.
std::vector<ScaleEntry> scale_entries(const VectorScales& scales, const std::vector<VectorKind>& shown,
                                      bool named, const Theme& theme);

// Draws vectors and tells what room they take, both from the same measures. `marks`: as in ChainLook. Not shared
// between threads.
class VectorPen {
 public:
  VectorPen(const Theme& theme, const Fonts& fonts, double text_scale, const VectorScales& scales);

  // Adds the place of a vector to `box` with the room that it takes, in the margin where there is one. `share`: of an arrow's length.
  // Its word takes none: it has other places where there is no room beyond the tip.
  void add_to(FitBox& box, const WorldVector& vector, const Camera& camera, double marks, double share) const;
  // What it covers on the page about the projection of its place, without its label and with it; empty if it is not drawn.
  Rect bare_extent(const WorldVector& vector, const Camera& camera, double marks, double share = 1) const;
  Rect extent(const WorldVector& vector, const Camera& camera, double marks) const;
  // From its tail to its tip; of a force or a velocity.
  PageLine line_of(const WorldVector& vector, const Camera& camera, double marks) const;
  // What is larger is cut.
  double cut_beyond(VectorKind kind) const;
  // The height of their names' letters, units of H.
  double em(double marks) const { return scaled(std::max(size::kSymbol * std::sqrt(marks), kSmallestText), text_scale_); }
  // Its label goes to `labels`, which are drawn over all vectors.
  void draw(Picture& picture, const WorldVector& vector, const Camera& camera, double marks, int clip,
            MarkLabels& labels) const;

 private:
  struct Straight {
    Point shift, v;  // of the tail from the place; units of H
    double broken = 0;
    Point off{};  // of the shift what leads to beside the disc of a joint
  };
  Straight straight(const WorldVector& vector, const Camera& camera, double marks, double share = 1) const;
  void draw_tie_to_place(Picture& picture, Point place, Point tail, double marks, Color color, int clip) const;
  const TextLine& label(const WorldVector& vector, double marks, bool has_number = false) const;
  void draw_torque(Picture& picture, const WorldVector& vector, const Camera& camera, double marks, int clip,
                   MarkLabels& labels) const;

  const Theme* theme_;
  const Fonts* fonts_;
  double text_scale_;
  VectorScales scales_;
  mutable std::map<std::tuple<VectorKind, std::string, double>, TextLine> labels_;
};

}  // namespace chainreel
