// All poses in one place: onion skins below, ellipses above; or a field of ellipses over the workspace.
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string>

#include "core/error.hpp"
#include "core/format.hpp"
#include "draw/figures/caption.hpp"
#include "draw/figures/ellipse_figure.hpp"
#include "draw/figures/pose_labels.hpp"
#include "draw/layers/body_obstacles.hpp"
#include "draw/layers/ellipsoid.hpp"
#include "draw/layers/fading.hpp"
#include "draw/page/mark_labels.hpp"
#include "draw/page/scales.hpp"
#include "draw/robot/chain.hpp"
#include "draw/robot/chain_fit.hpp"
#include "draw/robot/joints.hpp"
#include "draw/robot/view.hpp"
#include "dynamics/kinematics.hpp"

namespace chainreel {
namespace {

constexpr double kPathLine = 0.0018, kPathOpacity = 0.35;
constexpr int kFewPoses = 3;           // more share the room of so many
constexpr double kLeastRoom = 0.4;     // of the page for an ellipse, however many there are
constexpr double kInCell = 0.46;       // of a cell's side: the circle that holds what is seen of its ellipse
constexpr double kMostWhole = 0.7;     // of a field's ellipses have their long axes inside of their cells
constexpr double kCellOfFullLines = 0.2, kThinnestLines = 0.5;  // units of H; of the style guide's widths
constexpr double kOpenReach = 0.2;     // of the room's shorter side: as far lead ellipses that are open, of several poses
constexpr double kOpenBreadth = 0.25;  // of that: they are no broader to each side
constexpr double kOfSign = 2;          // of their size: signs of infinity that are no farther apart are one
constexpr double kMassesPitch = 1.35;  // of the em of a name: the masses below it
constexpr double kSamePlace = 0.006;   // units of H: poses whose links and ellipses are no farther apart are one
constexpr double kSmallestCell = 0.02;  // units of H: below, ellipses cannot be read

// The pose whose ellipse is nearest to a circle.
std::size_t roundest(const std::vector<Pose>& poses) {
  const auto ratio = [](const Pose& pose) {
    const auto longest = pose.axes.front().mass, shortest = pose.axes.back().mass;
    return longest && shortest ? *shortest / *longest : 0;
  };
  std::size_t best = 0;
  for (std::size_t i = 1; i < poses.size(); ++i)
    if (ratio(poses[i]) > ratio(poses[best])) best = i;
  return best;
}

// Of an ellipse that is open the longest axis that is not, 0 without one; nothing of others.
std::optional<double> finite_of_open(const Pose& pose, EllipseReading reading) {
  double longest = 0;
  bool is_open = false;
  for (const MassAxis& axis : pose.axes) {
    const std::optional<double> length = semi_axis(axis, reading);
    is_open = is_open || !length;
    longest = std::max(longest, length.value_or(0));
  }
  return is_open ? std::optional(longest) : std::nullopt;
}

// Most of the long axes just fill their cells.
EllipseScale field_scale(const std::vector<Pose>& poses, double cell, EllipseReading reading) {
  std::vector<double> longest;
  for (const Pose& pose : poses) {
    double most = 0;
    for (const MassAxis& axis : pose.axes)
      most = std::max(most, semi_axis(axis, reading).value_or(std::numeric_limits<double>::infinity()));
    longest.push_back(most);
  }
  const auto at = longest.begin() + std::ptrdiff_t(kMostWhole * double(longest.size() - 1));
  std::nth_element(longest.begin(), at, longest.end());
  double fits = *at;
  if (!std::isfinite(fits) || !(fits > 0)) {
    fits = 0;
    for (const double length : longest) fits = std::isfinite(length) ? std::max(fits, length) : fits;
    if (!(fits > 0)) fits = 1;
  }
  const double per_unit = kInCell * cell / fits;
  const double bar = round_length(kLongestBar / per_unit);
  return {bar, bar * per_unit, reading};
}

struct Overlay {
  const Chain& chain;
  const std::vector<Pose>& poses;
  const PoseFigureOptions& options;
  const Fonts& fonts;
  Workspace ws;
  Skeleton skeleton;
  Camera camera;
  EllipseScale scale;
  MarkLabels numbers;  // of semi-axes
  bool names_masses = false;  // with the names of poses, not at the axes
  int unnamed = 0;            // then: axes without numbers
  bool is_filled = true;      // not where ellipses lie over one another

  Overlay(const Chain& c, const std::vector<Pose>& p, const PoseFigureOptions& o, const Fonts& f)
      : chain(c), poses(p), options(o), fonts(f), ws(c), skeleton(skeleton_of(c)), camera(view_of(c, o.camera)) {
    for (const Pose& pose : poses) widen_rails(skeleton, chain, pose.q, kNoLimit);
  }

  bool is_field() const { return options.cell > 0; }
  void stand_in(const Pose& pose) {
    const std::vector<double> at_rest(std::size_t(chain.nv), 0.0);
    compute_kinematics(chain, ws, pose.q, at_rest);
  }

  void fit(const Rect& scene) {
    const MotionBox motion =
        box_around(chain, skeleton, options.shapes.get(), ws, configurations_of(poses));
    camera = aimed_camera(chain, options.camera, motion, scene,
                          [&](Camera& seen) { fit_camera(seen, scene); });
  }

  void fit_camera(Camera& seen, const Rect& scene) {
    ChainFit box(chain, skeleton, seen, 1, options.shapes.get());
    const double side = std::min(scene.width(), scene.height());
    for (std::size_t i = 0; i < poses.size(); ++i) {
      stand_in(poses[i]);
      const Eigen::Vector3d tip = tip_position(chain, ws);
      if (!is_field()) {
        box.add_pose(ws, kNoLimit);
        box.add(tip, room_of(poses[i].axes, seen.seen_at(tip), scale, kLongestAxis * side));
        continue;
      }
      if (i == 0) box.add_pose(ws, kNoLimit);
      for (const double sx : {-0.5, 0.5})
        for (const double sy : {-0.5, 0.5})
          box.add(tip + options.cell * (sx * seen.right + sy * seen.up), {});
    }
    for (const Eigen::Vector3d& place : options.path) box.add(place, {});
    fit_to(seen, box.box(), scene, size::kFitMargin);
  }

  void draw_chain(Picture& picture, const Pose& pose, double strength) {
    stand_in(pose);
    const ChainDrawing drawing{chain, skeleton, camera, look_of(skeleton, camera, *options.theme, strength),
                               options.shapes.get()};
    draw_rails(picture, drawing, ws, kSceneClip);
    draw_links(picture, drawing, ws, kSceneClip);
  }

  void draw_path(Picture& picture) const {
    if (options.path.size() < 2) return;
    Trail trail;
    trail.color = options.theme->ink;
    for (const Eigen::Vector3d& place : options.path)
      trail.points.push_back({camera.project(place), kPathLine, kPathOpacity});
    picture.add(std::move(trail), kSceneClip);
  }

  void draw_ellipse(Picture& picture, const Pose& pose, const Rect& scene, EllipsePart part, bool signs = true) {
    stand_in(pose);
    const Eigen::Vector3d place = tip_position(chain, ws);
    const Point tip = camera.project(place);
    EllipseStyle style{options.theme, &fonts, options.text_scale, scale.per_unit(), scene, options.reading};
    style.part = part;
    style.is_filled = is_filled;
    style.signs = signs;
    if (names_masses) style.unnamed = &unnamed;
    if (part == EllipsePart::above && !names_masses) style.labels = &numbers;
    if (!options.shapes && !is_field()) style.hole = link_end(look_of(skeleton, camera, *options.theme));
    style.outward = last_link(skeleton, ws, camera);
    if (options.shapes) style.hides = robot_hides(*options.shapes, ws, camera, place);
    if (is_open(pose)) style.disc = reach_of_open(scene);
    int clip = kSceneClip;
    if (is_field()) {
      const double side = options.cell * camera.scale, half = side / 2;
      style.scene = {tip.x - half, tip.y - half, tip.x + half, tip.y + half};
      style.fade = half / 2;  // of belts
      style.disc = kInCell * side;
      style.signs = false;
      style.dashed_cut = true;
      style.lines = std::clamp(side / kCellOfFullLines, kThinnestLines, 1.0);
      clip = int(picture.clips.size());
      picture.clips.push_back(style.scene);
    }
    draw_mass_ellipse(picture, pose.axes, tip, camera.seen_at(place), style, clip);
  }

  // What is seen of a pose: its numbers, and where on the page its links and its ellipse are.
  struct Seen {
    std::string numbers;
    std::vector<Point> marks;
    bool is_as(const Seen& other) const {
      const auto is_near = [](Point a, Point b) { return norm(a - b) <= kSamePlace; };
      return numbers == other.numbers && std::ranges::equal(marks, other.marks, is_near);
    }
  };
  Seen seen_of(const Pose& pose) {
    stand_in(pose);
    Seen seen;
    for (const MassAxis& axis : pose.axes) {
      const std::optional<double> length = semi_axis(axis, options.reading);
      seen.numbers += (length ? format_digits(*length, 3) : "inf") + " ";
    }
    for (const LinkSegment& link : skeleton.links)
      for (const Eigen::Vector3d& end : {link.from, link.to}) seen.marks.push_back(camera.project(pose_of(ws, link.body) * end));
    const Eigen::Vector3d tip = tip_position(chain, ws);
    // An axis has no sign.
    for (const Point axis : curve_of(pose, camera.seen_at(tip))) seen.marks.push_back(std::abs(axis.x) > std::abs(axis.y) ? std::copysign(1.0, axis.x) * axis : std::copysign(1.0, axis.y) * axis);
    seen.marks.push_back(camera.project(tip));
    return seen;
  }

  // Of poses that look the same, as of a motion there and back, the first, with the indices of all.
  std::vector<std::vector<std::size_t>> looks() {
    std::vector<std::vector<std::size_t>> groups;
    std::vector<Seen> seen;
    for (std::size_t i = 0; i < poses.size(); ++i) {
      Seen own = seen_of(poses[i]);
      const auto same = std::ranges::find_if(seen, [&](const Seen& one) { return one.is_as(own); });
      if (same != seen.end()) {
        groups[std::size_t(same - seen.begin())].push_back(i);
        continue;
      }
      groups.push_back({i});
      seen.push_back(std::move(own));
    }
    return groups;
  }

  bool is_open(const Pose& pose) const { return poses.size() > 1 && finite_of_open(pose, options.reading); }
  double reach_of_open(const Rect& scene) const { return kOpenReach * std::min(scene.width(), scene.height()); }

  // What is seen of it.
  NamedPlace place_of(const Pose& pose, const Rect& scene) {
    stand_in(pose);
    const Eigen::Vector3d tip = tip_position(chain, ws);
    NamedPlace place{camera.project(tip), {}, curve_of(pose, camera.seen_at(tip))};
    if (const double length = norm(place.curve[0]); is_open(pose) && length > reach_of_open(scene))
      place.curve[0] = (reach_of_open(scene) / length) * place.curve[0];
    return place;
  }

  // For each look whether it has signs of infinity: of several open ellipses close to one another the first alone.
  std::vector<bool> signs_of(const std::vector<std::vector<std::size_t>>& groups, const Rect& scene) {
    std::vector<bool> has_signs;
    std::vector<Point> ends;
    for (const std::vector<std::size_t>& group : groups) {
      const NamedPlace place = place_of(poses[group.front()], scene);
      // An axis has no sign: its upper end.
      const Point end = place.tip + (place.curve[0].y < 0 ? -1 : 1) * place.curve[0];
      const double apart = kOfSign * size::kSymbol * options.text_scale;
      has_signs.push_back(std::ranges::none_of(ends, [&](Point other) { return norm(other - end) < apart; }));
      if (is_open(poses[group.front()]) && has_signs.back()) ends.push_back(end);
    }
    return has_signs;
  }

  bool do_overlap(const std::vector<std::vector<std::size_t>>& groups, const Rect& scene) {
    std::vector<NamedPlace> places;
    for (const std::vector<std::size_t>& group : groups) places.push_back(place_of(poses[group.front()], scene));
    for (std::size_t i = 0; i < places.size(); ++i)
      for (std::size_t j = 0; j < i; ++j)
        if (curves_overlap(places[i], places[j])) return true;
    return false;
  }

  // Each pose by its name, or its q, near its end effector or an end of its ellipse; a line leads there where names stand closely.
  void draw_labels(Picture& picture, const Rect& scene, const std::vector<std::vector<std::size_t>>& groups) {
    std::vector<NamedPlace> places;
    std::vector<Bar> bars;
    for (const std::vector<std::size_t>& group : groups) {
      const std::size_t i = group.front();
      places.push_back(place_of(poses[i], scene));
      places.back().name = label_of(group, Align::left);
      for (const LinkSegment& link : options.shapes ? std::vector<LinkSegment>() : skeleton.links)
        bars.push_back({camera.project(pose_of(ws, link.body) * link.from), camera.project(pose_of(ws, link.body) * link.to),
                        size::kLinkWidth / 2});
    }
    for (const Obstacle& body : bodies()) bars.push_back({body.a, body.b, body.radius});
    const std::vector<PlacedName> placed = place_names(places, bars, scene, obstacles_of(picture));
    std::vector<StandingWord> plan;
    for (const PlacedName& one : placed) plan.push_back(one.word);
    MarkLabels labels(plan);
    for (std::size_t i = 0; i < places.size(); ++i) {
      const Rect& box = placed[i].word.box;
      const bool ends_at_line = placed[i].has_leader && (box.x0 + box.x1) / 2 < placed[i].to.x;
      MarkWord word{"pose", ends_at_line ? label_of(groups[i], Align::right) : places[i].name, {box}};
      if (placed[i].has_leader) word.leader = Leader{placed[i].to, options.theme->ink};
      labels.add(std::move(word));
    }
    labels.draw(picture, scene, options.theme->background, kSceneClip);
  }

  // Its semi-axes on the page; open ones lead beyond it.
  std::array<Point, 2> curve_of(const Pose& pose, const Camera& seen) const {
    Spread spread;
    for (const MassAxis& axis : pose.axes) {
      const double length = std::min(semi_axis(axis, options.reading).value_or(kLongest) * scale.per_unit(), kLongest);
      spread.add(length * Point{seen.right.dot(axis.direction), seen.up.dot(axis.direction)});
    }
    return spread.axes();
  }

  // Robots in space of all poses.
  std::vector<Obstacle> bodies() {
    std::vector<Obstacle> found;
    for (const Pose& pose : poses) {
      if (!options.shapes || is_field()) break;
      stand_in(pose);
      add_silhouettes(found, *options.shapes, ws, camera);
    }
    return found;
  }

  // By the names of all that look so; else by the pose. Below it the masses, where its axes do not tell them.
  // Both end at the right where a line to the pose begins there, so that it meets either.
  TextLine label_of(const std::vector<std::size_t>& group, Align align) const {
    const TextStyle style{Face::label, scaled(size::kAxis, options.text_scale), options.theme->ink, Align::left};
    std::vector<std::string> names;
    for (const std::size_t i : group)
      if (i < options.labels.size()) names.push_back(options.labels[i]);
    const Pose& pose = poses[group.front()];
    TextLine label = names.empty() ? lay_out_math(fonts, pose_notations(chain, pose.q).front(), style) : lay_out_text(fonts, joined(names), style);
    if (!names_masses) return label;
    const TextStyle small{Face::label, scaled(size::kTick, options.text_scale), options.theme->ellipse, Align::left};
    TextLine masses = lay_out_text(fonts, masses_of(pose), small);
    const double wide = std::max(label.advance, masses.advance);
    const auto moved_by = [](TextLine& line, Point by) {
      for (GlyphRun& run : line.runs) run.origin = run.origin + by;
      line.box = moved(line.box, by);
    };
    const bool is_right = align == Align::right && label.marks.empty();
    moved_by(masses, {is_right ? wide - masses.advance : 0, -kMassesPitch * style.size});
    moved_by(label, {is_right ? wide - label.advance : 0, 0});
    label.runs.insert(label.runs.end(), masses.runs.begin(), masses.runs.end());
    label.box = around(label.box, masses.box);
    label.advance = wide;
    return label;
  }

  // "3.36, 0.85 kg": the lengths of its semi-axes.
  std::string masses_of(const Pose& pose) const {
    std::vector<std::string> lengths;
    for (const MassAxis& axis : pose.axes) {
      const std::optional<double> length = semi_axis(axis, options.reading);
      lengths.push_back(length ? format_digits(*length, 3) : "\u221E");
    }
    if (options.reading == EllipseReading::energy) std::ranges::reverse(lengths);  // what is heavy is slow: the longest first
    return joined(lengths) + (options.reading == EllipseReading::energy ? " m/s" : " kg");
  }

  // All poses that look different, with their names, on what is drawn; how many numbers have no room.
  int draw_poses(Picture& picture, const Rect& room) {
    numbers = {};
    const std::vector<std::vector<std::size_t>> groups = looks();
    const std::vector<bool> signs = signs_of(groups, room);
    is_filled = !do_overlap(groups, room);
    for (std::size_t i = 0; i < groups.size(); ++i) draw_ellipse(picture, poses[groups[i].front()], room, EllipsePart::below, signs[i]);
    for (const auto& group : groups) draw_chain(picture, poses[group.front()], kOnionSkin);
    for (std::size_t i = 0; i < groups.size(); ++i) draw_ellipse(picture, poses[groups[i].front()], room, EllipsePart::above, signs[i]);
    for (const auto& group : groups) {
      if (options.shapes) break;
      stand_in(poses[group.front()]);
      draw_end_effector(picture, camera.project(tip_position(chain, ws)), look_of(skeleton, camera, *options.theme), kSceneClip);
    }
    if (poses.size() > 1) draw_labels(picture, room, groups);
    return draw_clear_of(picture, 0, numbers, bodies(), room, *options.theme, kSceneClip, poses.size() > 1);
  }
};

}  // namespace

Picture draw_superposed(const Chain& chain, const std::vector<Pose>& poses, const PoseFigureOptions& options,
                        const Fonts& fonts, int* numbers_left_out) {
  Overlay overlay(chain, poses, options, fonts);
  const Rect room = sheet_of(chain, options, {0.005, kLongestBar, options.reading}, fonts).scene;
  const double share = std::max(kLeastRoom, std::min(1.0, std::sqrt(double(kFewPoses) / double(poses.size()))));
  const double side = std::min(room.width(), room.height());
  overlay.scale = scale_for(poses, share * side, options.reading);
  for (const Pose& pose : poses)
    if (const double open = finite_of_open(pose, options.reading).value_or(0); poses.size() > 1 && open * overlay.scale.per_unit() > kOpenBreadth * kOpenReach * side)
      overlay.scale = scale_of(kOpenBreadth * kOpenReach * side / open, options.reading);
  overlay.fit(room);
  if (overlay.is_field()) {
    const double cell = options.cell * overlay.camera.scale;
    if (cell < kSmallestCell)
      throw Error(ExitCode::usage, "so many ellipses get too small to be read: take fewer --samples");
    overlay.scale = field_scale(poses, cell, options.reading);
  }
  const Sheet sheet = sheet_of(chain, options, overlay.scale, fonts);

  Picture picture;
  picture.aspect = sheet.aspect;
  picture.background = options.theme->background;
  picture.clips = {room};
  overlay.draw_path(picture);
  draw_base(picture,
            {chain, overlay.skeleton, overlay.camera,
             look_of(overlay.skeleton, overlay.camera, *options.theme), options.shapes.get()},
            kSceneClip);
  int left_out = 0;
  if (overlay.is_field()) {
    overlay.draw_chain(picture, poses[roundest(poses)], kOnionSkin);
    for (const Pose& pose : poses) overlay.draw_ellipse(picture, pose, room, EllipsePart::whole);
  } else {
    Picture with_numbers = picture;
    left_out = overlay.draw_poses(with_numbers, room);
    // Where some have no room at their axes, all stand with the names.
    overlay.names_masses = left_out > 0 && poses.size() > 1;
    if (overlay.names_masses) left_out = overlay.draw_poses(picture, room);
    else picture = std::move(with_numbers);
  }
  if (numbers_left_out != nullptr) *numbers_left_out = left_out;
  Sheet inside = sheet;
  inside.scene = room;
  if (overlay.is_field()) draw_metre_bar(picture, overlay.camera, inside, fonts);
  draw_sheet(picture, sheet);
  return picture;
}

}  // namespace chainreel
