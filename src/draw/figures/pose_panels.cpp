#include "draw/figures/pose_panels.hpp"

#include <algorithm>
#include <cmath>

#include "core/format.hpp"
#include "draw/page/panel_grid.hpp"
#include "draw/robot/chain.hpp"
#include "draw/robot/chain_fit.hpp"
#include "draw/robot/joints.hpp"
#include "draw/robot/view.hpp"
#include "dynamics/kinematics.hpp"

namespace chainreel {
namespace {

constexpr double kLeastPicture = 0.7, kAboveLines = 0.55;  // of the cell of one of many, above a caption of one line, and of several
constexpr double kOfSemiAxis = 0.55;  // half of a link's width at most, of the shortest semi-axis: ellipses are seen beside their links
constexpr double kLeastSide = 0.08, kLeastEms = 5;  // of a panel that can be read: units of H, or of its words on tall pages

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

}  // namespace

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

namespace {

// How wide the text of a caption may be.
double caption_width(const Panels& panels) {
  const double letter = panels.options.letters ? 2.5 * scaled(size::kAxis, panels.options.text_scale) : 0;
  return panels.words_box(0).width() - letter;
}

bool has_matrices(const Panels& panels, const std::vector<Pose>& poses) {
  return poses.size() < kManyPoses && std::all_of(poses.begin(), poses.end(), [&](const Pose& pose) {
           return matrix_fits(pose.effective, caption_width(panels), panels.options.text_scale,
                              *panels.options.theme, panels.fonts);
         });
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
    panels.lines.push_back(line_notations(panels.chain, pose.q, masses_of(pose.effective)));
    whole.push_back(panels.lines.back().front());
    alone.push_back(panels.lines.back()[1]);
  }
  panels.caption = caption_line_height(text_scale);
  panels.has_masses = true;
  if (all_fit(panels, whole)) return;
  // On one line by short names, which the sheet explains; without any where these have no room.
  for (const auto& [pose, form] : {std::pair{1, 1}, {2, 1}, {2, 2}}) {
    std::vector<std::string> bare;
    for (std::size_t i = 0; i < poses.size(); ++i)
      bare.push_back(panels.lines[i][std::size_t(pose)] + (form == 1 ? ", " : ": ") + eigenvalues_notations(masses_of(poses[i].effective))[std::size_t(form)]);
    if (!all_fit(panels, bare)) continue;
    panels.under = pose == 1 ? UnderPoses::masses : UnderPoses::poses_and_masses;
    for (std::size_t i = 0; i < poses.size(); ++i) panels.lines[i] = {bare[i]};
    return;
  }
  for (std::vector<std::string>& forms : panels.lines) forms.erase(forms.begin());
  for (std::size_t form = 0; form < 3 && masses.empty(); ++form) {
    panels.under = form == 0 ? UnderPoses::named : UnderPoses::masses;
    for (const Pose& pose : poses) masses.push_back(eigenvalues_notations(masses_of(pose.effective))[form]);
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
  if (!panels.has_masses) panels.under = UnderPoses::named;
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

// The shortest semi-axis that is drawn, units of H.
double shortest_drawn(const Panels& panels, const std::vector<Pose>& poses) {
  double shortest = HUGE_VAL;
  for (const Pose& pose : poses)
    for (const MassAxis& axis : pose.axes)
      if (const auto length = semi_axis(axis, panels.options.reading); length && *length > 0)
        shortest = std::min(shortest, *length * panels.scale.per_unit());
  return shortest;
}

// The longest axis by which ellipses are scaled, units of H.
double longest_drawn(const Panels& panels, const std::vector<Pose>& poses) {
  return 2 * longest_semi_axis(poses, panels.options.reading) * panels.scale.per_unit();
}

// Returns the size of what the panels show. Beside ellipses much longer than the whole chain, as small panels would have them, it would
// be a dwarf: they are drawn smaller.
Point fit_ellipses(Panels& panels, const std::vector<Pose>& poses, Workspace& ws) {
  constexpr double kOfReach = 1.1, kNearly = 1.02;
  constexpr int kRounds = 8;
  Point shown = fit_panels(panels, poses, ws);
  for (int round = 0; round < kRounds; ++round) {
    const double longest = longest_drawn(panels, poses), most = kOfReach * panels.camera.scale * panels.skeleton.reach;
    if (longest <= kNearly * most) break;
    panels.scale = scale_of(panels.scale.per_unit() * std::sqrt(most / longest), panels.options.reading);  // the chain grows meanwhile
    shown = fit_panels(panels, poses, ws);
  }
  panels.widest_link = std::max(kThinnestLink, 2 * kOfSemiAxis * shortest_drawn(panels, poses));
  return shown;
}

// Poses and matrices beside their scenes, where these keep the larger part of the cells.
bool put_words_beside(Panels& panels, const std::vector<Pose>& poses) {
  constexpr double kMostBeside = 0.5, kAirEms = 2;
  const PoseFigureOptions& options = panels.options;
  double widest = 0;
  for (const Pose& pose : poses)
    widest = std::max(widest, usual_width(pose_notations(panels.chain, pose.q).front(), pose.effective, options.text_scale, *options.theme, panels.fonts));
  panels.beside = widest + (kAirEms + (options.letters ? 2.5 : 0)) * scaled(size::kAxis, options.text_scale);
  return panels.beside <= kMostBeside * panels.places[0].width() && panels.caption <= panels.places[0].height() && has_matrices(panels, poses);
}

// Panels so many across; false where they are too small.
bool lay_out(Panels& panels, const Rect& area, int across, bool beside, const std::vector<Pose>& poses, Workspace& ws) {
  const PoseFigureOptions& options = panels.options;
  panels.places = panels_of(area, int(poses.size()), across, gutter_of(panels.page));
  panels.caption = caption_height(int(poses[0].effective.basis.directions.size()), options.text_scale);
  if (beside && !put_words_beside(panels, poses)) return false;
  if (!has_matrices(panels, poses)) {
    write_lines(panels, poses);
    if (panels.lines[0].size() > 1) name_what_differs(panels.lines, panels, poses);
  }
  if (!(panels.side() > std::min(kLeastSide * panels.page.height, kLeastEms * scaled(size::kAxis, options.text_scale)))) return false;
  panels.words = words_of(panels, poses);
  panels.marks = marks_in(panels.scene(0));
  panels.scale = scale_for(poses, panels.side(), options.reading);
  const Point shown = fit_ellipses(panels, poses, ws);
  const Rect scene = panels.scene(0);
  panels.filled = std::min(1.0, shown.x / scene.width()) * std::min(1.0, kept_height(panels, shown) / scene.height());
  return true;
}

}  // namespace

bool has_lengths(const Panels& panels) {
  constexpr double kRoom = 10;  // of the em of their words: the side of a panel
  return panels.lines.empty() || panels.side() > kRoom * scaled(size::kTick, panels.options.text_scale);
}

bool tells_lengths_below(const Panels& panels) {
  return !panels.lines.empty() && panels.has_masses && panels.options.reading == EllipseReading::mass;
}

bool is_mostly_picture(const Panels& panels) {
  return panels.lines.empty() || panels.scene(0).height() >= (panels.below.empty() ? kLeastPicture : kAboveLines) * panels.places[0].height();
}

bool has_cut_captions(const Panels& panels) {
  return std::any_of(panels.words.notations.begin(), panels.words.notations.end(),
                     [](const std::string& words) { return words.find("\u2026") != std::string::npos; });
}

namespace {

// How good an arrangement is: chains and ellipses are large and fill the panels, no cell is empty, captions are whole, those of few
// poses have matrices, and of many panels each is mostly picture.
double merit(const Panels& panels) {
  constexpr double kEmptyCells = 1.4, kCutCaption = 0.5, kCollision = 0.01, kWithoutMatrix = 0.8, kWithoutLengths = 0.6;
  const auto in_top_row = std::count_if(panels.places.begin(), panels.places.end(), [&](const Rect& r) { return r.y1 == panels.places[0].y1; });
  const double count = double(panels.places.size()), across = double(in_top_row), cells = across * std::ceil(count / across);
  return (is_mostly_picture(panels) ? 1 : 0.1) * (1 - kEmptyCells * (cells - count) / cells) * (has_cut_captions(panels) ? kCutCaption : 1) *
         (panels.words.fit ? 1 : kCollision) * (has_lengths(panels) ? 1 : kWithoutLengths) *
         (panels.lines.empty() || panels.places.size() >= kManyPoses ? 1 : kWithoutMatrix) *
         std::sqrt(panels.filled * panels.camera.scale * panels.scale.per_unit());
}

}  // namespace

std::optional<Panels> best_panels(const Chain& chain, const std::vector<Pose>& poses, const PageInUnits& page, const Fonts& fonts,
                                  Workspace& ws) {
  const PoseFigureOptions& options = page.options;
  // The scale follows from the size of the panels: they are laid out with the longest bar and label that may
  // come.
  const auto area_of = [&](UnderPoses under) {
    return sheet_of(chain, options, {0.005, kLongestBar, options.reading}, fonts, page.height, under).scene;
  };
  const Rect area = area_of(UnderPoses::named), above_masses = area_of(UnderPoses::poses_and_masses);  // words that name the masses may take a line of their own
  std::optional<Panels> best;
  const int count = int(poses.size()), only = options.layout == "row" ? count : std::min(options.across, count);
  for (int across = std::max(only, 1); across <= (only > 0 ? only : count); ++across)
    for (const bool beside : {false, true}) {
      for (const Rect& above : {area, above_masses}) {
        Panels panels{chain, page, fonts};
        if (!lay_out(panels, above, across, beside, poses, ws)) break;
        if (panels.under != UnderPoses::named && above.y0 < above_masses.y0) continue;
        if (!best || merit(panels) > merit(*best)) best.emplace(std::move(panels));
        break;
      }
    }
  return best;
}

}  // namespace chainreel
