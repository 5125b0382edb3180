// A film: one scene's run as pictures, frame by frame.
#pragma once

#include <memory>
#include <vector>

#include "draw/ellipse.hpp"
#include "draw/look.hpp"
#include "draw/sheet.hpp"
#include "draw/skeleton.hpp"
#include "draw/trail.hpp"
#include "scene/scene.hpp"
#include "sim/trajectory.hpp"

namespace chainreel {

// One scene's run, seen by one camera that is fitted once over all frames. Places along the whole run are
// computed once; a frame then costs the kinematics of one pose. Not shared between threads: frames use one
// workspace.
class Film {
 public:
  // References must outlive the film. Samples 0..frames-1 of the trajectory are the frames; a run that ended
  // early stands still from its last sample on.
  Film(const Scene& scene, const Chain& chain, const Trajectory& trajectory, int frames, const Fonts& fonts);

  Picture static_layer() const;  // background, title, ground mark, torque label: what no frame changes
  Picture frame(int k) const;    // everything that moves, painter's order, drawn over the static layer

  const Camera& camera() const { return camera_; }
  const Rect& scene_area() const { return sheet_.scene; }
  const MassScale& ellipse_scale() const { return mass_scale_; }

 private:
  struct Layers {
    bool chain = false, trail = false, time = false, title = false;
    bool torque_label = false, ellipse = false, scale_bar = false, legend = false;
  };
  static Layers layers_of(const Scene& scene);

  void find_rails();
  void find_mass_scale();
  void lay_out();
  void fit_camera();
  void follow_tip();
  Picture page() const;

  const Scene& scene_;
  const Chain& chain_;
  const Trajectory& trajectory_;
  const Fonts& fonts_;
  const Theme& theme_;
  Layers layers_;
  int samples_ = 0;   // that are drawn
  double limit_ = 0;  // m; places beyond it belong to a run that diverged
  Skeleton skeleton_;
  MassScale mass_scale_;
  Sheet sheet_;
  Camera camera_;
  ChainLook look_;
  TipPath tip_;
  std::unique_ptr<Workspace> ws_;
};

}  // namespace chainreel
