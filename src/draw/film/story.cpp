#include "draw/film/story.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <string_view>

#include "draw/layers/devices.hpp"
#include "scene/text/write_scene.hpp"
#include "sim/torques_along.hpp"

namespace chainreel {
namespace {

std::vector<PlotCurves> curves_of(const StagedRun& motion, PlotQuantity quantity) {
  const Simulation& simulation = *motion.simulation();
  const auto plots = make_plots(motion.chain(), {{std::string(to_string(quantity)), "", {}}}, {}, {}, {},
                                motion.trajectory().rows);
  return plot_curves(*plots, simulation, motion.curve_run(), motion.curve_samples());
}

Story of_all(const Stage& stage, PlotQuantity quantity) {
  Story story;
  for (const StagedRun& motion : stage.motions) story.push_back(curves_of(motion, quantity));
  return story;
}

// " [m]": of the coordinates that are shown.
std::string unit_of_driven(const Chain& chain, const std::vector<bool>& is_driven) {
  bool turns = false, slides = false;
  for (std::size_t b = 1; b < chain.bodies.size(); ++b) {  // the world has no joint
    const Joint& joint = chain.bodies[b].joint;
    if ((joint.kind != JointKind::revolute && joint.kind != JointKind::prismatic) || !is_driven[std::size_t(joint.q_index)]) continue;
    (joint.kind == JointKind::revolute ? turns : slides) = true;
  }
  return turns && slides ? " [rad, m]" : turns ? " [rad]" : " [m]";
}

// Of the coordinates those that springs drive; empty where there are no springs, or more than springs.
std::vector<PlotCurves> sprung_coordinates(const Stage& stage, const StagedRun& motion) {
  std::vector<bool> is_driven(std::size_t(motion.chain().nq), false);
  const auto n = std::size_t(motion.chain().nv);
  std::vector<bool> is_sprung(n, false);
  for (const Device& device : devices_of(stage, motion)) {
    if (!device.is_all_of_it()) return {};
    is_sprung[std::size_t(device.drive.freedom)] = true;
    is_driven[std::size_t(motion.chain().bodies[std::size_t(device.body)].joint.q_index)] = true;
  }
  if (std::ranges::none_of(is_sprung, std::identity())) return {};
  const std::vector<double> torques = torques_along(*motion.simulation(), motion.trajectory());
  for (std::size_t at = 0; at < torques.size(); ++at)
    if (torques[at] != 0 && !is_sprung[at % n]) return {};
  std::vector<PlotCurves> plots = curves_of(motion, PlotQuantity::q);
  std::vector<PlotCurve>& curves = plots.front().curves;
  for (std::size_t i = curves.size(); i-- > 0;)
    if (!is_driven[i]) curves.erase(curves.begin() + std::ptrdiff_t(i));
  std::string& title = plots.front().title;
  title = (curves.size() == 1 ? "$" + curves.front().name + "$" : title.substr(0, title.find(" ["))) + unit_of_driven(motion.chain(), is_driven);
  return plots;
}

// Of one run, as long as its axes are those of the whole: a section's are told by nothing else.
Story of_ellipse(const Stage& stage) {
  const EllipseEntry& ellipse = stage.page.ellipse;
  const bool is_section = ellipse.shape == EllipseShape::section && !stage.motions.front().chain().planar;
  if (stage.is_comparison() || is_section) return {};
  return of_all(stage, ellipse.reading == EllipseReading::energy ? PlotQuantity::energy_speed : PlotQuantity::effective_mass);
}

// Of a foot where the ground presses, and between which ends it can. Farther beyond them than half of the foot it leaves the plot, unless
// that is most of what there is: a foot that is about to take off has it at a pole, and no number tells how far it goes.
std::vector<PlotCurves> pressure_on_foot(const StagedRun& motion) {
  constexpr double kBeyondFoot = 0.5;  // lengths of the foot
  const Foot& foot = *motion.simulation()->events->foot;
  const auto plots = make_plots(motion.chain(), {{"cop", "", {}}, {"toe", "", {}}, {"heel", "", {}}}, {}, {}, foot);
  std::vector<PlotCurves> found = plot_curves(*plots, *motion.simulation(), motion.curve_run(), motion.curve_samples());
  PlotCurves told{PlotQuantity::expression, "centre of pressure [m]", false, {}, found.front().formula};
  for (PlotCurves& one : found) told.curves.push_back({one.formula, std::move(one.curves.front().y), one.formula != "cop"});
  PlotCurve& pressure = told.curves.front();
  pressure.name = "";  // the plot's title says it
  const double most = kBeyondFoot * (foot.toe - foot.heel);
  const auto is_beyond = [&](double place) { return place < foot.heel - most || place > foot.toe + most; };
  const auto is_there = [](double place) { return std::isfinite(place); };
  if (2 * std::ranges::count_if(pressure.y, is_beyond) <= std::ranges::count_if(pressure.y, is_there))
    pressure.shown_low = foot.heel - most, pressure.shown_high = foot.toe + most;
  return {told};
}

bool is_of_method(const SceneEntry& entry) {
  constexpr std::array<std::string_view, 5> kKeys = {"method", "step", "tolerance", "order", "accuracy"};
  return std::ranges::find(kKeys, entry.key) != kKeys.end();
}

std::vector<SceneEntry> entries_without_method(const Scene& scene) {
  std::vector<SceneEntry> entries = entries_of(scene);
  std::erase_if(entries, is_of_method);
  return entries;
}

}  // namespace

bool differ_in_method_alone(const Stage& stage) {
  if (!stage.has_cells()) return false;
  const std::vector<SceneEntry> first = entries_without_method(stage.motions.front().scene());
  return std::ranges::all_of(stage.motions, [&first](const StagedRun& motion) { return entries_without_method(motion.scene()) == first; });
}

Story story_of(const Stage& stage, bool is_asked) {
  const auto is_told = [](const StagedRun& motion) { return motion.samples() > 1 && motion.simulation() != nullptr; };
  if (!std::all_of(stage.motions.begin(), stage.motions.end(), is_told) || is_transparent(stage.page) || (stage.shows("mass_matrix") && !is_asked)) return {};
  if (stage.shows("ellipse")) return of_ellipse(stage);
  if (differ_in_method_alone(stage)) return of_all(stage, PlotQuantity::energy_error);
  const StagedRun& first = stage.motions.front();
  const auto is_constrained = [](const StagedRun& motion) { return motion.trajectory().rows > 0; };
  if (std::all_of(stage.motions.begin(), stage.motions.end(), is_constrained)) return of_all(stage, PlotQuantity::lambda);
  if (!stage.is_comparison() && first.has_foot()) return {pressure_on_foot(first)};
  Story sprung;
  for (const StagedRun& motion : stage.motions) sprung.push_back(sprung_coordinates(stage, motion));
  if (std::none_of(sprung.begin(), sprung.end(), [](const auto& plots) { return plots.empty(); })) return sprung;
  return of_all(stage, first.simulation()->torque->drives_are_constant() ? PlotQuantity::energy : PlotQuantity::tau);
}

}  // namespace chainreel
