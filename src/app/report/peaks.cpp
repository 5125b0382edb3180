#include "app/report/peaks.hpp"

#include <algorithm>
#include <cmath>
#include <span>

#include "app/report/report.hpp"
#include "core/csv.hpp"
#include "core/error.hpp"
#include "core/format.hpp"
#include "sim/audit.hpp"
#include "sim/closer_looks.hpp"

namespace chainreel {
namespace {

constexpr int kSamples = 500;       // that the work is known at
constexpr double kInstants = 2000;  // that all else is known at
constexpr std::size_t kLooks = 8'000;  // within steps, together

DataTable table_of(const Simulation& simulation, const Trajectory& run, MotionColumn column) {
  return motion_table(simulation, run, {column});
}

}  // namespace

namespace {

// "qd" of "qd2"; "" of what is no number of a column.
std::string stem_of(const std::string& word) {
  const std::string stem = without_number(word);
  return stem != word && value_named<MotionColumn>(stem) && !value_named<MotionColumn>(word) ? stem : "";
}

// One a number of those columns.
std::vector<std::string> names_in(const Simulation& simulation, const std::vector<MotionColumn>& columns) {
  Trajectory none;
  none.nq = simulation.chain.nq, none.nv = simulation.chain.nv;
  none.rows = int(multiplier_columns(simulation.chain, simulation.constraints.list).size());
  std::vector<std::string> names;
  for (const MotionColumn column : columns)
    for (const DataArray& array : table_of(simulation, none, column).arrays)
      for (const std::string& name : array.columns) names.push_back(name);
  return names;
}

}  // namespace

bool PeaksAsked::hold(const std::string& name) const {
  const std::string plain = ColumnName(name).name, stem = stem_of(plain);
  const auto is_of_column = [&](const std::string& one) { return stem_of(one) == stem; };
  return stem.empty() || std::ranges::none_of(single, is_of_column) || std::ranges::count(single, plain) > 0;
}

PeaksAsked parse_peaks(const std::string& text, const std::string& option) {
  PeaksAsked asked;
  std::string columns;
  std::vector<std::string> stems;
  for (const std::string& word : separated(text, ',')) {
    const std::string stem = stem_of(word);
    if (stem.empty()) {
      columns += (columns.empty() ? "" : ",") + word;
      continue;
    }
    if (std::ranges::count(asked.single, word) > 0) throw Error(ExitCode::usage, option + " names " + word + " twice");
    asked.single.push_back(word);
    if (std::ranges::count(stems, stem) == 0) columns += (columns.empty() ? "" : ",") + stem;
    stems.push_back(stem);
  }
  for (const std::string& word : separated(text, ','))
    if (std::ranges::count(stems, word) > 0) throw Error(ExitCode::usage, option + ": " + word + " holds what it names besides: leave one out");
  asked.columns = parse_columns(columns, option);
  if (std::find(asked.columns.begin(), asked.columns.end(), MotionColumn::t) != asked.columns.end())
    throw Error(ExitCode::usage, option + ": t has no peak; name what goes up and down, like qd,tau,energy_error");
  return asked;
}

void require_peaks(const Simulation& simulation, const PeaksAsked& asked, const std::string& option) {
  require_columns(simulation, asked.columns, option);
  std::vector<std::string> plain;
  for (const std::string& name : names_in(simulation, asked.columns)) plain.push_back(ColumnName(name).name);
  for (const std::string& one : asked.single)
    if (std::ranges::count(plain, one) == 0) throw Error(ExitCode::usage, option + ": the model has no " + one + "; it has " + joined(plain));
}

std::vector<LimitEvent> limits_of_peaks(const Simulation& simulation, const std::vector<std::string>& names, const std::vector<Peak>& peaks, const std::vector<LimitEvent>& seen) {
  std::vector<LimitEvent> passed;
  const auto look = [&](const Joint& joint, const char* quantity, const std::string& symbol, double lower, double upper) {
    const std::string numbered = symbol + std::to_string(joint.v_index + 1), of_joint = symbol + "." + joint.name;  // of a floating base
    const auto name = std::ranges::find_if(names, [&](const std::string& one) { return ColumnName(one).name == numbered || ColumnName(one).name == of_joint; });
    if (name == names.end()) return;
    const Peak& peak = peaks[std::size_t(name - names.begin())];
    const double limit = peak.value > 0 ? upper : lower;
    const bool is_beyond = peak.value > 0 ? peak.value > upper + touched(upper) : peak.value < lower - touched(lower);
    const auto is_same = [&](const LimitEvent& one) { return one.joint == joint.name && one.quantity == quantity; };
    if (is_beyond && std::ranges::none_of(seen, is_same)) passed.push_back({joint.name, quantity, peak.t, peak.value, std::string(quantity) == "position" ? limit : std::abs(limit)});
  };
  const Chain& chain = simulation.chain;
  for (std::size_t b = 1; b < chain.bodies.size(); ++b) {
    const Joint& joint = chain.bodies[b].joint;
    if (joint.kind == JointKind::floating || chain.coordinate_names[std::size_t(joint.v_index)] != joint.name) continue;
    look(joint, "position", "q", joint.limit.lower, joint.limit.upper);
    look(joint, "velocity", "qd", -joint.limit.velocity, joint.limit.velocity);
    look(joint, "effort", "tau", -joint.limit.effort, joint.limit.effort);
  }
  return passed;
}

std::vector<std::string> names_of_peaks(const Simulation& simulation, const PeaksAsked& asked) {
  std::vector<std::string> names = names_in(simulation, asked.columns);
  std::erase_if(names, [&](const std::string& name) { return !asked.hold(name); });
  return names;
}

namespace {

// Between samples the work is no number, and the constraints are as the method's dense output has them.
bool is_seen_between(const Trajectory& run, MotionColumn column) {
  return run.between && column != MotionColumn::work && column != MotionColumn::energy_error && column != MotionColumn::constraint_error;
}

// Its error at the ends of steps, too: what lies between them is that of its dense output besides, as rows of tables have it.
void look_at_steps(const Trajectory& run, Farthest& peak) {
  if (run.energy_at_steps) peak.look(run.energy_at_steps->signed_error, run.energy_at_steps->time);
}

// One number along a run.
struct Course {
  const Trajectory& seen;
  std::span<const double> values;
  std::size_t first, count;  // of how many that stand beside one another

  std::size_t size() const { return values.size() / count; }
  double at(std::size_t k) const { return values[first + k * count]; }
  double time(std::size_t k) const { return seen.t[std::min(k, seen.t.size() - 1)]; }
};

// When it is highest or lowest, and all but so: between samples another peak than theirs may be the farthest. The highest first.
std::vector<Peak> tops_of(const Course& course) {
  constexpr double kAllBut = 0.98;
  constexpr std::size_t kMost = 8;
  std::vector<Peak> tops;
  double farthest = 0;
  for (std::size_t k = 0; k < course.size(); ++k) farthest = std::max(farthest, std::abs(course.at(k)));
  for (std::size_t k = 0; k < course.size(); ++k) {
    const double here = std::abs(course.at(k));
    const bool rises = k == 0 || here > std::abs(course.at(k - 1)), falls = k + 1 == course.size() || here >= std::abs(course.at(k + 1));
    if (farthest > 0 && here >= kAllBut * farthest && rises && falls) tops.push_back({course.at(k), course.time(k)});
  }
  std::stable_sort(tops.begin(), tops.end(), [](const Peak& a, const Peak& b) { return std::abs(a.value) > std::abs(b.value); });
  tops.resize(std::min(tops.size(), kMost));
  return tops;
}

// Where samples of the run lie farther out than `peaks`, those instead. Returns instants to be looked at more closely.
std::vector<double> look_at(const Simulation& simulation, const Trajectory& run, const std::vector<MotionColumn>& columns, std::vector<Farthest>& peaks) {
  std::vector<double> closer;
  std::size_t first = 0;
  for (const MotionColumn column : columns) {
    const Trajectory& seen = is_seen_between(run, column) ? *run.between : run;
    for (const DataArray& array : table_of(simulation, seen, column).arrays) {
      const std::size_t count = array.columns.size();
      peaks.resize(std::max(peaks.size(), first + count), Farthest(simulation.duration));
      for (std::size_t i = 0; i < count; ++i) {
        if (column == MotionColumn::energy_error) look_at_steps(run, peaks[first + i]);
        const std::vector<Peak> tops = tops_of({seen, array.values, i, count});
        for (const Peak& top : tops) {
          closer.push_back(top.t);
          peaks[first + i].look(top.value, top.t);
        }
      }
      first += count;
    }
  }
  return closer;
}

}  // namespace

PeaksOfRun simulate_for_peaks(const Simulation& simulation, const PeaksAsked& asked, const StopRequest& stop) {
  const std::vector<MotionColumn>& columns = asked.columns;
  std::vector<double> times;
  for (int k = 0; k <= kSamples; ++k) times.push_back(simulation.duration * k / kSamples);
  for (double share = 1e-10; share < 1.0 / kSamples; share *= 10) times.push_back(simulation.duration * share);  // what jumps at the start
  std::sort(times.begin(), times.end());
  const bool asks_for_energy = std::find(columns.begin(), columns.end(), MotionColumn::energy_error) != columns.end();
  const double between = simulation.duration / kInstants;
  PeaksOfRun found{asks_for_energy ? simulate_audited(simulation, times, stop, between) : simulate(simulation, times, stop, {}, between), {}};
  std::vector<Farthest> peaks;
  look_at(simulation, found.run, columns, peaks);
  if (is_complete(found.run.status))
    look_closer(simulation, found.run, kLooks, [&](const Trajectory& seen) { return look_at(simulation, seen, columns, peaks); }, stop);
  const std::vector<std::string> names = names_in(simulation, columns);
  for (std::size_t i = 0; i < peaks.size(); ++i)
    if (asked.hold(names[i])) found.peaks.push_back({peaks[i].value(), peaks[i].t()});
  return found;
}

namespace {

NamedPeak named(const std::string& column, const Peak& peak) {
  const ColumnName name(column);
  return {name.name, name.unit, peak};
}

}  // namespace

std::vector<NamedPeak> named(const std::vector<std::string>& names, const std::vector<Peak>& peaks) {
  std::vector<NamedPeak> all;
  for (std::size_t i = 0; i < names.size(); ++i) all.push_back(named(names[i], peaks[i]));
  return all;
}

std::vector<NamedPeak> peaks_of(const DataTable& table) {
  std::vector<NamedPeak> all;
  const std::vector<double>& t = table.arrays.front().values;
  for (std::size_t a = 1; a < table.arrays.size(); ++a) {
    const DataArray& array = table.arrays[a];
    const std::size_t count = array.columns.size();
    for (std::size_t i = 0; i < count; ++i) {
      Farthest peak(t.empty() ? 0 : t.back() - t.front());
      for (std::size_t row = 0; row < table.rows; ++row) peak.look(array.values[row * count + i], t[row]);
      all.push_back(named(array.columns[i], {peak.value(), peak.value() == 0 && !t.empty() ? t.front() : peak.t()}));
    }
  }
  return all;
}

Json to_json(const std::vector<NamedPeak>& peaks) {
  Json all = Json::array();
  for (const NamedPeak& one : peaks) all.push_back({{"name", one.name}, {"unit", one.unit}, {"value", one.peak.value}, {"t", one.peak.t}});
  return all;
}

std::string words_of(const std::vector<NamedPeak>& peaks) {
  constexpr int kDigits = 6;
  // Stamps that count from 1970 have ten digits in front of the point.
  const auto instant = [&](double t) { return format_significant(t, std::max(kDigits, int(std::ceil(std::log10(std::abs(t) + 1))) + 4)); };
  std::vector<std::vector<std::string>> table{{"peak of", "value", "at t, s"}};
  for (const NamedPeak& one : peaks)
    table.push_back({one.name, format_significant(one.peak.value, kDigits) + (one.unit.empty() ? "" : " " + one.unit), instant(one.peak.t)});
  return table_text(table);
}

}  // namespace chainreel
