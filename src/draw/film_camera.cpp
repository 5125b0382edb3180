// How the one camera of a film is placed: which way it looks, from how far, and what it holds.
#include <algorithm>

#include "core/error.hpp"
#include "draw/film.hpp"
#include "draw/view.hpp"

namespace chainreel {
bool Film::all_wild() const {
  return std::all_of(panels_.begin(), panels_.end(), [](const Panel& panel) { return panel.is_wild(); });
}

MotionBox Film::motion() const {
  MotionBox box(up_of(panels_.front().chain()));
  for (const Panel& panel : panels_)
    if (all_wild() || !panel.is_wild()) box.add(panel.motion(all_wild()));
  return box;
}

FitBox Film::fit_box(const Camera& view, double marks) {
  FitBox box;
  for (Panel& panel : panels_) panel.set_pens(fonts_, vector_scales_, marks);
  for (Panel& panel : panels_) box.add(panel.fit_box(view, marks, all_wild()));
  return box;
}

// What is to be seen just fills `area`, or what the scene says.
void Film::fit_to_area(Camera& camera, const FitBox& box, const Rect& area) const {
  if (!fit_as_told(camera, scene_.camera, area)) fit_to(camera, box, area, size::kFitMargin);
}

void Film::find_ground(const Camera& camera) {
  const bool wanted = layers_.ground || layers_.shadow;
  if (!wanted || !is_oblique(panels_.front().chain(), scene_.camera)) return;
  if (const auto ground = ground_under(motion(), camera))
    for (Panel& panel : panels_) panel.set_ground(*ground);
}

void Film::fit_camera() {
  Camera camera = view_of(panels_.front().chain(), scene_.camera);
  FitBox box = fit_box(camera, 1);
  find_cells(box);
  if (cells_.empty())
    throw Error(ExitCode::bad_input,
                "the panels get too small on this page: compare fewer, or lower text_scale",
                scene_.place_of("compare"));
  const double marks = is_ghost() ? 1 : marks_in(cells_);
  if (has_eye(panels_.front().chain(), scene_.camera))
    place_eye(
        camera, motion(), scene_.camera, cells_.front().scene.height(),
        [&](Camera& seen) { fit_to_area(seen, fit_box(seen, marks), cells_.front().scene); },
        scene_.place_of("camera.distance"));
  if (marks != 1 || camera.nearness > 0) box = fit_box(camera, marks);
  fit_to_area(camera, box, cells_.front().scene);
  if (layers_.mass_matrix && !place_mass_maps(camera)) {
    set_mass_maps_aside();
    fit_to_area(camera, box, cells_.front().scene);
  }
  find_ground(camera);
  for (std::size_t i = 0; i < panels_.size(); ++i)
    panels_[i].settle(camera_of(camera, i), cells_[i].scene, int(i), marks);
  for (std::size_t i = full_panels(); i < panels_.size(); ++i) panels_.front().reach_as_far_as(panels_[i]);
}

void Film::find_cells(const FitBox& box) {
  const int count = panel_count();
  if (is_ghost())
    cells_ = ghost_cells(sheet_.scene, rows_, panels_);
  else if (scene_.layout == "compare")
    cells_ = panel_cells(sheet_.scene, count, count, rows_);
  else
    cells_ = best_cells(sheet_.scene, count, rows_, box);
}

// All panels see the same part of the world at the same place of their cells.
Camera Film::camera_of(const Camera& first, std::size_t i) const {
  const Rect &from = cells_.front().scene, &to = cells_[i].scene;
  Camera shifted = first;
  shifted.origin = first.origin + Point{to.x0 - from.x0, to.y0 - from.y0};
  return shifted;
}

}  // namespace chainreel
