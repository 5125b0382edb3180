#include "sim/choice/curve_deviation.hpp"

#include <algorithm>
#include <cmath>

#include "core/format.hpp"
#include "core/scalar.hpp"
#include "sim/system/chain_system.hpp"
#include "sim/torques_along.hpp"

namespace chainreel {
namespace {

constexpr double kPixelsOfCurves = 100;  // in which a curve's range is as fine as the page is in its pixels
constexpr double kLeastShare = 0.1;      // of its plot's range: a curve that moves less is judged by so much
constexpr double kConstant = 1e-9;       // of the size of the numbers: what moves less is a constant, as on axes of plots,
constexpr double kOfConstant = 0.2;      // and drawn over this part of its size
constexpr double kJump = 0.2;            // of the unit from a sample to the next: nobody knows on which side a sample lies

// What tables hold of every run, and what a film may plot that names no plot.
std::shared_ptr<const PlotSet> own_plots(const Simulation& simulation, int rows) {
  std::vector<PlotEntry> entries;
  for (const char* name : {"q", "qd", "tau"}) entries.push_back({name, "", {}});
  if (rows > 0) entries.push_back({"lambda", "", {}});
  if (simulation.torque->is_constant()) entries.push_back({"energy", "", {}});
  return make_plots(simulation.chain, entries, {}, {}, {}, rows);
}

// The scene's others. The energy's error is that of the method itself: it has no true curve but zero.
std::shared_ptr<const PlotSet> named_plots(const Simulation& simulation) {
  if (!simulation.plots) return nullptr;
  auto others = std::make_shared<PlotSet>(*simulation.plots);
  std::erase_if(others->list, [&](const PlotSet::Plot& plot) {
    const bool is_energy = plot.quantity == PlotQuantity::energy && !simulation.torque->is_constant();
    return plot.quantity != PlotQuantity::expression && !is_energy;
  });
  return others->list.empty() ? nullptr : others;
}

// Runs of a choice come without them.
void add_multipliers(const Simulation& simulation, Trajectory& run) {
  ChainSystem system(simulation);
  run.lambda.clear();
  for (int k = 0; k < run.size(); ++k) {
    const double t = run.t[std::size_t(k)];
    hold_as_then(system, simulation, run, t);
    system.constrained()->look(system.workspace(), run.q_at(k), run.qd_at(k), system.applied_torque(t, run.q_at(k), run.qd_at(k)));
    const ConstVec lambda = system.constrained()->lambda();
    run.lambda.insert(run.lambda.end(), lambda.begin(), lambda.end());
  }
  simulation.torque->leave_pieces();
}

struct Range {
  double low = kInfinity, high = -kInfinity;
  void extend(const std::vector<double>& numbers) {
    for (const double y : numbers)
      if (std::isfinite(y)) low = std::min(low, y), high = std::max(high, y);
  }
  double span() const { return low <= high ? high - low : 0; }
  double size() const { return low <= high ? std::max(std::abs(low), std::abs(high)) : 0; }
};

}  // namespace

double share_of_curves(const Accuracy& accuracy, const MotionSize& size) {
  const PictureSize& picture = size.bodies;
  switch (accuracy.unit) {
    case AccuracyUnit::px:
      return accuracy.value / kPixelsOfCurves;
    case AccuracyUnit::m:
      return accuracy.value / (picture.metres_per_px * kPixelsOfCurves);
    case AccuracyUnit::rad:
    case AccuracyUnit::relative:
      break;
  }
  return accuracy.value * picture.diagonal / (picture.metres_per_px * kPixelsOfCurves);
}

CurveDeviation::CurveDeviation(const Simulation& simulation, const ChoiceReference& reference, double allowed)
    : simulation_(simulation),
      samples_(std::min(reference.samples, reference.other.size())),
      own_(own_plots(simulation, reference.run.rows)),
      named_(named_plots(simulation)) {
  std::vector<PlotCurves> first = curves_along(reference.run);
  const std::vector<PlotCurves> second = curves_along(reference.other);
  set_units(first);
  double worst = 0;
  std::size_t at = 0;
  for (const PlotCurves& plot : second)
    for (const PlotCurve& other : plot.curves) {
      Curve& curve = curves_[at++];
      for (int k = 0; k < samples_; ++k) {
        double own = apart(curve, other.y[std::size_t(k)], k) / curve.unit;
        if (!(own <= kShareOfReference * allowed)) {
          if (own > worst || !std::isfinite(own)) {
            worst = own;
            remark_ = "of " + curve.name + " two references lie " + format_significant(100 * own, 2) +
                      " % of its range apart at t = " + format_significant(reference.run.t[std::size_t(k)], 4) +
                      " s: where they do nothing is said of it";
          }
          own = kInfinity;
        }
        curve.own.push_back(own);
      }
    }
}

std::vector<PlotCurves> CurveDeviation::curves_along(const Trajectory& run) const {
  Trajectory with_multipliers;
  const Trajectory* known = &run;
  if (run.rows > 0) {
    with_multipliers = run;
    add_multipliers(simulation_, with_multipliers);
    known = &with_multipliers;
  }
  std::vector<PlotCurves> all = plot_curves(*own_, simulation_, *known, samples_);
  if (!named_) return all;
  std::vector<PlotCurves> more = plot_curves(*named_, simulation_, *known, samples_);
  std::move(more.begin(), more.end(), std::back_inserter(all));
  return all;
}

// Curves of one plot share its axis, and what is small beside the others is a flat line there.
void CurveDeviation::set_units(std::vector<PlotCurves>& plots) {
  for (PlotCurves& plot : plots) {
    Range all;
    for (const PlotCurve& curve : plot.curves) all.extend(curve.y);
    const bool is_constant = all.span() <= kConstant * all.size();
    const double shared = all.size() <= kRoundedZero ? 1 : !is_constant ? all.span() : kOfConstant * all.size();
    for (PlotCurve& curve : plot.curves) {
      Range own;
      own.extend(curve.y);
      const bool may_jump = plot.quantity != PlotQuantity::q && plot.quantity != PlotQuantity::qd;
      const double unit = std::max(own.span(), kLeastShare * shared);
      curves_.push_back({curve.name.empty() ? plot.title : curve.name, may_jump, unit, std::move(curve.y), {}});
    }
  }
}

// From the reference's k-th number; none where the reference jumps there, and this is nearer to the other side.
double CurveDeviation::apart(const Curve& curve, double y, int k) const {
  const auto at = std::size_t(k);
  const double exact = curve.y[at], off = std::abs(y - exact);
  if (!std::isfinite(exact)) return std::isfinite(y) ? kInfinity : 0;
  if (!std::isfinite(y)) return kInfinity;
  if (curve.may_jump)
    for (const std::size_t beside : {at > 0 ? at - 1 : at, at + 1 < curve.y.size() ? at + 1 : at})
      if (std::abs(curve.y[beside] - exact) > kJump * curve.unit && std::abs(curve.y[beside] - y) < off) return 0;
  return off;
}

CurveDeviation::Worst CurveDeviation::largest(const Trajectory& run) const {
  Worst worst;
  std::size_t at = 0;
  for (const PlotCurves& plot : curves_along(run))
    for (const PlotCurve& other : plot.curves) {
      const Curve& curve = curves_[at++];
      for (int k = 0; k < samples_; ++k) {
        const double own = curve.own[std::size_t(k)];
        if (std::isinf(own)) continue;
        const double share = apart(curve, other.y[std::size_t(k)], k) / curve.unit + own;
        if (share > worst.share) worst = {share, curve.name};
      }
    }
  return worst;
}

}  // namespace chainreel
