// A film: the runs of one scene's panels as pictures, frame by frame.
#pragma once

#include <memory>
#include <mutex>
#include <vector>

#include "draw/film/compose.hpp"
#include "draw/film/film_sheet.hpp"
#include "draw/film/film_view.hpp"
#include "draw/film/film_words.hpp"
#include "draw/layers/layer.hpp"
#include "draw/page/panel.hpp"

namespace chainreel {

// Runs seen by one camera that is fitted once over all frames of all panels: same scale everywhere, so that
// lengths can be compared by eye. Pictures may be asked for by several threads, and are then made one after the other: a
// picture takes some 0.2 ms, its pixels many times that.
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

  // All of both for a picture that stands alone: words of marks that come or go then are there in full.
  Picture still(int k) const;

  const FilmClock& clock() const { return stage_->clock; }
  int frame_count() const { return int(stage_->times.size()); }
  int panel_count() const { return int(panels_.size()); }
  const Panel& panel(int i) const { return panels_[std::size_t(i)]; }
  const Camera& camera(int i = 0) const { return panel(i).camera(); }
  const Rect& scene_area(int i = 0) const { return panel(i).area(); }
  // Layers that the scene draws and that a page this small has no room for.
  const std::vector<std::string>& left_out() const { return left_out_; }
  double held_text_scale() const { return held_text_scale_; }  // as of Composition
  // Where the words of a panel's marks stand at its frame k.
  std::vector<StandingWord> words(int i, int k) const;

 private:
  Picture page() const;
  std::lock_guard<std::mutex> alone() const { return std::lock_guard(*drawing_); }
  void draw_veil(Picture& picture, std::size_t i) const;
  void draw_way_out(Picture& picture, std::size_t i, int k) const;
  void draw_panel(Picture& picture, std::size_t i, int k, bool is_still) const;
  Picture drawn(int k, bool is_still) const;
  void draw_cell_frames(Picture& picture) const;
  std::vector<TextLine> note_lines(const Panel& panel, int k, const Rect& row, const TextStyle& style) const;
  void draw_notes(Picture& picture, int k) const;

  explicit Film(Composition composed);

  std::unique_ptr<const Stage> stage_;
  Layers layers_;
  FilmSheet sheet_;
  FilmView view_;
  std::vector<PlacedText> titles_;
  std::vector<Panel> panels_;
  FilmWords words_;
  std::vector<std::string> left_out_;
  double held_text_scale_ = 0;
  std::unique_ptr<std::mutex> drawing_ = std::make_unique<std::mutex>();  // poses and masses of a run use one workspace
};

}  // namespace chainreel
