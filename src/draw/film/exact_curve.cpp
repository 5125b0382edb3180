#include "draw/film/exact_curve.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <span>

#include "core/format.hpp"

namespace chainreel {
namespace {

constexpr double kConfirmed = 2e-3;  // of a curve's range, by which references may differ: half of what a line is thick
constexpr double kConstant = 1e-6;   // of its size: a curve whose range is less is its rounding
constexpr double kSeenApart = 1e-2;  // ... by which a run leaves the exact curve: two lines beside each other
constexpr double kSameInstant = 1e-9;  // s
constexpr double kExactLine = 0.0025;  // units of H: a secondary one
constexpr char kName[] = "exact";

// Where a curve is at t, between its points on a straight line; no number where it is not known.
double value_at(std::span<const double> times, std::span<const double> values, double t) {
  const auto next = std::size_t(std::lower_bound(times.begin(), times.end(), t - kSameInstant) - times.begin());
  if (next >= std::min(times.size(), values.size())) return NAN;
  if (times[next] <= t + kSameInstant || next == 0) return values[next];
  const double s = (t - times[next - 1]) / (times[next] - times[next - 1]);
  return (1 - s) * values[next - 1] + s * values[next];
}

double range_of(std::span<const double> values) {
  double size = 0;
  for (const double value : values)
    if (std::isfinite(value)) size = std::max(size, std::abs(value));
  return std::max(span_of(values), kConstant * size);
}

// How many of its points the other one confirms.
std::size_t confirmed(std::span<const double> times, std::span<const double> values, std::span<const double> other_times, std::span<const double> others) {
  const double span = range_of(values);
  const std::size_t count = std::min(times.size(), values.size());
  for (std::size_t k = 0; k < count; ++k)
    if (!(std::abs(values[k] - value_at(other_times, others, times[k])) <= kConfirmed * span) && std::isfinite(values[k])) return k;
  return count;
}

// Whether a run's curve lies on the exact one as far as that is known.
bool lies_on(const StripCurve& curve, std::span<const double> times, std::span<const double> values) {
  std::vector<double> both(values.begin(), values.end());
  for (const Point& p : curve.points) both.push_back(p.y);
  const double span = range_of(both);
  return std::ranges::all_of(curve.points, [&](const Point& p) {
    const double exact = value_at(times, values, p.x);
    return !std::isfinite(exact) || std::abs(p.y - exact) <= kSeenApart * span;
  });
}

}  // namespace

std::optional<StripRun> exact_run(const Stage& stage) {
  const StagedRun& first = stage.motions.front();
  if (first.references().size() < 2 || first.simulation() == nullptr) return std::nullopt;
  const Trajectory &run = curve_run_of(first.references()[0]), &other = curve_run_of(first.references()[1]);
  StripRun exact{kName, false, {}, plot_curves(*first.simulation(), run, int(run.t.size()))};
  const std::vector<PlotCurves> others = plot_curves(*first.simulation(), other, int(other.t.size()));
  for (std::size_t i = 0; i < exact.plots.size(); ++i) {
    std::size_t known = run.t.size();
    for (std::size_t c = 0; c < exact.plots[i].curves.size(); ++c)
      known = std::min(known, confirmed(run.t, exact.plots[i].curves[c].y, other.t, others[i].curves[c].y));
    exact.times.emplace_back(run.t.begin(), run.t.begin() + std::ptrdiff_t(known));
    for (PlotCurve& curve : exact.plots[i].curves) curve.y.resize(std::min(known, curve.y.size()));
  }
  return exact;
}

void add_exact(StripData& data, const StripRun& exact, std::size_t i, const Theme& theme) {
  const PlotCurves& plot = exact.plots[i];
  if (plot.quantity == PlotQuantity::energy_error || exact.times[i].empty()) return;  // nothing is wrong with what is exact
  // Of energies a comparison shows the sum alone.
  const std::size_t from = plot.quantity == PlotQuantity::energy ? plot.curves.size() - 1 : 0, count = plot.curves.size() - from;
  const std::vector<double>& t = exact.times[i];
  for (std::size_t c = 0; c + count <= data.curves.size(); c += count) {
    bool is_exact = true;
    for (std::size_t part = 0; part < count; ++part) is_exact = is_exact && lies_on(data.curves[c + part], t, plot.curves[from + part].y);
    if (is_exact) return;
  }
  std::vector<StripCurve> lines;
  const bool ends_early = t.back() < data.end * (1 - kConfirmed);
  for (std::size_t part = 0; part < count; ++part) {
    const PlotCurve& curve = plot.curves[from + part];
    if (curve.is_bound) continue;
    StripCurve line{count > 1 ? curve.name + ", " + kName : kName, {theme.ink, theme.lines * kExactLine, Dash(part % 4), Marker::none}, {}, true};
    if (ends_early) line.label += " until " + format_significant(t.back(), 2) + " s";
    line.words_above = "thin: " + line.label;
    for (std::size_t k = 0; k < std::min(t.size(), curve.y.size()) && t[k] <= data.end + kSameInstant; ++k) line.points.push_back({t[k], curve.y[k]});
    lines.push_back(std::move(line));
  }
  // Runs lie over it, in their own colours.
  for (StripCurve& run : data.curves) run.covers = true;
  data.curves.insert(data.curves.begin(), std::make_move_iterator(lines.begin()), std::make_move_iterator(lines.end()));
}

}  // namespace chainreel
