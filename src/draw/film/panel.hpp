// One run in its part of the page.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "draw/film/plot_strip.hpp"
#include "draw/layers/acting.hpp"
#include "draw/layers/ellipse.hpp"
#include "draw/layers/foot_mark.hpp"
#include "draw/layers/ground_plane.hpp"
#include "draw/layers/marks.hpp"
#include "draw/layers/mass_map.hpp"
#include "draw/layers/trail.hpp"
#include "draw/robot/body_shapes.hpp"
#include "draw/robot/fit.hpp"
#include "draw/robot/joints.hpp"
#include "draw/robot/skeleton.hpp"
#include "scene/scene.hpp"
#include "sim/tip.hpp"
#include "sim/trajectory.hpp"

namespace chainreel {

// What the scene's `draw:` names.
struct Layers {
  bool chain = false, trail = false, time = false, title = false;
  bool torque_label = false, ellipse = false, scale_bar = false, legend = false;
  bool ground = false, shadow = false, section = false;
  bool ghosts = false, frames = false, com = false, mass_matrix = false, equation = false;
  ActingLayers acting;
  EllipseReading reading = EllipseReading::mass;
};
Layers layers_of(const Scene& scene);

// References must outlive what is drawn from them.
struct PanelRun {
  const Scene& scene;
  const Chain& chain;
  const Trajectory& trajectory;
  const Simulation* simulation = nullptr;  // needed where torques or constraint forces are shown
  const BodyShapes* shapes = nullptr;      // drawn instead of bars
};

// How a panel treats a run that came to no good end.
enum class WildEnd {
  shown,   // all of it, as far as the camera sees
  frozen,  // the panel stands still before the chain leaves its part of the page
};

// Places along the whole run are computed once; a frame then costs the kinematics of one pose. Not shared
// between threads: frames use one workspace. First fit, then settle, then draw.
class Panel {
 public:
  // The first `samples` samples of the run are its frames.
  Panel(const PanelRun& run, const Layers& layers, int samples, WildEnd wild_end, const Theme& theme);

  // The run did not come to an end that it should have: other panels decide on the camera.
  bool is_wild() const { return wild_; }
  bool may_freeze() const { return wild_ && wild_end_ == WildEnd::frozen; }

  // Bounded semi-axes of the ellipse at some of the frames, kg or m/s.
  std::vector<double> bounded_semi_axes() const;

  // The largest magnitudes of the vectors that are shown.
  VectorPeaks peaks();
  // Of all |M_ij| at some of the frames.
  double largest_mass_entry() const;

  // Before fit_box: vectors and axes take room, which goes with the size of the panel's marks.
  void set_pens(const Fonts& fonts, const VectorScales& scales, double marks);
  void set_mass_map(MassMap map) { map_.emplace(std::move(map)); }
  const std::optional<MassMap>& mass_map() const { return map_; }

  // What the plots of the page show of the run; its simulation must be there.
  StripRun strip_run() const;

  // A box in W around all places of the run, of wild ones only where `with_wild`.
  MotionBox motion(bool with_wild) const;

  // What a camera with these axes must hold. Wild panels widen it only where `with_wild`.
  FitBox fit_box(const Camera& view, double marks, bool with_wild);

  // The ground below the chain, the same for all panels, for its grid and for shadows.
  void set_ground(const GroundPlane& ground) { ground_ = ground; }

  // The panel's part of the page, as a camera sees it; `clip` is the index of `scene` in the pictures to
  // come.
  void settle(const Camera& camera, const Rect& scene, int clip, double marks);

  // Nothing of the chain, its trail and its vectors ever comes into this part of the page, as this camera sees
  // it.
  bool leaves_free(const Camera& camera, const Rect& part);
  void place_mass_map(Point corner) { map_corner_ = corner; }

  // Over another panel, without ground and marks; `letter`: at the end of the chain, or "".
  void draw_in_outline(Color color, const std::string& letter);
  void set_trail_color(Color color) { trail_color_ = color; }
  // Rails become as long as the other's, whose motion they show, too.
  void reach_as_far_as(const Panel& other);

  void draw_static(Picture& picture) const;
  // Everything that moves, but words.
  void draw_frame(Picture& picture, int k, const EllipseScale& scale, const Fonts& fonts) const;
  // "left the picture at t = 1.24 s" from that frame on, or what happened last: "elbow straight at t = 1.24 s".
  std::string note(int k) const;
  bool may_have_notes() const { return may_freeze() || !run_.scene.events.empty(); }
  const std::optional<FootMark>& foot() const { return foot_; }
  std::string title() const;  // of the scene, with what it says of this run
  // The instant at which the panel stood still.
  std::optional<double> left_at() const;

  bool is_constrained() const { return run_.simulation && !run_.simulation->constraints.empty(); }
  const Scene& scene() const { return run_.scene; }
  const Chain& chain() const { return run_.chain; }
  const Camera& camera() const { return camera_; }
  const Rect& area() const { return area_; }

 private:
  // Of the effective mass at frame k; moves the workspace.
  std::vector<MassAxis> ellipse_axes(int k) const;
  std::string event_note(int k) const;
  void find_rails(int samples);
  void follow_tip();
  void find_last_inside();
  bool is_inside() const;
  void pose_at(int k) const;
  int counted(bool with_wild) const { return wild_ && !with_wild ? 1 : samples_; }
  bool covers(const Camera& camera, const Rect& part, int k) const;
  void draw_ghosts(Picture& picture, int k) const;
  void draw_outline(Picture& picture, int k, const Fonts& fonts) const;
  void draw_letter(Picture& picture, Point tip, Color color, const Fonts& fonts) const;
  void draw_overlays(Picture& picture, const std::vector<WorldVector>& vectors, MarkLabels& labels) const;

  PanelRun run_;
  Layers layers_;
  const Theme& theme_;
  WildEnd wild_end_;
  bool wild_ = false;
  int samples_ = 0;    // of the run
  int last_ = 0;       // frame that is drawn
  bool left_ = false;  // the chain left the picture before the run ended
  double limit_ = 0;   // m; places beyond it belong to a run that diverged
  Skeleton skeleton_;
  Camera camera_;
  Rect area_;
  int clip_ = 0;
  ChainLook look_;
  TipPath tip_;
  std::optional<Color> trail_color_;  // absent: of the last link's curve
  std::unique_ptr<Theme> outline_;    // of a panel in outline: its ink is the outline's colour
  std::string letter_;
  std::optional<FootMark> foot_;
  std::optional<GroundPlane> ground_;
  std::optional<TipMass> tip_mass_;  // where the ellipse is drawn
  std::optional<Acting> acting_;
  std::optional<VectorPen> pen_;
  std::optional<FrameAxes> axes_;
  std::optional<MassMap> map_;
  Point map_corner_;
  std::unique_ptr<Workspace> ws_;
};

}  // namespace chainreel
