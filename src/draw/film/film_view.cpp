#include "draw/film/film_view.hpp"

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "draw/robot/chain_fit.hpp"
#include "draw/robot/joints.hpp"
#include "draw/robot/view.hpp"
#include "picture/point.hpp"

namespace chainreel {
namespace {

constexpr double kLargestAside = 0.6;  // of a panel's width may be taken by what stands beside its scene
constexpr double kAir = 0.010;         // around a part of the page that is left free

// Pages higher than wide: marks are those of a page as wide.
bool is_portrait(const Scene& page) {
  return page.video.height > page.video.width;
}

// Pages of paper may be as high as they need, so that titles there have their width.
bool is_paper(const Scene& page) {
  return page.video.least_text > 0;
}

// Panels as a comparison has them: side by side, on paper unless their titles are too long for that. On pages higher than wide above one another,
// unless what they show is larger side by side.
std::vector<PanelCell> compared_cells(const Stage& stage, const FilmSheet& sheet, const Rect& area, const FitBox& box) {
  const int count = int(stage.motions.size());
  std::vector<PanelCell> beside = panel_cells(area, count, count, sheet.rows), above = panel_cells(area, count, 1, sheet.rows);
  const double width = beside[0].title.width();
  if (is_paper(stage.page)) return !is_portrait(stage.page) && width >= sheet.widest_title(stage) ? beside : above;
  if (!is_portrait(stage.page) && !sheet.has_plots_beside) return beside;
  const auto row = sheet.row_of_titles(stage, width);
  if (!row) return is_portrait(stage.page) ? above : beside;
  PanelRows rows = sheet.rows;
  rows.title = *row;
  beside = panel_cells(area, count, count, rows);
  if (!is_portrait(stage.page)) return beside;
  const auto scale_in = [&](const PanelCell& cell) {
    Camera camera;
    fit_to(camera, box, cell.scene, size::kFitMargin);
    return camera.scale;
  };
  return scale_in(beside[0]) > scale_in(above[0]) ? beside : above;
}

// What a camera with these axes must hold of a motion: the chain, and what layers draw over it. Wild ones count with
// their start, unless all are.
ViewBoxes fit_boxes(const StagedRun& motion, const Layers& layers, const Camera& view, double marks) {
  ChainFit fit(motion.chain(), motion.skeleton(), view, marks, motion.shapes());
  ViewBoxes boxes;
  if (motion.is_constrained()) {
    const double half = marks * size::kGroundLength / 2;
    for (const Eigen::Vector3d& place : closure_pins(motion.chain(), motion.simulation()->constraints))
      boxes.must.add({half, half, marks * pin_depth(), 0}, view.flat(place));
  }
  for (int k = 0; k < motion.counted(); ++k) {
    const Workspace& ws = motion.pose_at(k);
    if (!fit.add_pose(ws, motion.limit())) continue;
    for (const auto& layer : layers) {
      if (!layer->is_of(motion)) continue;
      layer->measure({motion, ws, k, view, marks}, boxes.must);
      layer->wish({motion, ws, k, view, marks}, boxes.wishes);
    }
  }
  boxes.must.add(fit.box());
  return boxes;
}

ViewBoxes fit_boxes(const Stage& stage, const Layers& layers, const Camera& view, double marks) {
  ViewBoxes boxes;
  for (const StagedRun& motion : stage.motions) {
    const ViewBoxes its = fit_boxes(motion, layers, view, marks);
    boxes.must.add(its.must);
    boxes.wishes.add(its.wishes);
  }
  return boxes;
}

// What is to be seen just fills `area`, or what the scene says.
void fit_to_area(Camera& camera, const Stage& stage, const ViewBoxes& boxes, const Rect& area) {
  if (!fit_as_told(camera, stage.page.camera, area)) fit_to(camera, boxes.must, boxes.wishes, area, size::kFitMargin);
}

std::vector<PanelCell> cells_of(const Stage& stage, const FilmSheet& sheet, double row_below, const FitBox& box) {
  const int count = int(stage.motions.size());
  Rect area = sheet.sheet.scene;
  area.y0 += row_below;
  const auto cells_beside_plot = [&] {
    std::vector<PanelCell> all = panel_cells(area, count + 1, sheet.plot_room.columns, sheet.rows);
    all.pop_back();
    if (!is_large_enough(all.front().scene)) all.clear();
    return all;
  };
  // Titles that would be cut stand on two lines.
  const auto cells_of_grid = [&] {
    const auto with = [&](const PanelRows& rows) { return best_cells(area, count, rows, box, sheet.widest_title(stage), is_paper(stage.page), stage.page.video.panel_names > 0); };
    std::vector<PanelCell> cells = with(sheet.rows);
    PanelRows rows = sheet.rows;
    if (!cells.empty() && !(stage.page.video.panel_names > 0)) rows.title = sheet.row_of_titles(stage, cells.front().title.width()).value_or(rows.title);
    if (!(rows.title > sheet.rows.title)) return cells;
    std::vector<PanelCell> higher = with(rows);
    return higher.empty() || higher.front().title.width() < cells.front().title.width() - kRoundOff ? cells : higher;
  };
  const std::vector<PanelCell> cells =
      sheet.plot_room.columns > 0       ? cells_beside_plot()
      : stage.is_ghost()                ? ghost_cells(area, sheet.rows, stage.motions)
      : stage.page.layout == PageLayout::compare ? compared_cells(stage, sheet, area, box)
                                        : cells_of_grid();
  if (cells.empty())
    throw Error(ExitCode::bad_input,
                "the panels get too small on this page: compare fewer, or lower text_scale",
                stage.page.place_of("compare"));
  return cells;
}

// A corner of the panels' scenes; the same one in all of them.
struct SceneCorner {
  bool right = true, top = true;

  Point lower_left(const Rect& scene, Point room, double inset) const {
    return {right ? scene.x1 - inset - room.x : scene.x0 + inset,
            top ? scene.y1 - inset - room.y : scene.y0 + inset};
  }
  bool is_lower_left() const { return !right && !top; }
};
constexpr SceneCorner kCorners[] = {{true, true}, {false, true}, {true, false}, {false, false}};

// Nothing of the chain and of the layers over it ever comes into this part of the page.
bool is_free(const Rect& part, const StagedRun& motion, const Layers& layers, const Camera& camera, double marks,
             const SceneCorner& corner) {
  const Rect with_air = widened(part, kAir);
  for (int k = 0; k < (motion.is_wild() ? 1 : motion.samples()); ++k) {
    const Sight sight{motion, motion.pose_at(k), k, camera, marks};
    if (covers(motion.chain(), motion.skeleton(), motion.shapes(), sight.ws, camera, with_air)) return false;
    for (const auto& layer : layers)
      if (layer->is_of(motion) && layer->covers(sight, with_air, corner.is_lower_left())) return false;
  }
  return true;
}

}  // namespace

FilmView::FilmView(const Stage& stage, const Layers& layers, const FilmSheet& sheet) {
  place_camera(stage, layers, sheet);
  place_rooms(stage, layers);
  shorten_arrows(stage, layers);
}

Point FilmView::size_used() const {
  FitBox all = boxes_.must;
  all.add(boxes_.wishes);
  const Rect box = all.box(camera.scale, size::kFitMargin);
  return {camera.scale * box.width(), camera.scale * box.height()};
}

Camera FilmView::camera_of(std::size_t panel) const {
  const Rect &from = cells.front().scene, &to = cells[panel].scene;
  Camera shifted = camera;
  shifted.origin = camera.origin + Point{to.x0 - from.x0, to.y0 - from.y0};
  return shifted;
}

void FilmView::place_camera(const Stage& stage, const Layers& layers, const FilmSheet& sheet) {
  const Chain& chain = stage.motions.front().chain();
  const CameraEntry& entry = stage.page.camera;
  camera = view_of(chain, entry);
  boxes_ = fit_boxes(stage, layers, camera, 1);
  for (const auto& layer : layers) row_below_ = std::max(row_below_, layer->row_below());
  cells = cells_of(stage, sheet, row_below_, boxes_.must);
  marks = is_portrait(stage.page) ? marks_in(cells.front().scene) : stage.is_ghost() ? 1 : marks_in(cells);
  const Rect& first = cells.front().scene;
  if (has_eye(chain, entry))
    place_eye(
        camera, *stage.space, entry, first.height(),
        [&](Camera& seen) { fit_to_area(seen, stage, fit_boxes(stage, layers, seen, marks), first); },
        stage.page.place_of("camera.distance"));
  if (marks != 1 || camera.has_eye()) boxes_ = fit_boxes(stage, layers, camera, marks);
  fit_to_area(camera, stage, boxes_, first);
  if (!entry.fit || boxes_.must.empty()) return;
  const Rect box = boxes_.must.box(camera.scale, 0);
  const Point low = camera.origin + camera.scale * Point{box.x0, box.y0}, high = camera.origin + camera.scale * Point{box.x1, box.y1};
  if (!overlap({low.x, low.y, high.x, high.y}, first))
    throw Error(ExitCode::bad_input, "'camera.fit' shows nothing of what moves: leave it out to see where that is", stage.page.place_of("camera.fit"));
}

// In a corner that nothing ever comes into; else right of the scenes, which become narrower.
void FilmView::place_rooms(const Stage& stage, const Layers& layers) {
  const std::vector<StagedRun>& motions = stage.motions;
  corners_.assign(layers.size(), std::vector<Point>(motions.size()));
  rooms_.resize(motions.size());
  const double inset = stage.has_cells() ? kBarInset : 0;
  const auto stands_in = [&](std::size_t layer, const SceneCorner& corner) {
    for (std::size_t i = 0; i < motions.size(); ++i) {
      const Rect& scene = cells[i].scene;
      const Point room = *layers[layer]->room_beside(motions[i]);
      const Point at = corners_[layer][i] = corner.lower_left(scene, room, inset);
      rooms_[i] = {at.x, at.y, at.x + room.x, at.y + room.y};
      if (!(at.x >= scene.x0 && at.y >= scene.y0 && is_free(*rooms_[i], motions[i], layers, camera_of(i), marks, corner))) return false;
    }
    return true;
  };
  for (std::size_t l = 0; l < layers.size(); ++l) {
    if (!layers[l]->room_beside(motions.front())) continue;
    if (std::any_of(std::begin(kCorners), std::end(kCorners),
                    [&](const SceneCorner& corner) { return stands_in(l, corner); }))
      continue;
    double width = 0;
    for (const StagedRun& motion : motions) width = std::max(width, layers[l]->room_beside(motion)->x);
    for (std::size_t i = 0; i < motions.size(); ++i) {
      Rect& scene = cells[i].scene;
      const Point room = *layers[l]->room_beside(motions[i]);
      corners_[l][i] = {scene.x1 - inset - width, scene.y1 - inset - room.y};
      if (width + size::kGutter > kLargestAside * scene.width() || room.y > scene.height())
        throw Error(ExitCode::bad_input, layers[l]->no_room(), stage.page.place_of("draw"));
      scene.x1 -= inset + width + size::kGutter;
      rooms_[i].reset();  // it is beside the scene
    }
    fit_to_area(camera, stage, boxes_, cells.front().scene);
  }
}

void FilmView::shorten_arrows(const Stage& stage, const Layers& layers) {
  for (std::size_t i = 0; i < stage.motions.size(); ++i) {
    const StagedRun& motion = stage.motions[i];
    const Camera seen = camera_of(i);
    for (int k = 0; k < motion.counted(); ++k) {
      const Sight sight{motion, motion.pose_at(k), k, seen, marks};
      for (const auto& layer : layers)
        if (layer->is_of(motion)) layer->shorten_arrows(cells[i].scene, sight, arrows);
    }
  }
}

SharedPage FilmView::shared_page(const Stage& stage, const FilmSheet& sheet) const {
  SharedPage shared{sheet.sheet, camera_of(0), cells.front().scene};
  if (row_below_ > 0) shared.scene.y0 = sheet.sheet.scene.y0;
  if (stage.has_cells()) shared.scene.x0 += kBarInset;
  return shared;
}

}  // namespace chainreel
