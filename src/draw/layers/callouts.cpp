#include "draw/layers/callouts.hpp"

#include <algorithm>
#include <optional>
#include <set>
#include <type_traits>
#include <variant>

#include "draw/page/wrapped_words.hpp"
#include "draw/robot/joints.hpp"
#include "dynamics/kinematics.hpp"
#include "picture/point.hpp"

namespace chainreel {
namespace {

using Eigen::Vector3d;

constexpr double kOffPlace[] = {0.06, 0.10, 0.15, 0.20};  // of words from what they speak of, units of H
constexpr double kHalfOfWords = 0.62;   // of their width: long ones stand on two lines, too
constexpr double kLongWords = 8;        // em
constexpr double kSameInstant = 1e-9;   // s
constexpr char kAccurateUntilHere[] = "accurate until here";
constexpr double kSamePlaceOfTies = 1e-6;  // m

// A joint or a frame, whichever is not -1.
struct Spot {
  int body = -1, frame = -1;
  friend auto operator<=>(const Spot&, const Spot&) = default;

  Vector3d place(const Chain& chain, const Workspace& ws) const {
    return frame >= 0 ? frame_position(chain, ws, frame) : Vector3d(pose_of(ws, body).translation());
  }
};

int body_of(const Chain& chain, const auto& is_its) {
  for (int b = 1; b < int(chain.bodies.size()); ++b)
    if (is_its(chain.bodies[std::size_t(b)].joint)) return b;
  return -1;
}

// Where a constraint holds the robot; nothing of those of coordinates.
std::optional<Spot> spot_of(const Chain& chain, const Constraint& constraint) {
  const std::string name = std::visit(
      [](const auto& one) -> std::string {
        if constexpr (requires { one.frame; }) return one.frame;
        if constexpr (requires { one.a; }) return one.a;
        return {};
      },
      constraint);
  const int frame = name.empty() ? -1 : find_frame(chain, name);
  return frame < 0 ? std::nullopt : std::optional(Spot{-1, frame});
}

// The one place at which the constraints hold it; of several nothing says which of them is meant.
std::optional<Spot> spot_of_ties(const StagedRun& motion, const Workspace& ws) {
  std::optional<Spot> found;
  if (!motion.is_constrained()) return found;
  const Chain& chain = motion.chain();
  for (const Constraint& one : motion.simulation()->constraints.list) {
    const std::optional<Spot> spot = spot_of(chain, one);
    if (!spot || (found && (spot->place(chain, ws) - found->place(chain, ws)).norm() > kSamePlaceOfTies)) return {};
    found = spot;
  }
  return found;
}

// The one frame that an event reads, else the one joint.
std::optional<Spot> spot_of(const StagedRun& motion, const EventSet& events, const Event& event, const Workspace& ws) {
  const Chain& chain = motion.chain();
  std::set<Spot> frames, joints;
  for (const int slot : event.value.used_variables()) {
    if (events.probe.is_multiplier(slot)) {
      const std::optional<Spot> tie = spot_of_ties(motion, ws);
      if (!tie) return {};
      frames.insert(*tie);
    } else if (events.probe.is_kinematic(slot)) {
      frames.insert({-1, events.probe.frame_of(chain, slot)});
    } else if (slot >= 1 && slot <= chain.nq) {
      joints.insert({body_of(chain, [&](const Joint& joint) { return joint.kind != JointKind::floating && joint.q_index == slot - 1; }), -1});
    } else if (slot > chain.nq && slot <= chain.nq + chain.nv) {
      joints.insert({body_of(chain, [&](const Joint& joint) { return joint.kind != JointKind::floating && joint.v_index == slot - 1 - chain.nq; }), -1});
    }
  }
  const std::set<Spot>& those = frames.empty() ? joints : frames;
  if (those.size() != 1 || *those.begin() == Spot{}) return {};
  return *those.begin();
}

}  // namespace

std::vector<Callout> callouts_of(const Stage& stage, const StagedRun& motion) {
  std::vector<Callout> all;
  const std::vector<double>& times = stage.times;
  const auto pose_when = [&](double t) -> const Workspace& {
    const auto next = std::lower_bound(times.begin(), times.end(), t - kSameInstant);
    return motion.pose_at(std::min(int(next - times.begin()), motion.samples() - 1));
  };
  const auto add = [&](double t, const std::string& words, const std::optional<Spot>& spot) {
    if (spot && t <= times.back() + kSameInstant) all.push_back({t, words, spot->place(motion.chain(), pose_when(t))});
  };
  const auto is_annotated = [&](const std::string& event) {
    return std::ranges::any_of(stage.page.annotate, [&](const AnnotationEntry& one) { return one.event == event; });
  };
  const Trajectory& run = motion.trajectory();
  std::set<int> seen;
  if (motion.simulation() && motion.simulation()->events)
    for (int hit = 0; hit < run.events.size(); ++hit) {
      const int event = run.events.event[std::size_t(hit)];
      const EventEntry& entry = motion.scene().events[std::size_t(event)];
      if (!seen.insert(event).second || entry.name.empty() || is_annotated(entry.name)) continue;
      if (entry.kind == EventKind::fall) continue;  // its level has its words, and where a run ends torques need the room
      const EventSet& events = *motion.simulation()->events;
      const double t = run.events.t[std::size_t(hit)];
      add(t, entry.name, spot_of(motion, events, events.list[std::size_t(event)], pose_when(t)));
    }
  if (const std::vector<double>& lost = motion.change_points(); !lost.empty())
    add(lost.front(), kRankLost, spot_of_ties(motion, pose_when(lost.front())));
  // Where a plot has a zone for it, what moves on looks as true as before.
  if (const int tip = motion.chain().end_effector; tip >= 0 && motion.accurate_until() < times.back()) add(motion.accurate_until(), kAccurateUntilHere, Spot{-1, tip});
  if (const std::optional<LimitEvent> limit = motion.stopping_limit()) {
    const Spot joint{body_of(motion.chain(), [&](const Joint& one) { return one.name == limit->joint; }), -1};
    if (joint.body > 0) add(run.end_time, words_of_stop(*limit), joint);
  }
  std::ranges::stable_sort(all, {}, &Callout::at);
  return all;
}

Callouts::Callouts(const Stage& stage) : stage_(&stage) {
  if (is_transparent(stage.page) || stage.has_cells()) return;
  const TextStyle style{Face::label, scaled(size::kSymbol, stage.page.text_scale), stage.theme.ink, Align::left};
  for (const StagedRun& motion : stage.motions) {
    if (motion.is_outlined()) continue;
    std::vector<Shown> shown;
    for (const Callout& one : callouts_of(stage, motion)) {
      std::vector<TextLine> shapes{lay_out_words(stage.fonts, one.words, style)};
      const double width = shapes.front().box.width();
      if (width > kLongWords * style.size) shapes.push_back(lay_out_within(stage.fonts, one.words, style, kHalfOfWords * width));
      shown.push_back({one, std::move(shapes)});
    }
    if (!shown.empty()) runs_.emplace(&motion, std::move(shown));
  }
}

void Callouts::draw(const Shot& shot) const {
  const auto known = runs_.find(&shot.panel.motion());
  if (known == runs_.end()) return;
  const double now = stage_->clock.film_time(stage_->times[std::size_t(shot.k)]);
  int number = 0;
  for (const auto& [callout, shapes] : known->second) {
    ++number;
    const double then = stage_->clock.film_time(callout.at);
    if (now < then - kBeforeCallout - kSameInstant || now > then + kAfterCallout + kSameInstant) continue;
    const Point at = shot.panel.camera().project(callout.place);
    if (!is_drawable(at)) continue;
    const Point inward = center_of(shot.panel.area()) - at;
    const Point first = norm(inward) > 0.05 ? unit(inward) : unit({1, 1});
    std::vector<Rect> places;
    for (const TextLine& shape : shapes)
      for (const double off : kOffPlace)
        for (const Rect& place : places_about(shape, at, off, first)) places.push_back(place);
    Tie tie{at, 0, stage_->theme.ink};
    tie.dot = true;
    shot.labels.add({"callout " + std::to_string(number), shapes.front(), std::move(places), {}, tie, {shapes.begin() + 1, shapes.end()}});
  }
}

}  // namespace chainreel
