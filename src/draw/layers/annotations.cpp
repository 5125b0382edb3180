// Words of `annotate:` with a line to what they speak of, which stand at one place of the page while that moves on; and those that films have
// by themselves (callouts).
#include <algorithm>
#include <array>
#include <cmath>

#include "core/error.hpp"
#include "core/format.hpp"
#include "draw/layers/callouts.hpp"
#include "draw/layers/layer.hpp"
#include "draw/page/wrapped_words.hpp"
#include "draw/robot/view.hpp"
#include "dynamics/kinematics.hpp"
#include "picture/point.hpp"
#include "scene/annotation.hpp"
#include "scene/run/title.hpp"

namespace chainreel {
namespace {

constexpr double kSame = 1e-9;  // s
// Of the width of their panel: longer words are broken into lines, the fewer the better.
constexpr double kWidths[] = {0.62, 0.42, 0.28};
constexpr double kShortLine = 12;  // em: a line so short is not broken for a better place
constexpr double kFarPlaces[] = {0.09, 0.14, 0.20, 0.28};  // of words from what they speak of, units of H
constexpr double kAirOfWords = 0.008;  // to the edge of their panel, units of H
constexpr int kAnywhere = 5;  // columns, and rows, of places all over the panel, for where there is no room near

class Annotations : public Layer {
 public:
  explicit Annotations(const Stage& stage) : stage_(&stage), callouts_(stage) {
    std::vector<RunEvents> panels;
    for (const StagedRun& motion : stage.motions) panels.push_back({&motion.scene().events, &motion.trajectory().events});
    for (std::size_t i = 0; i < stage.page.annotate.size(); ++i) {
      const AnnotationEntry& entry = stage.page.annotate[i];
      const std::optional<double> at = instant_of(entry, panels);
      // What comes behind the last frame, as at the very end, is told on it.
      if (!at) continue;
      const StagedRun& motion = motion_of(entry);
      const std::string text = filled_words(entry.text, motion.scene(), motion.trajectory());
      notes_.push_back({&entry, int(i) + 1, std::min(*at, stage.times.back()), text, lay_out(entry, text)});
    }
  }

  UnderWords under_words() const override { return UnderWords::freely; }
  bool has_words() const override { return !notes_.empty() || !callouts_.empty(); }

  void draw(Picture&, const Shot& shot) const override {
    for (const Note& note : notes_)
      if (is_of_panel(note, shot.panel) && is_shown(note, stage_->times[std::size_t(shot.k)]))
        add_words(note, shot);
    callouts_.draw(shot);
  }

 private:
  struct Note {
    const AnnotationEntry* entry;
    int number;
    double at;  // s of the motion
    std::string text;
    TextLine line;
  };

  TextStyle style() const {
    return {Face::label, scaled(size::kSymbol, stage_->page.text_scale), stage_->theme.ink, Align::left};
  }

  TextLine lay_out(const AnnotationEntry& entry, const std::string& text) const {
    try {
      return lay_out_words(stage_->fonts, text, style());
    } catch (const Error& error) {
      throw Error(error.code(), error.problems().front().message, entry.place);
    }
  }

  // What is drawn over the first panel in outline has its words there, too.
  bool is_of_panel(const Note& note, const Panel& panel) const {
    return stage_->is_ghost() ? panel.clip() == 0 : note.entry->panel == panel.clip() + 1;
  }

  const StagedRun& motion_of(const AnnotationEntry& entry) const {
    return stage_->motions[std::min(std::size_t(entry.panel), stage_->motions.size()) - 1];
  }

  bool is_shown(const Note& note, double t) const {
    const double begin = stage_->clock.film_time(note.at), now = stage_->clock.film_time(t);
    return now >= begin - kSame && now <= begin + seconds_shown(*note.entry) + kSame;
  }

  // Half way to what it carries farthest off, a joint or a frame; the base where it stands.
  static Eigen::Vector3d middle_of(const Chain& chain, int body) {
    Eigen::Vector3d farthest = Eigen::Vector3d::Zero();
    const auto look = [&farthest](const Eigen::Vector3d& at) {
      if (at.norm() > farthest.norm()) farthest = at;
    };
    for (const Body& other : chain.bodies)
      if (body > 0 && other.parent == body) look(other.joint.X_PJ.translation());
    for (const Frame& frame : chain.frames)
      if (body > 0 && frame.body == body) look(frame.X_BF.translation());
    return 0.5 * farthest;
  }

  // What is spoken of, in W, at a sample of its motion.
  static Eigen::Vector3d point_of(const AnnotationEntry& entry, const StagedRun& motion, const Camera& camera, int k) {
    if (entry.spot.size() == 3) return {entry.spot[0], entry.spot[1], entry.spot[2]};
    if (entry.spot.size() == 2) return entry.spot[0] * camera.right + entry.spot[1] * camera.up;
    const Chain& chain = motion.chain();
    const Workspace& ws = motion.pose_at(k);
    const int frame = find_point(chain, motion.scene(), entry.point);
    const Body& body = chain.bodies[std::size_t(chain.frames[std::size_t(frame)].body)];
    const Eigen::Isometry3d pose = frame_pose(chain, ws, frame);
    // A link is meant where it is, not where it begins: its joint has a name of its own.
    if (body.name == entry.point) return pose * middle_of(chain, chain.frames[std::size_t(frame)].body);
    return pose.translation();
  }

  void add_words(const Note& note, const Shot& shot) const {
    const Panel& panel = shot.panel;
    const Rect& area = panel.area();
    const Rect room = widened(area, -kAirOfWords);  // what hangs below the last line is seen whole
    const std::vector<TextLine> shapes = shapes_of(note, room);
    const StagedRun& motion = motion_of(*note.entry);
    const auto seen_at = [&](int k) {
      return panel.camera().project(point_of(*note.entry, motion, panel.camera(), std::min(k, motion.samples() - 1)));
    };
    const Point now = seen_at(shot.k);
    // Where the words stand is decided by the instant that they are about.
    const auto& times = stage_->times;
    const int samples = panel.last() + 1;
    const int k = int(std::lower_bound(times.begin(), times.begin() + samples, note.at - kSame) - times.begin());
    const Point then = seen_at(std::min(k, samples - 1));
    panel.motion().pose_at(shot.k);  // the workspace of the shot is the same one
    if (!std::isfinite(now.x + now.y + then.x + then.y)) return;
    require_in_picture(note, panel, then);
    const Point inward = center_of(area) - then;
    const Point first = norm(inward) > 0.05 ? unit(inward) : unit({1, 1});
    shot.labels.add({"annotation " + std::to_string(note.number), shapes.front(), places_of(shapes, room, then, first),
                     Leader{now, stage_->theme.ink}, std::nullopt, {shapes.begin() + 1, shapes.end()}});
  }

  // The words on one line where it is short enough, and on more: those that the panel has room for.
  std::vector<TextLine> shapes_of(const Note& note, const Rect& area) const {
    const auto has_room = [&area](const TextLine& line) {
      return line.box.width() <= area.width() && line.box.height() <= area.height();
    };
    std::vector<TextLine> shapes;
    const double widest = note.line.box.width();
    if (widest <= kWidths[0] * area.width()) shapes.push_back(note.line);
    for (const double share : kWidths) {
      if (!shapes.empty() && widest <= kShortLine * style().size) break;
      if (widest <= share * area.width() && !shapes.empty()) continue;
      TextLine line = lay_out_within(stage_->fonts, note.text, style(), share * area.width());
      if (!shapes.empty() && (line.box.width() >= shapes.back().box.width() || !has_room(line))) continue;
      shapes.push_back(std::move(line));
    }
    const TextLine& first = shapes.front();
    if (!has_room(first))
      throw Error(ExitCode::bad_input,
                  "'annotate." + std::to_string(note.number) + ".text' has no room in its panel" +
                      (first.box.width() > area.width() ? ", one word of it being wider" : "") +
                      ": shorten it, or take a smaller text_scale, or a layout that leaves more room beside plots",
                  note.entry->place);
    return shapes;
  }

  // On few lines near what they speak of, then farther off, then on more, then anywhere.
  static std::vector<Rect> places_of(const std::vector<TextLine>& shapes, const Rect& area, Point then, Point first) {
    std::vector<Rect> places;
    for (const TextLine& shape : shapes)
      for (const double off : kFarPlaces)
        for (const Rect& place : places_about(shape, then, off, first)) places.push_back(moved_into(area, place));
    const auto near = std::ptrdiff_t(places.size());
    for (const TextLine& shape : shapes) {
      const double width = shape.box.width(), height = shape.box.height();
      for (int k = 0; k < kAnywhere * kAnywhere; ++k) {
        const double x = area.x0 + (area.width() - width) * (k % kAnywhere) / (kAnywhere - 1);
        const double y = area.y0 + (area.height() - height) * (k / kAnywhere) / (kAnywhere - 1);
        places.push_back({x, y, x + width, y + height});
      }
    }
    std::stable_sort(places.begin() + near, places.end(), [then](const Rect& a, const Rect& b) {
      return norm(nearest_in(a, then) - then) < norm(nearest_in(b, then) - then);
    });
    return places;
  }

  // A fixed point beyond the picture has no line that leads to it; what moves may leave the picture.
  static void require_in_picture(const Note& note, const Panel& panel, Point then) {
    const Rect& area = panel.area();
    if (note.entry->spot.empty() || overlap(widened(area, kSame), {then.x, then.y, then.x, then.y})) return;
    const std::array<double, 4> part = part_shown(panel.camera(), area);
    const auto range = [](double low, double high) { return format_significant(low, 3) + " to " + format_significant(high, 3); };
    const bool is_flat = note.entry->spot.size() == 2;
    throw Error(ExitCode::bad_input,
                "'annotate." + std::to_string(note.number) + ".point' lies outside of the picture, which shows " +
                    (is_flat ? "x from " + range(part[0], part[2]) + " m and y from " + range(part[1], part[3]) + " m"
                             : range(part[0], part[2]) + " m to the right and " + range(part[1], part[3]) + " m up") +
                    ": name a point in there, or a link",
                note.entry->place);
  }

  const Stage* stage_;
  Callouts callouts_;
  std::vector<Note> notes_;
};

}  // namespace

std::unique_ptr<const Layer> make_layer_annotations(const Stage& stage) {
  return std::make_unique<Annotations>(stage);
}

}  // namespace chainreel
