// Small multiples: every panel has the same camera up to a shift and the same kilograms per length, so that
// poses can be compared by eye.
#include "draw/figures/ellipse_figure.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/error.hpp"
#include "core/format.hpp"
#include "draw/figures/caption.hpp"
#include "draw/layers/ellipse.hpp"
#include "draw/layers/fading.hpp"
#include "draw/layers/ellipsoid.hpp"
#include "draw/page/mark_labels.hpp"
#include "draw/page/word_plan.hpp"
#include "draw/page/panel_grid.hpp"
#include "draw/robot/chain.hpp"
#include "draw/layers/body_obstacles.hpp"
#include "draw/robot/chain_fit.hpp"
#include "draw/robot/joints.hpp"
#include "draw/robot/view.hpp"
#include "dynamics/kinematics.hpp"

namespace chainreel {
namespace {

constexpr std::size_t kManyPoses = 5;  // have one line of caption each
constexpr double kLeastPicture = 0.7, kAboveLines = 0.55;  // of the cell of one of many, above a caption of one line, and of several
constexpr double kLeastSide = 0.08, kLeastEms = 5;  // of a panel that can be read: units of H, or of its words on tall pages
constexpr double kLabelInset = 0.014;
constexpr double kRoomForLengths = 10;  // of the em of their words: the side of a panel
// How long the bounded semi-axes (their median) are drawn, as a share of the shorter side of a panel.
constexpr double kSmallerAxis = 0.14, kLargerAxis = 0.24;

// Between panels, by the page's shorter side.
double gutter_of(const PageInUnits& page) {
  return size::kGutter * std::min(page.height, double(page.options.width) / page.options.height);
}

// Panels of equal size, row by row from the top.
std::vector<Rect> panels_of(const Rect& area, int count, int most_across, double gutter) {
  const int rows = (count + most_across - 1) / most_across, columns = (count + rows - 1) / rows;
  const double width = (area.width() - (columns - 1) * gutter) / columns;
  const double height = (area.height() - (rows - 1) * gutter) / rows;
  std::vector<Rect> panels;
  for (int i = 0; i < count; ++i) {
    const double x = area.x0 + (i % columns) * (width + gutter);
    const double y = area.y1 - (i / columns) * (height + gutter);
    panels.push_back({x, y - height, x + width, y});
  }
  return panels;
}

Rect above_caption(const Rect& panel, double caption) {
  return {panel.x0, panel.y0 + caption, panel.x1, panel.y1};
}

// What all panels share.
struct Panels {
  const Chain& chain;
  const PageInUnits& page;
  const Fonts& fonts;
  const PoseFigureOptions& options = page.options;
  std::vector<Rect> places{};
  double caption = 0;                           // height of the words below each scene
  std::vector<std::vector<std::string>> lines{};  // one a panel, where that is its whole caption
  CaptionLines words{};                           // what of them is written; else the poses above their numbers
  std::vector<std::vector<std::string>> below{};  // further lines of such captions, one a panel each
  bool has_masses = true;                       // below the scenes
  bool has_bare_masses = false;                 // ... without their name
  double filled = 1;                            // the share of a scene that is kept when it is cut to content
  double marks = 1;
  EllipseScale scale{};
  Skeleton skeleton{};
  Camera camera{};  // of the first panel

  Rect scene(std::size_t i) const { return above_caption(places[i], caption); }
  // Where the chain may be: below the words in its corner.
  Rect picture(std::size_t i) const {
    Rect below = scene(i);
    if (!options.labels.empty()) below.y1 -= kLabelInset + scaled(size::kAxis, options.text_scale);
    return below;
  }
  double side() const { return std::min(picture(0).width(), picture(0).height()); }
};

// Returns the size of what the panels show, units of H.
Point fit_panels(Panels& panels, const std::vector<Pose>& poses, Workspace& ws) {
  panels.skeleton = skeleton_of(panels.chain);
  for (const Pose& pose : poses) widen_rails(panels.skeleton, panels.chain, pose.q, kNoLimit);
  const BodyShapes* shapes = panels.options.shapes.get();
  const std::vector<double> at_rest(std::size_t(panels.chain.nv), 0.0);
  const auto box_by = [&](const Camera& seen) {
    ChainFit places(panels.chain, panels.skeleton, seen, panels.marks, shapes);
    for (const Pose& pose : poses) {
      compute_kinematics(panels.chain, ws, pose.q, at_rest);
      places.add_pose(ws, kNoLimit);
      places.add(tip_position(panels.chain, ws),
                 room_of(pose.axes, seen.seen_at(tip_position(panels.chain, ws)), panels.scale,
                         kLongestAxis * panels.side()));
    }
    return places.box();
  };
  const auto fit = [&](Camera& seen) { fit_to(seen, box_by(seen), panels.picture(0), size::kFitMargin); };
  const MotionBox motion = box_around(panels.chain, panels.skeleton, shapes, ws, configurations_of(poses));
  panels.camera = aimed_camera(panels.chain, panels.options.camera, motion, panels.picture(0), fit);
  const Rect box = box_by(panels.camera).box(panels.camera.scale);
  return panels.camera.scale * Point{box.width(), box.height()};
}

// Of a panel that shows so much: no lower than it is wide.
double kept_height(const Panels& panels, Point shown) {
  const Rect scene = panels.scene(0);
  return std::max((1 + 2 * size::kFitMargin) * shown.y + scene.height() - panels.picture(0).height(), scene.width());
}

// Panels that are narrow for what they show are no higher than it needs, or than they are wide, and stand in the middle of `area`.
void cut_to_content(Panels& panels, const Rect& area, const std::vector<Pose>& poses, Workspace& ws) {
  if (panels.options.camera.fit || panels.options.camera.focus) return;
  const double spare = panels.scene(0).height() - kept_height(panels, fit_panels(panels, poses, ws));
  if (!(spare > 0)) return;
  const double gutter = gutter_of(panels.page);
  const double pitch = panels.places[0].height() + gutter;
  const double rows = std::round((panels.places[0].y1 - panels.places.back().y1) / pitch) + 1;
  for (Rect& place : panels.places) {
    const double row = std::round((panels.places[0].y1 - place.y1) / pitch), height = place.height() - spare;
    place.y1 = area.y1 - rows * spare / 2 - row * (height + gutter);
    place.y0 = place.y1 - height;
  }
  fit_panels(panels, poses, ws);
}

// Words where they lie on nothing of what was drawn since item `first`, nor on `obstacles`.
void draw_clear_of(Picture& picture, std::size_t first, const MarkLabels& words, std::vector<Obstacle> obstacles, const Rect& scene,
                   const Theme& theme, int clip) {
  // An axis that fades out of the panel at both ends has its number at one of them.
  std::vector<MarkWord> others;
  const Rect room = widened(scene, -kLabelInset);
  for (MarkWord word : words.words()) {
    if (word.name == kLengthAtEdge) word.places = {moved_into(room, word.places.front())};
    const bool is_other_end = word.name == kLengthAtEdge && !others.empty() && others.back().name == kLengthAtEdge && others.back().places.size() == 1;
    if (is_other_end)
      others.back().places.push_back(word.places.front());
    else
      others.push_back(word);
  }
  Picture drawn;
  drawn.items.assign(picture.items.begin() + std::ptrdiff_t(first), picture.items.end());
  for (const Obstacle& one : obstacles_of(drawn)) obstacles.push_back(one);
  WordPlan plan(room, kLooksPerSecond);
  plan.add(others, obstacles);
  const std::vector<StandingWord> standing = plan.standing().front();
  MarkLabels placed(standing);
  for (MarkWord& word : others) placed.add(std::move(word));
  placed.draw(picture, scene, theme.background, clip);
}

void draw_panel(Picture& picture, const Panels& panels, std::size_t i, const Pose& pose, Workspace& ws) {
  const Theme& theme = *panels.options.theme;
  const Rect scene = panels.scene(i), first = panels.scene(0);
  const int clip = int(picture.clips.size());
  picture.clips.push_back(scene);
  picture.add(
      Polygon{{Point{scene.x0, scene.y0}, {scene.x1, scene.y0}, {scene.x1, scene.y1}, {scene.x0, scene.y1}},
              4,
              {{}, theme.rule, size::kFrameLine}});
  const std::size_t framed = picture.items.size();
  Camera camera = panels.camera;
  camera.origin = camera.origin + Point{scene.x0 - first.x0, scene.y0 - first.y0};
  const std::vector<double> at_rest(std::size_t(panels.chain.nv), 0.0);
  compute_kinematics(panels.chain, ws, pose.q, at_rest);
  const ChainDrawing drawing{panels.chain, panels.skeleton, camera,
                             look_of(panels.skeleton, camera, theme, 1, panels.marks),
                             panels.options.shapes.get()};
  const Point tip = camera.project(tip_position(panels.chain, ws));
  EllipseStyle style{&theme, &panels.fonts,         panels.options.text_scale, panels.scale.per_unit(),
                     panels.picture(i),  panels.options.reading};
  MarkLabels labels;
  style.lines = panels.marks;
  // Small panels have no room for the lengths of semi-axes.
  if (panels.lines.empty() || panels.side() > kRoomForLengths * scaled(size::kTick, style.text_scale)) style.labels = &labels;
  if (!drawing.shapes) style.hole = link_end(drawing.look);
  if (drawing.shapes) style.hides = robot_hides(*drawing.shapes, ws, camera, tip_position(panels.chain, ws));
  const Camera seen = camera.seen_at(tip_position(panels.chain, ws));
  draw_base(picture, drawing, clip);
  style.part = EllipsePart::below;
  draw_mass_ellipse(picture, pose.axes, tip, seen, style, clip);
  draw_rails(picture, drawing, ws, clip);
  draw_links(picture, drawing, ws, clip);
  style.part = EllipsePart::above;
  draw_mass_ellipse(picture, pose.axes, tip, seen, style, clip);
  if (!drawing.shapes) draw_end_effector(picture, tip, drawing.look, clip);
  std::vector<Obstacle> bodies;
  if (drawing.shapes) add_bodies(bodies, panels.skeleton, ws, camera);
  draw_clear_of(picture, framed, labels, bodies, panels.picture(i), theme, clip);
  if (i < panels.options.labels.size()) {
    const TextStyle text{Face::label, scaled(size::kAxis, panels.options.text_scale), theme.ink, Align::left};
    draw_text(picture,
              fit_text(panels.fonts, panels.options.labels[i], text, scene.width() - 2 * kLabelInset,
                       panels.options.text_scale),
              {scene.x0 + kLabelInset, scene.y1 - kLabelInset - 0.75 * text.size}, clip);
  }
  const double text_scale = panels.options.text_scale;
  Rect caption{scene.x0, panels.places[i].y0, scene.x1, scene.y0};
  if (panels.options.letters) caption = draw_letter(picture, i, panels.words.size, caption, text_scale, theme, panels.fonts);
  if (!panels.lines.empty())
    for (std::size_t line = 0; line <= panels.below.size(); ++line)
      draw_caption_line(picture, (line == 0 ? panels.words.notations : panels.below[line - 1])[i], panels.words.size, caption, text_scale,
                        theme, panels.fonts, int(line));
  else
    draw_caption(picture, panels.words.notations[i], pose.effective, panels.words.size, caption, text_scale, theme, panels.fonts);
}

// How wide the text of a caption may be.
double caption_width(const Panels& panels) {
  const double letter = panels.options.letters ? 2.5 * scaled(size::kAxis, panels.options.text_scale) : 0;
  return panels.places[0].width() - letter;
}

bool has_matrices(const Panels& panels, const std::vector<Pose>& poses) {
  return poses.size() < kManyPoses && std::all_of(poses.begin(), poses.end(), [&](const Pose& pose) {
           return matrix_fits(pose.effective, caption_width(panels), panels.options.text_scale,
                              *panels.options.theme, panels.fonts);
         });
}

std::vector<std::optional<double>> masses_of(const Pose& pose) {
  std::vector<std::optional<double>> masses;
  for (const MassAxis& axis : mass_axes(pose.effective)) masses.push_back(axis.mass);
  return masses;
}

bool all_fit(const Panels& panels, const auto& notations) {
  return std::all_of(notations.begin(), notations.end(), [&](const std::string& notation) {
    return line_fits(notation, caption_width(panels), panels.options.text_scale, *panels.options.theme, panels.fonts);
  });
}

// Poses in as few lines as let each stand in its panel; nothing where one coordinate is wider. A line of each pose by panels.
std::vector<std::vector<std::string>> poses_in_lines(const Panels& panels, const std::vector<Pose>& poses) {
  const std::size_t coordinates = poses[0].q.size();
  for (std::size_t count = 2; count <= coordinates; ++count) {
    std::vector<std::vector<std::string>> lines;
    for (const Pose& pose : poses) {
      const std::vector<std::string> own = pose_in_lines(panels.chain, pose.q, (coordinates + count - 1) / count);
      lines.resize(own.size());
      for (std::size_t line = 0; line < own.size(); ++line) lines[line].push_back(own[line]);
    }
    if (std::all_of(lines.begin(), lines.end(), [&](const auto& line) { return all_fit(panels, line); })) return lines;
  }
  return {};
}

// The pose, and the masses: on one line, or on lines of their own, the pose on several, as far as they fit and leave pictures most of
// the cells; else the pose shortened.
void write_lines(Panels& panels, const std::vector<Pose>& poses) {
  const double cell = panels.places[0].height(), text_scale = panels.options.text_scale;
  std::vector<std::string> whole, alone, masses;
  for (const Pose& pose : poses) {
    panels.lines.push_back(line_notations(panels.chain, pose.q, masses_of(pose)));
    whole.push_back(panels.lines.back().front());
    alone.push_back(panels.lines.back()[1]);
  }
  panels.caption = caption_line_height(text_scale);
  panels.has_masses = true;
  if (all_fit(panels, whole)) return;
  for (std::vector<std::string>& forms : panels.lines) forms.erase(forms.begin());
  for (std::size_t form = 0; form < 2 && masses.empty(); ++form) {
    panels.has_bare_masses = form == 1;
    for (const Pose& pose : poses) masses.push_back(eigenvalues_notations(masses_of(pose))[form]);
    if (!all_fit(panels, masses)) masses.clear();
  }
  const std::vector<std::vector<std::string>> in_lines = all_fit(panels, alone) ? std::vector<std::vector<std::string>>{} : poses_in_lines(panels, poses);
  const auto has_room = [&](std::size_t below) { return cell - caption_line_height(text_scale, 1 + int(below)) >= kAboveLines * cell; };
  const std::size_t further = in_lines.empty() ? 0 : in_lines.size() - 1;
  const bool are_whole = further > 0 && has_room(further);
  if (are_whole) {
    panels.below.assign(in_lines.begin() + 1, in_lines.end());
    for (std::size_t i = 0; i < poses.size(); ++i) panels.lines[i] = {in_lines[0][i]};
  }
  panels.has_masses = !masses.empty() && has_room(panels.below.size() + 1);
  panels.has_bare_masses = panels.has_bare_masses && panels.has_masses;
  if (panels.has_masses) panels.below.push_back(masses);
  panels.caption = caption_line_height(text_scale, 1 + int(panels.below.size()));
}

// Where poses are too long to be written, the coordinates in which they differ: "q2 = 30\u00B0".
void name_what_differs(std::vector<std::vector<std::string>>& lines, const Panels& panels,
                       const std::vector<Pose>& poses) {
  std::vector<std::string> whole;
  for (const std::vector<std::string>& forms : lines) whole.push_back(forms.front());
  std::vector<std::size_t> differing;  // those coordinates
  for (std::size_t i = 0; i < poses[0].q.size(); ++i)
    if (std::any_of(poses.begin(), poses.end(), [&](const Pose& pose) { return pose.q[i] != poses[0].q[i]; }))
      differing.push_back(i);
  if (differing.empty() || all_fit(panels, whole)) return;
  std::vector<std::string> shorter;
  for (const Pose& pose : poses) {
    std::vector<std::string> parts;
    for (const std::size_t i : differing)
      parts.push_back("q" + std::to_string(i + 1) + " = " + coordinate_notations(panels.chain, pose.q)[i]);
    shorter.push_back(joined(parts));
  }
  if (differing.size() > 1 && !all_fit(panels, shorter)) return;
  for (std::size_t k = 0; k < lines.size(); ++k) lines[k] = {shorter[k]};
}

// Of one size in all panels.
CaptionLines words_of(const Panels& panels, const std::vector<Pose>& poses) {
  const PoseFigureOptions& options = panels.options;
  const double width = caption_width(panels);
  if (!panels.lines.empty()) {
    CaptionLines words = caption_lines(panels.lines, width, options.text_scale, *options.theme, panels.fonts);
    for (const std::vector<std::string>& line : panels.below)
      for (const std::string& one : line) {
        const CaptionLines further = caption_lines({{one}}, width, options.text_scale, *options.theme, panels.fonts);
        words.size = std::min(words.size, further.size);
        words.fit = words.fit && further.fit;
      }
    return words;
  }
  std::vector<std::vector<std::string>> forms;
  for (const Pose& pose : poses) forms.push_back(pose_notations(panels.chain, pose.q));
  CaptionLines words = caption_lines(forms, width, options.text_scale, *options.theme, panels.fonts);
  for (const Pose& pose : poses)
    words.size = std::min(words.size, mass_size(pose.effective, width, options.text_scale, *options.theme, panels.fonts));
  return words;
}

// Panels so many across; false where they are too small.
bool lay_out(Panels& panels, const Rect& area, int across, const std::vector<Pose>& poses, Workspace& ws) {
  const PoseFigureOptions& options = panels.options;
  panels.places = panels_of(area, int(poses.size()), across, gutter_of(panels.page));
  panels.caption = caption_height(int(poses[0].effective.basis.directions.size()), options.text_scale);
  if (!has_matrices(panels, poses)) {
    write_lines(panels, poses);
    if (panels.lines[0].size() > 1) name_what_differs(panels.lines, panels, poses);
  }
  if (!(panels.side() > std::min(kLeastSide * panels.page.height, kLeastEms * scaled(size::kAxis, options.text_scale)))) return false;
  panels.words = words_of(panels, poses);
  panels.marks = marks_in(panels.scene(0));
  panels.scale = scale_for(poses, panels.side(), options.reading);
  const Point shown = fit_panels(panels, poses, ws);
  const Rect scene = panels.scene(0);
  panels.filled = std::min(1.0, shown.x / scene.width()) * std::min(1.0, kept_height(panels, shown) / scene.height());
  return true;
}

bool has_cut_captions(const Panels& panels) {
  return std::any_of(panels.words.notations.begin(), panels.words.notations.end(),
                     [](const std::string& words) { return words.find("\u2026") != std::string::npos; });
}

// How good an arrangement is: chains and ellipses are large and fill the panels, no cell is empty, captions are whole, those of few
// poses have matrices, and of many panels each is mostly picture.
double merit(const Panels& panels) {
  constexpr double kEmptyCells = 1.4, kCutCaption = 0.5, kCollision = 0.01, kWithoutMatrix = 0.8;
  const auto in_top_row = std::count_if(panels.places.begin(), panels.places.end(), [&](const Rect& r) { return r.y1 == panels.places[0].y1; });
  const double count = double(panels.places.size()), across = double(in_top_row), cells = across * std::ceil(count / across);
  const bool is_picture =
      panels.lines.empty() || panels.scene(0).height() >= (panels.below.empty() ? kLeastPicture : kAboveLines) * panels.places[0].height();
  return (is_picture ? 1 : 0.1) * (1 - kEmptyCells * (cells - count) / cells) * (has_cut_captions(panels) ? kCutCaption : 1) *
         (panels.words.fit ? 1 : kCollision) *
         (panels.lines.empty() || panels.places.size() >= kManyPoses ? 1 : kWithoutMatrix) *
         std::sqrt(panels.filled * panels.camera.scale * panels.scale.per_unit());
}

}  // namespace

const std::vector<std::string>& figure_layout_names() {
  static const std::vector<std::string> names{"grid", "row", "superposed"};
  return names;
}

std::vector<Pose> poses_of(const TipMass& mass, const std::vector<std::vector<double>>& configurations,
                           const PoseFigureOptions& options, Workspace& ws) {
  const Chain& chain = mass.chain();
  std::vector<Pose> poses;
  for (const std::vector<double>& q : configurations) {
    Pose pose{q, mass.at(ws, q), {}};
    pose.axes = mass_axes(pose.effective);
    if (options.section) {
      const std::vector<double> at_rest(std::size_t(chain.nv), 0.0);
      compute_kinematics(chain, ws, q, at_rest);
      pose.axes = section_axes(pose.effective, tip_plane(chain, ws), options.reading);
    }
    poses.push_back(std::move(pose));
  }
  return poses;
}

std::vector<std::vector<double>> configurations_of(const std::vector<Pose>& poses) {
  std::vector<std::vector<double>> configurations;
  for (const Pose& pose : poses) configurations.push_back(pose.q);
  return configurations;
}

EllipseScale scale_for(const std::vector<Pose>& poses, double room, EllipseReading reading) {
  // Those of the curves that have an end, where there are any.
  const auto is_finite = [](const Pose& pose) { return !pose.axes.empty() && pose.axes.front().mass; };
  const bool any_finite = std::any_of(poses.begin(), poses.end(), is_finite);
  std::vector<double> bounded;
  for (const Pose& pose : poses) {
    const auto length = bounded_semi_axis(pose.axes, reading);
    if (length && *length > 0 && (is_finite(pose) || !any_finite)) bounded.push_back(*length);
  }
  if (bounded.empty()) return {1, 0.10, reading};
  std::nth_element(bounded.begin(), bounded.begin() + std::ptrdiff_t(bounded.size() / 2), bounded.end());
  const double median = bounded[bounded.size() / 2];
  double longest = median;
  for (const Pose& pose : poses) {
    // Velocities of equal energy are bounded everywhere.
    if (reading != EllipseReading::energy && !is_ordinary(pose.axes)) continue;
    for (const MassAxis& axis : pose.axes) longest = std::max(longest, semi_axis(axis, reading).value_or(0));
  }
  const double usual = reading == EllipseReading::energy ? kLargerAxis : kSmallerAxis;
  const double per_unit = room * std::min(usual / median, kLongestAxis / longest);
  const double bar = round_length(kLongestBar / per_unit);
  return {bar, bar * per_unit, reading};
}

Sheet sheet_of(const Chain& chain, const PoseFigureOptions& options, const EllipseScale& scale,
               const Fonts& fonts, double height, bool names_masses) {
  SheetText text;
  text.title = options.title;
  text.logo = logo_of(options);
  text.bar = scale.label();
  text.bar_length = scale.bar_length;
  text.legend = ellipse_legend(options.reading, chain.planar      ? EllipseBody::flat
                                                : options.section ? EllipseBody::section
                                                                  : EllipseBody::solid);
  if (names_masses) text.legend = text.legend.substr(0, text.legend.find(": ")) + ", eigenvalues of \u039B below";
  if (options.cell > 0) text.legend += "; cut where longer than its cell";
  text.legend_size = size::kTick;
  return lay_out_sheet(text, double(options.width) / options.height, options.text_scale, *options.theme,
                       fonts, height);
}

namespace {

// The best of all arrangements that there are; nothing where none has room.
std::optional<Panels> best_panels(const Chain& chain, const std::vector<Pose>& poses, const PageInUnits& page, const Fonts& fonts,
                                  Workspace& ws) {
  const PoseFigureOptions& options = page.options;
  // The scale follows from the size of the panels: they are laid out with the longest bar and label that may
  // come.
  const Rect area = sheet_of(chain, options, {0.005, kLongestBar, options.reading}, fonts, page.height).scene;
  std::optional<Panels> best;
  const int count = int(poses.size()), only = options.layout == "row" ? count : std::min(options.across, count);
  for (int across = std::max(only, 1); across <= (only > 0 ? only : count); ++across) {
    Panels panels{chain, page, fonts};
    if (lay_out(panels, area, across, poses, ws) && (!best || merit(panels) > merit(*best)))
      best.emplace(std::move(panels));
  }
  return best;
}

}  // namespace

PoseFigureFit fit_of_poses(const TipMass& mass, const std::vector<std::vector<double>>& configurations, const PoseFigureOptions& options,
                           const Fonts& fonts) {
  Workspace ws(mass.chain());
  const PageInUnits page = in_units(options);
  const std::optional<Panels> best = best_panels(mass.chain(), poses_of(mass, configurations, options, ws), page, fonts, ws);
  if (!best) return {};
  const double of_width = double(page.options.height) / options.width;
  return {best->camera.scale * of_width, best->scale.per_unit() * of_width, best->words.fit && !has_cut_captions(*best), best->has_masses,
          best->lines.empty()};
}

Picture draw_ellipse_figure(const TipMass& mass, const std::vector<std::vector<double>>& configurations,
                            const PoseFigureOptions& options, const Fonts& fonts) {
  const Chain& chain = mass.chain();
  if (configurations.empty()) throw Error(ExitCode::usage, "a figure needs at least one pose");
  Workspace ws(chain);
  const std::vector<Pose> poses = poses_of(mass, configurations, options, ws);
  if (options.cell > 0 || options.layout == "superposed")
    return draw_superposed(chain, poses, options, fonts);
  const PageInUnits page = in_units(options);
  std::optional<Panels> best = best_panels(chain, poses, page, fonts, ws);
  if (!best)
    throw Error(ExitCode::usage,
                "too many poses for one page: draw several figures, or take --layout superposed");
  if (!best->words.fit)
    throw Error(ExitCode::usage, "the words of " + std::to_string(poses.size()) + " poses have no room below panels this narrow: take fewer poses, "
                                 "a larger page, --layout grid or superposed");
  const Panels& panels = *best;
  cut_to_content(*best, sheet_of(chain, page.options, panels.scale, fonts, page.height).scene, poses, ws);

  Picture picture;
  picture.aspect = double(options.width) / page.options.height;
  picture.background = options.theme->background;
  for (std::size_t i = 0; i < poses.size(); ++i) draw_panel(picture, panels, i, poses[i], ws);
  draw_sheet(picture, sheet_of(chain, page.options, panels.scale, fonts, page.height, panels.has_bare_masses));
  return in_page_units(picture, page.height);
}

}  // namespace chainreel
