// The layers `springs`: torques that are linear in a coordinate or in its rate, as the things that would make them. A slider
// has a coil, a dashpot or both between an end of its rail and its carriage, and a mark where the coil is at rest, over bodies along its axis; a
// revolute joint a spiral that winds up, a ring with vanes, or both.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/format.hpp"
#include "draw/layers/devices.hpp"
#include "draw/layers/layer.hpp"
#include "draw/page/coils.hpp"
#include "draw/robot/chain.hpp"
#include "draw/robot/view.hpp"
#include "dynamics/kinematics.hpp"
#include "picture/point.hpp"
#include "sim/torques_along.hpp"

namespace chainreel {

using Eigen::Vector3d;

bool shows_drives(const Stage& stage, const StagedRun& motion) {
  return !motion.shapes() || is_oblique(motion.chain(), stage.page.camera);
}

Color casing_over(const Panel& panel) {
  return panel.motion().shapes() ? panel.look().theme->background : Color{};
}

std::vector<Device> devices_of(const Stage& stage, const StagedRun& motion) {
  std::vector<Device> devices;
  if (!stage.shows("springs") || motion.simulation() == nullptr || !shows_drives(stage, motion) || motion.is_outlined()) return devices;
  const Chain& chain = motion.chain();
  const Camera camera = view_of(chain, stage.page.camera);
  for (const LinearDrive& drive : linear_drives(*motion.simulation())) {
    if (drive.follows) continue;
    Device device{drive, body_of_freedom(chain, drive.freedom)};
    const Vector3d axis = pose_of(motion.pose_at(0), device.body).linear() * chain.bodies[std::size_t(device.body)].joint.axis;
    // Below, else on the left.
    const double up = camera.up.dot(axis), right = camera.right.dot(axis);
    device.from_upper = std::abs(up) > 1e-9 ? up < 0 : right < 0;
    devices.push_back(device);
  }
  return devices;
}

namespace {

// Where a body's link goes, in B: joints in one place, as of a wrist, have no link between them, and go where the next one does as
// all of them stand at zero.
Vector3d way_along_link(const Chain& chain, const Skeleton& skeleton, int body) {
  Eigen::Matrix3d turned = Eigen::Matrix3d::Identity();  // of body `at` in B
  for (int at = body;;) {
    const auto link = std::find_if(skeleton.links.begin(), skeleton.links.end(), [at](const LinkSegment& one) { return one.body == at; });
    if (link != skeleton.links.end()) return turned * (link->to - link->from);
    const auto next = std::find_if(chain.bodies.begin(), chain.bodies.end(), [at](const Body& one) { return one.parent == at; });
    if (next == chain.bodies.end()) return Vector3d::UnitX();
    turned = turned * next->joint.X_PJ.linear();
    at = int(next - chain.bodies.begin());
  }
}

}  // namespace

JointZero joint_zero(const Chain& chain, const Skeleton& skeleton, const Workspace& ws, int body) {
  const Joint& joint = chain.bodies[std::size_t(body)].joint;
  Vector3d along = way_along_link(chain, skeleton, body);
  const auto across = [&joint](const Vector3d& v) { return Vector3d(v - v.dot(joint.axis) * joint.axis); };
  for (const Vector3d& other : {Vector3d(Vector3d::UnitX()), Vector3d(Vector3d::UnitY())})
    if (across(along).norm() < 1e-6 * std::max(1.0, along.norm())) along = other;
  along = across(along).normalized();
  const Eigen::Matrix3d R = pose_of(ws, chain.bodies[std::size_t(body)].parent).linear() * joint.X_PJ.linear();
  return {R * along, R * joint.axis.cross(along)};
}

namespace {

constexpr double kAnchorAway = 0.050;  // of a slider's anchor beyond the end of its rail, units of H
constexpr double kAnchorWidth = 0.060;
constexpr double kSmallest = 0.8;      // of the size of coils and dashpots on full rails: on thin ones they would be a hair
constexpr double kRestBeyond = 0.022;  // of the mark of rest, on both sides of the rail
constexpr double kSeenEndOn = 0.08;    // units of H: a rail over bodies that is no longer on the page, whose coil would be a ring
constexpr double kNameGap = 0.012, kNameFromAnchor = 0.09;  // units of H: of a spring's words, from the rail and along it
constexpr double kOnBodies = 1.25;      // a spiral about the axis of a body, of that about the disc of a bar
constexpr double kSideBySide = 0.23;   // of the rail's width: of a coil and a dashpot from its middle line

using Devices = std::map<const StagedRun*, std::vector<Device>>;

enum class Over { bars, bodies, both };
Devices all_devices(const Stage& stage, JointKind kind, Over over = Over::both) {
  Devices all;
  for (const StagedRun& motion : stage.motions) {
    if (over != Over::both && (over == Over::bodies) != (motion.shapes() != nullptr)) continue;
    std::vector<Device> own = devices_of(stage, motion);
    std::erase_if(own, [&](const Device& device) {
      return motion.chain().bodies[std::size_t(device.body)].joint.kind != kind;
    });
    if (!own.empty()) all.emplace(&motion, std::move(own));
  }
  return all;
}

const Rail* rail_of(const Skeleton& skeleton, int body) {
  const auto rail = std::find_if(skeleton.rails.begin(), skeleton.rails.end(),
                                 [body](const Rail& one) { return one.body == body; });
  return rail == skeleton.rails.end() ? nullptr : &*rail;
}

// Between rails and carriages, or over bodies.
class SliderSprings : public Layer {
 public:
  SliderSprings(const Stage& stage, Over over)
      : stage_(&stage), devices_(all_devices(stage, JointKind::prismatic, over)), is_named_(!stage.is_comparison() && !is_transparent(stage.page)) {}

  bool has_words() const override { return is_named_ && !devices_.empty(); }

  void measure(const Sight& sight, FitBox& box) const override {
    for_each(sight.motion, [&](const Device& device) {
      const Rail* rail = rail_of(sight.motion.skeleton(), device.body);
      if (!rail) return;
      const Vector3d end = rail_point(sight.motion.chain(), sight.ws, device.body, device.from_upper ? rail->upper : rail->lower);
      box.add(room_around(sight.marks * (rail_overhang(rail->carrier) + kAnchorAway)), sight.camera.flat(end));
    });
  }

  void draw(Picture& picture, const Shot& shot) const override {
    for_each(shot.panel.motion(), [&](const Device& device) { draw_device(picture, shot, device); });
  }

 private:
  template <class Do>
  void for_each(const StagedRun& motion, Do&& act) const {
    const auto own = devices_.find(&motion);
    if (own == devices_.end()) return;
    for (const Device& device : own->second) act(device);
  }

  void draw_device(Picture& picture, const Shot& shot, const Device& device) const {
    const Panel& panel = shot.panel;
    const ChainDrawing drawing = panel.drawing();
    const ChainLook& look = panel.look();
    const Rail* rail = rail_of(drawing.skeleton, device.body);
    if (!rail) return;
    const bool is_over_body = drawing.shapes != nullptr;
    const double rails = is_over_body ? panel.marks() : look.rails;
    const PageLine line = rail_line(drawing, shot.ws, *rail);
    const Point carriage = panel.camera().project(pose_of(shot.ws, device.body).translation());
    if (!is_drawable(line.a) || !is_drawable(line.b) || !is_drawable(carriage)) return;
    if (is_over_body && norm(line.b - line.a) < kSeenEndOn * panel.marks()) return;
    const Point away = device.from_upper ? unit(line.b - line.a) : unit(line.a - line.b), side = normal_to(away);
    const Point anchor = within((device.from_upper ? line.b : line.a) + (rails * kAnchorAway) * away, carriage,
                                panel.area(), rails * kAnchorAway / 2);
    const Point end = carriage + (is_over_body ? 0 : rails * carriage_length(rail->carrier) / 2) * away;
    const Color color = toned(look.theme->torque, look);
    const Point half = (rails * kAnchorWidth / 2) * side;
    const bool both = device.drive.is_spring() && device.drive.damping > 0;
    const double width = std::max(rails, kSmallest * panel.marks());
    const Point apart = ((both ? kSideBySide : 0) * width * size::kRailGap) * side;
    if (device.drive.is_spring()) {
      draw_rest(picture, drawing, shot.ws, device, side, rails, panel.clip());
      draw_coil(picture, anchor + apart, end + apart, width * (both ? 0.6 : 1), color, panel.clip(), look.theme->background);
      if (is_named_) {
        const double beside = rails * (size::kRailGap / 2 + kRestBeyond);
        const std::string number = std::to_string(device.drive.freedom);
        add_word(shot, "rest " + number, "rest", panel.camera().project(rail_point(drawing.chain, shot.ws, device.body, device.drive.rest)), side, beside);
        add_word(shot, "stiffness " + number, "$k$ = " + format_significant(device.drive.stiffness, 3) + " N/m", anchor - kNameFromAnchor * away, side, beside);
      }
    }
    if (device.drive.damping > 0)
      draw_dashpot(picture, anchor - apart, end - apart, width * (both ? 0.6 : 1), color,
                   look.theme->background, panel.clip());
    // Over the pale edges of a coil. Hatching stands for the world: what moves with a link has a plate alone.
    const PageLine plate{anchor - half, anchor + half};
    if (drawing.chain.bodies[std::size_t(device.body)].parent == 0)
      draw_ground(picture, plate, away, look, panel.clip());
    else
      draw_line(picture, plate, size::kGroundLine, toned(look.theme->base, look), panel.clip());
  }

  // Beside the rail, on one side or the other.
  void add_word(const Shot& shot, const std::string& name, const std::string& words, Point at, Point side, double beside) const {
    if (!is_drawable(at)) return;
    TextLine line = lay_out_words(stage_->fonts, words, {Face::label, scaled(size::kTick, stage_->page.text_scale), stage_->theme.torque, Align::left});
    MarkWord word{name, line, {}};
    // Farther where a carriage of another rail stands there.
    for (const double gap : {kNameGap, 4 * kNameGap})
      for (const double turn : {-1.0, 1.0}) word.places.push_back(place_beyond(line, at + turn * beside * side, gap, turn * side));
    shot.labels.add(std::move(word));
  }

  // Beyond what the panel shows, as in runs that leave it, an anchor would be cut: it stands at the edge.
  static Point within(Point anchor, Point carriage, const Rect& area, double room) {
    Point a = carriage, b = anchor;
    return cut_segment(widened(area, -room), a, b) ? b : anchor;
  }

  // Dashes across the rail.
  static void draw_rest(Picture& picture, const ChainDrawing& drawing, const Workspace& ws, const Device& device,
                        Point side, double rails, int clip) {
    const ChainLook& look = drawing.look;
    const Point rest = drawing.camera.project(rail_point(drawing.chain, ws, device.body, device.drive.rest));
    if (!is_drawable(rest)) return;
    const double reach = rails * (size::kRailGap / 2 + kRestBeyond), dash = reach / 3.5;
    for (double at = -reach; at < reach - 0.5 * dash; at += 2 * dash)
      draw_line(picture, {rest + at * side, rest + (at + dash) * side}, size::kRailLine, toned(look.theme->torque, look), clip);
  }

  const Stage* stage_;
  Devices devices_;
  bool is_named_;
};

// Over links and joints.
class JointSprings : public Layer {
 public:
  explicit JointSprings(const Stage& stage) : devices_(all_devices(stage, JointKind::revolute)), color_(stage.theme.torque), sliders_(stage, Over::bodies) {}

  bool has_words() const override { return sliders_.has_words(); }

  // A ring with vanes is not known to everybody as a damper: what it is stands in the foot, and how strong, where all are alike.
  void write(SheetText& text) const override {
    std::vector<double> dampings;
    for (const auto& [motion, own] : devices_)
      for (const Device& device : own)
        if (device.drive.damping > 0) dampings.push_back(device.drive.damping);
    if (dampings.empty()) return;
    const auto [least, most] = std::ranges::minmax(dampings);
    const std::string words = least == most ? "damper " + format_significant(most, 3) + "\u2009N m s" : "dampers";
    text.scales.push_back({ScaleEntry::Mark::damper, 0, color_, words, kAfterVectors});
  }

  void measure(const Sight& sight, FitBox& box) const override {
    sliders_.measure(sight, box);
    const auto own = devices_.find(&sight.motion);
    if (own == devices_.end()) return;
    for (const Device& device : own->second)
      box.add(room_around(sight.marks * kSpiralOuter), sight.camera.flat(pose_of(sight.ws, device.body).translation()));
  }

  void draw(Picture& picture, const Shot& shot) const override {
    const Panel& panel = shot.panel;
    sliders_.draw(picture, shot);
    const auto own = devices_.find(&panel.motion());
    if (own == devices_.end()) return;
    const ChainLook& look = panel.look();
    for (const Device& device : own->second) {
      const Vector3d place = pose_of(shot.ws, device.body).translation();
      const JointZero zero = joint_zero(panel.chain(), panel.motion().skeleton(), shot.ws, device.body);
      const Camera seen = panel.camera().seen_at(place);
      const PageTurn turn{panel.camera().project(place),
                          {seen.right.dot(zero.along), seen.up.dot(zero.along)},
                          {seen.right.dot(zero.quarter), seen.up.dot(zero.quarter)}};
      if (!is_drawable(turn.center)) continue;
      const double q = panel.motion().trajectory().q_at(shot.k)[std::size_t(
          panel.chain().bodies[std::size_t(device.body)].joint.q_index)];
      const Color color = toned(look.theme->torque, look);
      const Color casing = casing_over(panel);
      const double size = panel.motion().shapes() ? kOnBodies * panel.marks() : look.joint_disc / size::kJointDisc;
      if (device.drive.damping > 0)
        draw_vanes(picture, turn, q, size, color, tinted(look.theme->torque, kInsideOfVanes, look), panel.clip());
      if (device.drive.is_spring()) draw_spiral(picture, turn, q, device.drive.rest, size, color, panel.clip(), casing);
    }
  }

 private:
  Devices devices_;
  Color color_;
  SliderSprings sliders_;
};

}  // namespace

std::unique_ptr<const Layer> make_layer_slider_springs(const Stage& stage) {
  return std::make_unique<SliderSprings>(stage, Over::bars);
}

std::unique_ptr<const Layer> make_layer_joint_springs(const Stage& stage) {
  return std::make_unique<JointSprings>(stage);
}

}  // namespace chainreel
