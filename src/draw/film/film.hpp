// A film: the runs of one scene's panels as pictures, frame by frame.
#pragma once

#include <string>
#include <vector>

#include "draw/film/ghost_layout.hpp"
#include "draw/film/panel.hpp"
#include "draw/film/plot_strip.hpp"
#include "draw/film/speed_box.hpp"
#include "draw/page/panel_grid.hpp"
#include "draw/page/sheet.hpp"

namespace chainreel {

// Runs seen by one camera that is fitted once over all frames of all panels: same scale everywhere, so that
// lengths can be compared by eye. Not shared between threads.
class Film {
 public:
  // One panel. References must outlive the film. Samples 0..frames-1 of the trajectory are the frames; a run
  // that ended early stands still from its last sample on.
  Film(const Scene& scene, const Chain& chain, const Trajectory& trajectory, int frames, const Fonts& fonts);

  // `page` says what all panels share. Sample k of each trajectory is its frame k, shown at times[k]; the clock says
  // how fast the motion passes there. A run that diverges is left out of the fit, unless all do; its panel stands
  // still before the chain leaves it, and says so. That holds for the only panel, too, where the scene expects it to
  // diverge.
  Film(const Scene& page, const std::vector<PanelRun>& runs, std::vector<double> times, const Fonts& fonts,
       FilmClock clock = {});

  Picture static_layer() const;  // background, words, ground marks: what no frame changes
  Picture frame(int k) const;    // everything that moves, painter's order, drawn over the static layer

  const FilmClock& clock() const { return clock_; }
  int frame_count() const { return int(times_.size()); }
  int panel_count() const { return int(panels_.size()); }
  const Panel& panel(int i) const { return panels_[std::size_t(i)]; }
  const Camera& camera(int i = 0) const { return panel(i).camera(); }
  const Rect& scene_area(int i = 0) const { return panel(i).area(); }
  const EllipseScale& ellipse_scale() const { return ellipse_scale_; }
  const VectorScales& vector_scales() const { return vector_scales_; }

 private:
  bool is_comparison() const { return panels_.size() > 1; }
  bool is_ghost() const { return is_comparison() && is_ghost_layout(scene_); }
  bool has_cells() const { return is_comparison() && !is_ghost(); }
  // The others are drawn over them, in outline.
  std::size_t full_panels() const { return is_ghost() ? 1 : panels_.size(); }
  void find_ellipse_scale();
  void find_vector_scales();
  void make_mass_maps();
  std::vector<ScaleEntry> entries() const;
  bool is_constrained() const;
  Camera camera_of(const Camera& first, std::size_t i) const;
  bool place_mass_maps(const Camera& camera);
  void set_mass_maps_aside();
  void lay_out();
  void lay_out_plots();
  std::vector<std::string> common_torque() const;
  bool all_wild() const;
  MotionBox motion() const;
  FitBox fit_box(const Camera& view, double marks);
  void fit_to_area(Camera& camera, const FitBox& box, const Rect& area) const;
  void find_ground(const Camera& camera);
  void fit_camera();
  double title_size() const;
  void tell_variants_apart();
  void place_titles();
  void find_cells(const FitBox& box);
  bool has_notes() const;
  void draw_notes(Picture& picture, int k) const;
  Picture page() const;
  void draw_frames(Picture& picture) const;

  const Scene& scene_;
  const Fonts& fonts_;
  const Theme& theme_;
  Layers layers_;
  std::vector<double> times_;
  FilmClock clock_;
  std::vector<Panel> panels_;
  EllipseScale ellipse_scale_;
  VectorScales vector_scales_;
  Sheet sheet_;
  PanelRows rows_;
  std::vector<PanelCell> cells_;
  std::vector<PlotStrip> plots_;
  std::vector<PlacedText> titles_;
  std::optional<GhostKey> key_;
  std::optional<SpeedBox> speed_;
};

}  // namespace chainreel
