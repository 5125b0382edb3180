// What acts on a chain and moves it, as the layers `gravity`, `torque`, `velocity` and `constraint_force` show it:
// vectors at the places where they act, each kind at one scale over the whole film.
#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <utility>

#include "core/format.hpp"
#include "draw/layers/beside_links.hpp"
#include "draw/layers/devices.hpp"
#include "draw/layers/layer.hpp"
#include "draw/layers/reactions.hpp"
#include "draw/layers/torque_run.hpp"
#include "draw/layers/vectors.hpp"
#include "dynamics/kinematics.hpp"
#include "picture/point.hpp"
#include "sim/drive/pushes.hpp"

namespace chainreel {
namespace {

using Eigen::Vector3d;

// More of them would hide the chain, and the legend says what they are.
constexpr int kMostLabels = 4;         // of weights
constexpr double kArcOfLink = 0.32;    // an arc's radius at most, of the shortest link
constexpr double kSmallestArc = 0.5;   // of the size that arcs have elsewhere
constexpr double kLinkOfWords = 1.5;    // of the height of letters: between shorter links there is no room for words

// The vectors of a motion at sample k, after compute_kinematics there.
using VectorsAt = std::function<std::vector<WorldVector>(const StagedRun& motion, const Workspace& ws, int k)>;
// The kinds of vectors that there are of a chain.
using KindsOf = std::function<std::vector<VectorKind>(const Chain& chain)>;

constexpr std::array kForces{VectorKind::joint_force, VectorKind::weight, VectorKind::constraint, VectorKind::push};
VectorsAt pushes_of(const Stage& stage);
// The layers that show forces, by their names.
std::map<const char*, VectorsAt (*)(const Stage&)> force_sources();

// Under which name it is kept by how much arrows are shorter than they would be: forces are by one.
constexpr std::string_view share_name(std::string_view layer) {
  return layer == "velocity" ? layer : "forces";
}

class VectorLayer : public Layer {
 public:
  VectorLayer(const Stage& stage, const char* name, VectorsAt vectors_at, KindsOf kinds_of)
      : stage_(&stage),
        share_(share_name(name)),
        vectors_at_(std::move(vectors_at)),
        kinds_of_(std::move(kinds_of)),
        scales_(shared(scales_of(stage, vectors_at_), stage, name)),
        pen_(stage.theme, stage.fonts, stage.page.text_scale, scales_) {}

  bool has_words() const override { return true; }

  // What the first panel shows stands first.
  void write(SheetText& text) const override {
    std::vector<VectorKind> shown;
    for (std::size_t i = 0; i < stage_->motions.size(); ++i)
      for (const VectorKind kind : kinds_of_(stage_->motions[i].chain())) {
        if (std::find(shown.begin(), shown.end(), kind) != shown.end()) continue;
        shown.push_back(kind);
        // Beside a damper the arc has a name, too: it is the whole torque.
        const bool is_named = stage_->shows("legend") || (kind == VectorKind::torque && has_damper(stage_->motions[i]));
        for (ScaleEntry& entry : scale_entries(scales_, {kind}, is_named, stage_->theme)) {
          entry.order = int(i * kVectorKinds.size()) + int(kind);
          if (const double most = largest_untold(kind); most > 0) entry.text += ", up to " + format_significant(most, 2) + "\u2009" + unit_of(kind);
          text.scales.push_back(std::move(entry));
        }
      }
  }

  void measure(const Sight& sight, FitBox& box) const override {
    for (const WorldVector& vector : vectors_at_(sight.motion, sight.ws, sight.k))
      pen_.add_to(box, vector, sight.camera, sight.marks, kLeastArrows / stage_->share_of_arrows(share_));
  }

  // Those that begin elsewhere, where a scene names the part that it shows, are not to be seen anyhow.
  void shorten_arrows(const Rect& scene, const Sight& sight, ArrowShares& shares) const override {
    constexpr double kStep = 0.05;
    double& share = shares.emplace(share_, 1).first->second;
    for (const WorldVector& vector : vectors_at_(sight.motion, sight.ws, sight.k)) {
      const Point place = sight.camera.project(vector.place);
      if (vector.kind == VectorKind::torque || !is_within({place.x, place.y, place.x, place.y}, scene)) continue;
      const auto leaves = [&] {
        return !is_within(moved(pen_.bare_extent(vector, sight.camera, sight.marks, share), place), scene);
      };
      while (share > kLeastArrows && leaves()) share = std::max(kLeastArrows, share - kStep);
    }
  }

  bool covers(const Sight& sight, const Rect& part, bool) const override {
    for (const WorldVector& vector : vectors_at_(sight.motion, sight.ws, sight.k)) {
      const Rect extent = pen_.extent(vector, sight.camera, sight.marks);
      if (overlap(part, moved(extent, sight.camera.project(vector.place)))) return true;
    }
    return false;
  }

  void draw(Picture& picture, const Shot& shot) const override {
    const Panel& panel = shot.panel;
    // Arcs of neighbouring joints of a stretched chain stay apart; they have one size over the film, so that equal torques look alike.
    const double link = panel.motion().skeleton().shortest_link * panel.camera().scale;
    const double arcs = link > 0 ? std::clamp(kArcOfLink * link / (panel.marks() * size::kTorqueArc), kSmallestArc, 1.0) : 1;
    const Asides& asides = asides_of(panel, shot.k);
    const Peaks& peaks = peaks_of(panel, shot.k);
    Names names;
    const std::size_t before = shot.labels.words().size();
    for (WorldVector& vector : vectors_at_(panel.motion(), shot.ws, shot.k)) {
      const VectorName name = names.next(vector);
      vector.size = arcs;
      if (const auto one = asides.find(name); one != asides.end()) vector.aside = one->second[std::size_t(shot.k)];
      if (const auto one = peaks.find(name); one != peaks.end()) vector.peak = one->second[std::size_t(shot.k)];
      if (shot.is_still && vector.peak) vector.peak = Peak{number_of(vector), true, std::abs(number_of(vector)) > pen_.cut_beyond(vector.kind)};
      if (vector.kind == VectorKind::torque && link > 0 && link < kLinkOfWords * pen_.em(panel.marks())) vector.label.clear();
      pen_.draw(picture, vector, panel.camera(), panel.marks(), panel.clip(), shot.labels);
    }
    if (before < shot.labels.words().size()) shot.labels.close_nearer_to_others(before);
  }

 private:
  bool has_damper(const StagedRun& motion) const {
    return std::ranges::any_of(devices_of(*stage_, motion), [](const Device& device) { return device.drive.damping > 0; });
  }

  // Of those of a kind that are cut at frames at which no number can stand beside them, as where many have no names, or for too short to
  // be read, the largest size; 0: there are none.
  double largest_untold(VectorKind kind) const {
    const double cut = pen_.cut_beyond(kind);
    if (!(scales_.largest[std::size_t(kind)] > cut)) return 0;
    double most = 0;
    for (std::size_t i = 0; i < stage_->full_panels(); ++i) {
      const StagedRun& motion = stage_->motions[i];
      if (!motion.counts()) continue;
      std::map<VectorName, std::vector<double>> numbers;
      for (int k = 0; k < motion.samples(); ++k) {
        Names names;
        for (const WorldVector& vector : vectors_at_(motion, motion.pose_at(k), k))
          if (const VectorName name = names.next(vector); vector.kind == kind)
            numbers.try_emplace(name, std::size_t(motion.samples())).first->second[std::size_t(k)] = vector.extreme.value_or(number_of(vector));
      }
      for (const auto& [name, values] : numbers) {
        const std::vector<std::optional<Peak>> told = peaks_along(values, cut, stage_->page.video.fps.value());
        for (std::size_t k = 0; k < values.size(); ++k)
          if (const double size = std::abs(values[k]); size > cut && std::isfinite(size) && (name.first.empty() || !told[k])) most = std::max(most, size);
      }
    }
    return most;
  }

  // The same vector from frame to frame: by its label, and which of these it is.
  using VectorName = std::pair<std::string, int>;
  struct Names {
    std::map<std::string, int> so_far{};
    VectorName next(const WorldVector& vector) { return {vector.label, so_far[vector.label]++}; }
  };
  // How far each stands aside at each frame; those that never do are not in it.
  using Asides = std::map<VectorName, std::vector<double>>;

  // What an arrow is not to lie along, on the page: bars, body shapes being so wide that arrows hide little of them; and what
  // pushes, where a velocity would hide it.
  std::vector<PageLine> below(const WorldVector& vector, const Panel& panel, const Workspace& ws, int k, const std::vector<PageLine>& links) const {
    std::vector<PageLine> lines = links;
    if (vector.kind != VectorKind::velocity || !stage_->shows("push")) return lines;
    for (const WorldVector& push : pushes_of(*stage_)(panel.motion(), ws, k)) {
      const Point place = panel.camera().project(push.place);
      lines.push_back({place, place + size::kLongestArrow * unit(panel.camera().project_vector(push.value, push.place))});
    }
    return lines;
  }

  // Found over all frames when the first one is drawn.
  const Asides& asides_of(const Panel& panel, int drawn) const {
    const StagedRun& motion = panel.motion();
    const auto [known, is_new] = asides_.try_emplace(&motion);
    if (!is_new) return known->second;
    const double half = panel.look().link_width / 2;
    std::map<VectorName, std::vector<LiesAlong>> along;
    std::map<VectorName, double> lanes;
    for (int k = 0; k <= panel.last(); ++k) {
      const Workspace& ws = motion.pose_at(k);
      const std::vector<PageLine> links = motion.shapes() ? std::vector<PageLine>() : links_on_page(panel, ws);
      Names names;
      for (WorldVector& vector : vectors_at_(motion, ws, k)) {
        const VectorName name = names.next(vector);
        // Those that act side by side go together.
        lanes[name] = std::abs(std::exchange(vector.lane, 0));
        // Those of sliders and of ties have a place beside what they act on.
        if (vector.kind == VectorKind::torque || vector.kind == VectorKind::joint_force || vector.pushes) continue;
        const PageLine arrow = pen_.line_of(vector, panel.camera(), panel.marks());
        LiesAlong most;
        for (const PageLine& line : below(vector, panel, ws, k, links))
          if (const LiesAlong one = lies_along(arrow, line, half); one.much > most.much) most = one;
        if (most.much > 0) along.try_emplace(name, std::size_t(panel.last()) + 1).first->second[std::size_t(k)] = most;
      }
    }
    motion.pose_at(drawn);
    for (const auto& [name, frames] : along) {
      std::vector<double> ways = ways_aside(frames, stage_->page.video.fps.value());
      for (double& one : ways) one *= way_beside(panel.look()) + panel.marks() * lanes[name];
      known->second.emplace(name, std::move(ways));
    }
    return known->second;
  }

  // Of those that are cut anywhere, what is said of them at each frame.
  using Peaks = std::map<VectorName, std::vector<std::optional<Peak>>>;
  const Peaks& peaks_of(const Panel& panel, int drawn) const {
    const StagedRun& motion = panel.motion();
    const auto [known, is_new] = peaks_.try_emplace(&motion);
    if (!is_new) return known->second;
    std::map<VectorName, std::vector<double>> numbers;
    std::map<VectorName, double> cuts;
    for (int k = 0; k <= panel.last(); ++k) {
      const Workspace& ws = motion.pose_at(k);
      Names names;
      for (const WorldVector& vector : vectors_at_(motion, ws, k)) {
        const VectorName name = names.next(vector);
        numbers.try_emplace(name, std::size_t(panel.last()) + 1).first->second[std::size_t(k)] = vector.extreme.value_or(number_of(vector));
        cuts.emplace(name, pen_.cut_beyond(vector.kind));
      }
    }
    motion.pose_at(drawn);
    for (const auto& [name, values] : numbers)
      if (const double cut = cuts[name]; std::ranges::any_of(values, [cut](double value) { return std::abs(value) > cut; }))
        known->second.emplace(name, peaks_along(values, cut, stage_->page.video.fps.value()));
    return known->second;
  }

  // By the time of the motion: where the film stands still or is slow nothing is larger. Runs that diverge do not decide on it,
  // unless all do: their arrows are cut.
  static VectorScales scales_of(const Stage& stage, const VectorsAt& vectors_at) {
    VectorMagnitudes magnitudes;
    VectorScales scales;
    std::vector<Magnitude> ties;  // at each sample the largest
    for (std::size_t i = 0; i < stage.full_panels(); ++i) {
      const StagedRun& motion = stage.motions[i];
      const Chain& chain = motion.chain();
      if (!motion.counts() && stage.full_panels() > 1) continue;
      for (int k = 0; k < motion.samples(); ++k) {
        const Workspace& ws = motion.pose_at(k);
        // Where a run goes wild its forces say nothing.
        if (chain.end_effector >= 0 && !(tip_position(chain, ws).norm() <= motion.limit())) {
          scales.largest.fill(HUGE_VAL);
          break;
        }
        const double weight = lasts(stage.times, std::size_t(k));
        ties.push_back({0, weight});
        for (const WorldVector& vector : vectors_at(motion, ws, k)) {
          magnitudes.add(vector, weight);
          double& largest = scales.largest[std::size_t(vector.kind)];
          largest = std::max({largest, vector.value.norm(), std::abs(vector.extreme.value_or(0))});
          if (vector.kind == VectorKind::constraint) ties.back().size = std::max(ties.back().size, vector.value.norm());
        }
      }
    }
    scales.full = magnitudes.full();
    auto& full = scales.full;
    double& of_ties = full[std::size_t(VectorKind::constraint)];
    of_ties = without_needles(of_ties, std::move(ties));
    leave_out_noise(full, stage.motions.front().skeleton().reach);
    scales.shrink = stage.share_of_lengths();
    return scales;
  }

  // All forces have the scale of the largest that the page shows: what is larger is longer, whatever layer draws it.
  static VectorScales shared(VectorScales own, const Stage& stage, const char* name) {
    own.shrink *= stage.share_of_arrows(share_name(name));
    const double largest = largest_force(own);
    if (!(largest > 0)) return own;
    double most = largest;
    for (const auto& [layer, source] : force_sources())
      if (std::string_view(layer) != name && stage.shows(layer)) most = std::max(most, largest_force(scales_of(stage, source(stage))));
    for (const VectorKind kind : kForces)
      if (double& full = own.full[std::size_t(kind)]; full > 0) full = most;
    return own;
  }
  static double largest_force(const VectorScales& scales) {
    double most = 0;
    for (const VectorKind kind : kForces) most = std::max(most, scales.full[std::size_t(kind)]);
    return most;
  }

  // What is rounding beside the other drives, of which nobody asked for an arrow at a scale of its own: sliders that rest while
  // torques act, or the other way round.
  static void leave_out_noise(std::array<double, kVectorKinds.size()>& full, double reach) {
    constexpr double kNoise = 1e-4;
    double &turning = full[std::size_t(VectorKind::torque)], &pushing = full[std::size_t(VectorKind::joint_force)];
    if (!(reach > 0)) return;
    if (pushing < kNoise * turning / reach) pushing = 0;
    if (turning < kNoise * pushing * reach) turning = 0;
  }

  const Stage* stage_;
  std::string_view share_;
  VectorsAt vectors_at_;
  KindsOf kinds_of_;
  VectorScales scales_;
  VectorPen pen_;
  mutable std::map<const StagedRun*, Asides> asides_;
  mutable std::map<const StagedRun*, Peaks> peaks_;
};

std::vector<WorldVector> weights_at(const Chain& chain, const Workspace& ws) {
  std::vector<WorldVector> vectors;
  int heavy = 0;
  for (std::size_t b = 1; b < chain.bodies.size(); ++b) heavy += chain.bodies[b].inertia.mass > 0 ? 1 : 0;
  int number = 0;
  for (std::size_t b = 1; b < chain.bodies.size(); ++b) {
    const Inertia& inertia = chain.bodies[b].inertia;
    if (!(inertia.mass > 0)) continue;
    ++number;
    const std::string label = heavy <= kMostLabels ? "m_{" + std::to_string(number) + "} g" : "";
    vectors.push_back({VectorKind::weight, pose_of(ws, int(b)) * inertia.com, inertia.mass * chain.gravity,
                       Vector3d::Zero(), Vector3d::Zero(), label});
  }
  return vectors;
}

// How far from its joint a body of a planar chain reaches: to its frames, and to the joints that it bears.
double reach_of(const Chain& chain, const Workspace& ws, int body) {
  const Vector3d joint = pose_of(ws, body).translation();
  double reach = 0;
  for (std::size_t f = 0; f < chain.frames.size(); ++f)
    if (chain.frames[f].body == body) reach = std::max(reach, (frame_position(chain, ws, int(f)) - joint).norm());
  for (std::size_t b = 1; b < chain.bodies.size(); ++b)
    if (chain.bodies[b].parent == body) reach = std::max(reach, (pose_of(ws, int(b)).translation() - joint).norm());
  return reach;
}

std::vector<WorldVector> torques_at(const Chain& chain, const Workspace& ws, const TorqueRun& run, int k) {
  std::vector<WorldVector> vectors;
  if (!run.shows_any()) return vectors;
  const double* tau = run.at(k);
  for (std::size_t b = 1; b < chain.bodies.size(); ++b) {
    const Joint& joint = chain.bodies[b].joint;
    const Eigen::Isometry3d X_WB = pose_of(ws, int(b));
    const Vector3d place = X_WB.translation();
    const double* own = tau + joint.v_index;
    const std::string label = run.is_labelled() && joint.kind != JointKind::floating ? run.word(joint.v_index) : "";
    if (joint.kind == JointKind::floating) {
      // Nothing drives a floating base, unless the scene says so: then a force and a moment in axes of the
      // body.
      const Vector3d f = X_WB.linear() * Vector3d(own[0], own[1], own[2]);
      const Vector3d m = X_WB.linear() * Vector3d(own[3], own[4], own[5]);
      if (f.norm() > 0) vectors.push_back({VectorKind::joint_force, place, f, Vector3d::Zero(), Vector3d::Zero(), "f"});
      if (m.norm() > 0) vectors.push_back({VectorKind::torque, place, m, m.normalized(), Vector3d::Zero(), "m"});
      continue;
    }
    // A joint that follows another one has no drive of its own.
    if (joint.ratio != 1 || joint.offset != 0 || !run.shows(joint.v_index)) continue;
    const Vector3d axis = X_WB.linear() * joint.axis;
    if (joint.kind == JointKind::revolute)
      vectors.push_back({VectorKind::torque, place, *own * axis, axis, Vector3d::Zero(), label, run.ring(joint.v_index, k), std::nullopt,
                         run.keeps_name(joint.v_index, k), chain.planar && chain.bodies[b].parent == 0 ? reach_of(chain, ws, int(b)) : 0});
    else
      vectors.push_back({VectorKind::joint_force, place, *own * axis, Vector3d::Zero(), axis, label});
    vectors.back().extreme = run.extreme(joint.v_index, k);
  }
  return vectors;
}

std::vector<WorldVector> pushes_at(const Chain& chain, const Workspace& ws, const Pushes& pushes, double t) {
  std::vector<WorldVector> vectors;
  for (const ActingPush& push : pushes.list())
    if (push.acts_at(t))
      vectors.push_back({VectorKind::push, frame_position(chain, ws, push.frame), push.force, Vector3d::Zero(), Vector3d::Zero(),
                         format_significant(push.force.norm(), 3) + " N"});
  return vectors;
}

std::vector<WorldVector> velocity_at(const Chain& chain, const Workspace& ws) {
  return {{VectorKind::velocity, frame_position(chain, ws, chain.end_effector),
           frame_velocity(chain, ws, chain.end_effector), Vector3d::Zero(), Vector3d::Zero(), "v"}};
}

std::vector<VectorKind> kinds_of_torque(const Chain& chain) {
  bool turns = false, slides = false;
  for (std::size_t b = 1; b < chain.bodies.size(); ++b) {
    turns |= chain.bodies[b].joint.kind == JointKind::revolute;
    slides |= chain.bodies[b].joint.kind == JointKind::prismatic;
  }
  std::vector<VectorKind> kinds;
  if (turns) kinds.push_back(VectorKind::torque);
  if (slides) kinds.push_back(VectorKind::joint_force);
  return kinds;
}

KindsOf always(VectorKind kind) {
  return [kind](const Chain&) { return std::vector<VectorKind>{kind}; };
}

// What `compute` gives for the runs that are drawn in full, once each.
template <class Value, class Compute>
std::map<const StagedRun*, Value> along_runs(const Stage& stage, Compute compute) {
  std::map<const StagedRun*, Value> values;
  for (const StagedRun& motion : stage.motions) {
    // Of a motion that no simulation is known of nobody knows what acts.
    if (motion.is_outlined() || motion.simulation() == nullptr) continue;
    values.emplace(&motion, compute(motion));
  }
  return values;
}

VectorsAt weights_of(const Stage&) {
  return [](const StagedRun& motion, const Workspace& ws, int) { return weights_at(motion.chain(), ws); };
}

VectorsAt torques_of(const Stage& stage) {
  return [runs = along_runs<TorqueRun>(stage, [&](const StagedRun& motion) { return TorqueRun(stage, motion); })](
             const StagedRun& motion, const Workspace& ws, int k) {
    const auto run = runs.find(&motion);
    return run == runs.end() ? std::vector<WorldVector>() : torques_at(motion.chain(), ws, run->second, k);
  };
}

VectorsAt pushes_of(const Stage&) {
  return [](const StagedRun& motion, const Workspace& ws, int k) {
    const Pushes* pushes = motion.simulation() == nullptr ? nullptr : motion.simulation()->torque->pushes();
    return pushes == nullptr ? std::vector<WorldVector>() : pushes_at(motion.chain(), ws, *pushes, motion.trajectory().t[std::size_t(k)]);
  };
}

VectorsAt constraint_forces_of(const Stage& stage) {
  return [forces = along_runs<ReactionRun>(stage, [](const StagedRun& motion) { return ReactionRun(motion); })](const StagedRun& motion, const Workspace& ws, int k) {
    const auto own = forces.find(&motion);
    return own == forces.end() ? std::vector<WorldVector>() : own->second.vectors_at(ws, k);
  };
}

std::map<const char*, VectorsAt (*)(const Stage&)> force_sources() {
  return {{"gravity", weights_of}, {"torque", torques_of}, {"push", pushes_of}, {"constraint_force", constraint_forces_of}};
}

}  // namespace

std::unique_ptr<const Layer> make_layer_gravity(const Stage& stage) {
  return std::make_unique<VectorLayer>(stage, "gravity", weights_of(stage), always(VectorKind::weight));
}

std::unique_ptr<const Layer> make_layer_torque(const Stage& stage) {
  return std::make_unique<VectorLayer>(stage, "torque", torques_of(stage), kinds_of_torque);
}

std::unique_ptr<const Layer> make_layer_push(const Stage& stage) {
  return std::make_unique<VectorLayer>(stage, "push", pushes_of(stage), always(VectorKind::push));
}

std::unique_ptr<const Layer> make_layer_velocity(const Stage& stage) {
  return std::make_unique<VectorLayer>(
      stage, "velocity", [](const StagedRun& motion, const Workspace& ws, int) { return velocity_at(motion.chain(), ws); },
      always(VectorKind::velocity));
}

std::unique_ptr<const Layer> make_layer_constraint_force(const Stage& stage) {
  return std::make_unique<VectorLayer>(stage, "constraint_force", constraint_forces_of(stage), always(VectorKind::constraint));
}

}  // namespace chainreel
