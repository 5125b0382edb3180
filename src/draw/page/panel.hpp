// One run in its part of the page.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "draw/page/stage.hpp"
#include "draw/robot/chain.hpp"

namespace chainreel {

// Frames further apart, where a film shows the motion much faster than it was, do not say how it went between them.
inline constexpr double kLongestTrailStep = 0.1;  // s

// Where the end effector, or the centre of mass of what is followed by that, was on the page and how fast it moved there, at the frames.
class TipPath {
 public:
  // `speed` in page units a second. A place off the page by far, or not finite, is a gap: no trail crosses
  // it.
  void add(double t, Point place, Point speed);
  void reserve(std::size_t frames);

  int size() const { return int(t_.size()); }
  double time(int k) const { return t_[std::size_t(k)]; }
  Point place(int k) const { return place_[std::size_t(k)]; }
  // Between the frames: the cubic that has their places and speeds. `t` within the path.
  Point at(double t) const { return at(t, frame_at(t)); }
  Point at(double t, int frame) const;  // which is that before t
  int frame_at(double t) const;  // the last one not after t
  // Into how many straight pieces the way from frame k to the next one is to be cut for none to be longer
  // than `length`.
  int pieces(int k, double length, int most) const;
  // The frame after which no gap lies before frame k, not earlier than `t`.
  double gapless_since(int k, double t) const;

 private:
  std::vector<double> t_;
  std::vector<Point> place_, speed_;
  std::vector<bool> gap_;
};

// A part of the page and what is seen in it.
struct PanelView {
  Camera camera;
  Rect area;
  int clip = 0;      // index of `area` in the pictures to come
  double marks = 1;  // size of marks, as in ChainLook
  std::optional<Rect> room{};  // of `area`: what a layer has for itself
};

// A motion as a camera sees it: until when it is in the picture, and where its end effector goes on the page.
inline constexpr char kBetweenEvents[] = ";  ";
inline constexpr char kLeftThePicture[] = "left the picture at ";
inline constexpr char kBeforeAway[] = ", up to ";  // how far off a run comes to be that left the picture

class Panel {
 public:
  Panel(const StagedRun& motion, const PanelView& view, const Theme& theme);
  // Rails become as long as those of another panel, whose motion they show, too, or beside which they stand.
  void let_rails_reach(const std::vector<Rail>& others);
  const std::vector<Rail>& rails() const { return skeleton_.rails; }
  const Skeleton& skeleton() const { return skeleton_; }

  const StagedRun& motion() const { return *motion_; }
  const Chain& chain() const { return motion_->chain(); }
  const Scene& scene() const { return motion_->scene(); }
  const Camera& camera() const { return view_.camera; }
  const Rect& area() const { return view_.area; }
  int clip() const { return view_.clip; }
  double marks() const { return view_.marks; }
  const std::optional<Rect>& room() const { return view_.room; }
  const TipPath& tip() const { return tip_; }
  int last() const { return last_; }  // frame that is drawn
  const ChainLook& look() const { return look_; }
  ChainDrawing drawing(const ChainLook& look) const;
  ChainDrawing drawing() const { return drawing(look_); }

  // "left the picture at t = 1.24 s, up to 3\u00D710\u2075 m away" from that frame on, or what happened last: "t = 1.24 s: elbow straight".
  std::string note(int k, int events = 2) const;  // of several kBetweenEvents
  std::string title() const { return motion_->title(); }
  // On the page, which it may be far beyond: the place of the chain that is farthest from the world's origin at a sample.
  Point far_point(int k) const;
  // The instant at which the panel stood still.
  std::optional<double> left_at() const;

 private:
  void find_last_inside();
  bool is_inside(const Workspace& ws) const;
  void follow_tip();
  std::string event_note(int k, int events) const;
  std::string away_note() const;
  Eigen::Vector3d farthest_place(const Workspace& ws) const;

  const StagedRun* motion_;
  PanelView view_;
  Skeleton skeleton_;
  ChainLook look_;
  TipPath tip_;
  int last_;
  mutable std::optional<double> farthest_;  // m, as soon as it was asked for
  bool left_ = false;  // the chain left the picture before the run ended
};

}  // namespace chainreel
