#include "sim/choice/choice_reference.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/error.hpp"
#include "core/format.hpp"
#include "core/parallel.hpp"
#include "sim/choice/quad_reference.hpp"

namespace chainreel {
namespace {

// The share of the budget that one run may take. What methods may do between the samples is bounded: steps of
// this part of the distance of samples see what comes and goes within it. The second reference's steps end
// elsewhere.
constexpr double kShareOfRun = 0.12;
constexpr double kReferenceStep = 0.5, kOtherStep = 0.31;
// Two of different kinds that agree so far within what is asked for are enough, though neither is as exact as can be.
constexpr double kShareOfQuick = 0.01;
constexpr double kQuickTolerances[] = {1e-10, 1e-9};  // of dop853 and radau5
constexpr int kEvaluationsOfStep = 12;  // of dop853
// A reference of another kind is less exact: it is contradicted only by what its own error does not explain.
constexpr double kExplained = 10;
constexpr double kOtherKind[] = {1e-8, 1e-10, 1e-12};
// Where doubles part, the series with twice their digits goes on; it starts where they are this part of what is allowed apart.
constexpr double kShareOfSeries = 0.05;
constexpr int kSeriesOrders[] = {40, 32};
constexpr double kSeriesTolerances[] = {1e-25, 1e-21};
constexpr double kCostOfSeries = 30;  // in those of doubles, of that order
constexpr std::size_t kSamplesOfSeries = 32;  // that both orders go on before they are compared
constexpr double kRounding = 0x1p-52;
constexpr double kRoundings = 8;  // that places of a few joints gather

bool came_to_an_end(const Trajectory& run) {
  switch (run.status) {
    case RunStatus::step_too_small:
    case RunStatus::not_converged:
    case RunStatus::out_of_budget:
    case RunStatus::interrupted:
      return false;
    default:
      return true;
  }
}

struct Witness {
  MethodSetting setting;
  Trajectory run;
};

class Finder {
 public:
  Finder(CountedRuns& runs, const Accuracy& accuracy, std::span<const double> times)
      : runs_(runs), simulation_(runs.simulation()), accuracy_(accuracy), times_(times) {
    // A step as short as asked for, unless the whole run would then cost too much.
    const double distance = times.size() > 1 ? simulation_.duration / double(times.size() - 1) : simulation_.duration;
    const MethodSetting setting{&find_method("dop853"), {1e-14, 0}, 0};
    const double affordable = kShareOfRun * runs.budget() / (2 * kEvaluationsOfStep * runs.price_of_evaluation(setting));
    longest_step_ = std::max(distance, simulation_.duration / std::max(affordable, 1.0));
  }

  std::optional<ChoiceReference> find_quickly() {
    if (takes("taylor") || !takes("radau5")) return {};  // a series is quicker still, and exact
    Witness first{{&find_method("dop853"), {kQuickTolerances[0], 0}, 0}, {}};
    Witness second{{&find_method("radau5"), {kQuickTolerances[1], 0}, 0}, {}};
    first.run = run(first.setting, kReferenceStep);
    if (!is_complete(first.run.status)) return {};
    second.run = run(second.setting, kOtherStep);
    if (!is_complete(second.run.status)) return {};
    ChoiceReference reference;
    reference.is_quick = true;
    reference.setting = first.setting;
    reference.size = motion_size(simulation_, first.run);
    deviation_.emplace(simulation_, accuracy_, reference.size);
    compare(first, second, reference);
    const auto& apart = reference.uncertainty;
    if (!reference.is_whole || *std::max_element(apart.begin(), apart.end()) > kShareOfQuick * accuracy_.value) return {};
    reference.attainable.reset();
    reference.run = std::move(first.run);
    reference.other = std::move(second.run);
    return reference;
  }

  ChoiceReference find() {
    const auto [first, second] = two_witnesses();
    if (runs_.is_stopped() || first.run.size() == 0) return {};
    ChoiceReference reference;
    reference.setting = first.setting;
    reference.size = motion_size(simulation_, first.run);
    deviation_.emplace(simulation_, accuracy_, reference.size);
    require_doubles_hold(first.run);
    const bool end_alike = compare(first, second, reference);
    if (first.setting.method == second.setting.method) ask_another_kind(first, reference);
    reference.run = first.run;
    reference.other = second.run;
    if (!end_alike && !reference.is_whole && first.setting.method->form == Form::series && came_to_an_end(first.run))
      go_on_in_series(reference);
    if (reference.has_parted && reference.samples < 2 && !runs_.is_stopped()) refuse(reference);
    return reference;
  }

 private:
  bool takes(const char* name) { return takes_the_chain(simulation_, find_method(name)); }

  // From the most exact on; the series first, since it shares no text with the others.
  std::vector<MethodSetting> witnesses() {
    std::vector<MethodSetting> list;
    const auto add = [&](const char* name, std::initializer_list<double> tolerances, int order = 0) {
      if (!takes(name)) return;
      for (const double tolerance : tolerances) list.push_back({simulation_.method, {tolerance, order}, 0});
    };
    add("taylor", {1e-15}, 24);
    add("dop853", {1e-14, 1e-12, 1e-10});
    add("radau5", {1e-11, 1e-9});
    return list;
  }

  Trajectory run(const MethodSetting& setting, double step) {
    // A series knows its torque as a whole: nothing can hide in a step.
    const bool is_series = setting.method->form == Form::series;
    return runs_.run(setting, times_, kShareOfRun * runs_.budget(), is_series ? 0 : step * longest_step_);
  }

  // The first two that come to an end; else the two that come furthest.
  std::pair<Witness, Witness> two_witnesses() {
    std::vector<Witness> ended, others;
    const Method* too_dear = nullptr;
    for (const MethodSetting& setting : witnesses()) {
      if (ended.size() == 2 || runs_.is_stopped()) break;
      if (setting.method == too_dear) continue;
      Witness one{setting, run(setting, ended.empty() ? kReferenceStep : kOtherStep)};
      if (one.run.status == RunStatus::out_of_budget) too_dear = setting.method;
      (came_to_an_end(one.run) ? ended : others).push_back(std::move(one));
    }
    std::stable_sort(others.begin(), others.end(),
                     [](const Witness& a, const Witness& b) { return a.run.size() > b.run.size(); });
    for (Witness& one : others)
      if (ended.size() < 2) ended.push_back(std::move(one));
    if (ended.size() < 2) ended.resize(2, ended.empty() ? Witness{} : ended.front());
    return {std::move(ended[0]), std::move(ended[1])};
  }

  // Places and angles are rounded however exact a run is.
  void require_doubles_hold(const Trajectory& run) {
    const double rounding = kRoundings * kRounding * deviation_->largest_number(run);
    if (accuracy_.value >= rounding) return;
    throw Error(ExitCode::numerical,
                "'accuracy': " + to_string(accuracy_) + " is below what doubles hold: the rounding of what is drawn "
                    "comes to " + format_significant(rounding, 2) + " " + to_string(accuracy_.unit) + " here. Ask for at least " +
                    format_significant(100 * rounding, 2) + " " + to_string(accuracy_.unit));
  }

  // Whether both go the same way until the same end. It may be that of the run alone: a failure is no whole one.
  bool compare(const Witness& first, const Witness& second, ChoiceReference& reference) {
    const int both = std::min(first.run.size(), second.run.size());
    const bool same_end = came_to_an_end(first.run) && first.run.status == second.run.status;
    reference.how = to_string(first.setting) + " beside " + to_string(second.setting);
    double largest = 0;
    bool parted = false;
    for (int k = 0; k < both; ++k) {
      const double apart = deviation_->at(first.run, second.run, k);
      largest = std::max(largest, apart);
      if (parted) continue;
      if (apart > kShareOfReference * accuracy_.value) {
        parted = reference.has_parted = true;
        reference.why_no_further = parting_text(first.setting, second.setting, k, apart);
        continue;
      }
      reference.uncertainty.push_back(apart);
    }
    reference.samples = int(reference.uncertainty.size());
    reference.is_whole = !parted && same_end && is_complete(first.run.status);
    if (same_end && std::isfinite(largest)) reference.attainable = largest / kShareOfReference;
    if (parted || reference.is_whole) return !parted;
    if (same_end) {
      reference.why_no_further = "there the motion itself ends: " + first.run.trouble;
      return true;
    }
    const Trajectory& shorter = first.run.end_time <= second.run.end_time ? first.run : second.run;
    const Witness& one = &shorter == &first.run ? first : second;
    const Witness& other = &shorter == &first.run ? second : first;
    reference.why_no_further =
        came_to_an_end(one.run) ? "there the run with " + to_string(one.setting) + " ends (" + one.run.trouble +
                                      "), but that with " + to_string(other.setting) + " does not"
                                : "no reference goes further: " + one.run.trouble + " with " + to_string(one.setting);
    return false;
  }

  std::string parting_text(const MethodSetting& a, const MethodSetting& b, int k, double apart) const {
    return "at t = " + format_significant(times_[std::size_t(k)], 4) + " s two references, " + to_string(a) + " and " +
           to_string(b) + ", lie " + format_significant(apart, 2) + " " + to_string(accuracy_.unit) +
           " apart, and which of them is right is not known";
  }

  // Two runs of one kind may share a mistake.
  void ask_another_kind(const Witness& first, ChoiceReference& reference) {
    if (!takes(first.setting.method->name == "radau5" ? "dop853" : "radau5")) return;
    const Method* const method = simulation_.method;
    std::optional<Trajectory> coarser;
    for (const double tolerance : kOtherKind) {
      const MethodSetting setting{method, {tolerance, 0}, 0};
      Trajectory other = run(setting, kReferenceStep);
      if (!came_to_an_end(other)) return;
      const std::optional<int> parting = contradiction(first.run, other, coarser, reference.samples);
      if (!parting) {
        reference.how += " and " + to_string(setting);
        return;
      }
      if (tolerance == kOtherKind[std::size(kOtherKind) - 1]) {
        const bool has_sample = *parting < other.size();
        reference.why_no_further =
            has_sample ? parting_text(first.setting, setting, *parting, deviation_->at(first.run, other, *parting))
                       : "there the run with " + to_string(setting) + " ends (" + other.trouble + "), but that with " +
                             to_string(first.setting) + " does not";
        reference.samples = *parting;
        reference.uncertainty.resize(std::size_t(*parting));
        reference.is_whole = false;
        reference.has_parted = true;
        reference.attainable.reset();
      }
      coarser = std::move(other);
    }
  }

  // The first sample that lies further from the other kind's than its own error explains.
  std::optional<int> contradiction(const Trajectory& run, const Trajectory& other,
                                   const std::optional<Trajectory>& coarser, int samples) {
    double own = 0;
    for (int k = 0; k < samples; ++k) {
      if (k >= other.size()) return k;
      if (coarser && k < coarser->size()) own = std::max(own, deviation_->at(other, *coarser, k));
      const double apart = deviation_->at(run, other, k);
      if (apart > std::max(kShareOfReference * accuracy_.value, kExplained * own)) return k;
    }
    return {};
  }

  // Behind the parting of doubles the series with twice their digits, at two orders, shows how long the first run stays
  // within what is asked for; further than that no candidate will be judged.
  void go_on_in_series(ChoiceReference& reference) {
    const double ns = kCostOfSeries * runs_.cost_of({reference.setting.method, {0, kSeriesOrders[0]}, 0}, 1, 1);
    const long most = long(kShareOfRun * runs_.budget() / ns);
    std::array<LongSeries<DoubleDouble>, 2> series = {series_of(0, most), series_of(1, most)};
    const Trajectory doubles = reference.run;
    Trajectory other = reference.run;
    const std::array<Trajectory*, 2> rows = {&reference.run, &other};
    const std::size_t parted = reference.uncertainty.size();
    std::size_t k = 0;
    while (k < parted && reference.uncertainty[k] <= kShareOfSeries * accuracy_.value) ++k;
    std::vector<double> uncertainty(reference.uncertainty.begin(), reference.uncertainty.begin() + std::ptrdiff_t(k));
    std::copy_n(reference.other.q.begin(), k * std::size_t(other.nq), other.q.begin());
    std::copy_n(reference.other.qd.begin(), k * std::size_t(other.nv), other.qd.begin());
    bool left = false, go_on = true;
    while (k < std::size_t(doubles.size()) && !left && go_on) {
      const std::size_t behind = std::min(k + kSamplesOfSeries, std::size_t(doubles.size()));
      std::array<std::size_t, 2> reached{};
      for_each_index(2, 2, [&](std::size_t i) {
        for (reached[i] = k; reached[i] < behind && series[i].run_to(times_[reached[i]]); ++reached[i])
          put_row(series[i], reached[i], *rows[i]);
      });
      const std::size_t both = std::min(reached[0], reached[1]);
      go_on = both == behind;
      for (; k < both && !left; ++k) {
        const double own = deviation_->at(reference.run, other, int(k));
        left = deviation_->at(reference.run, doubles, int(k)) + own > accuracy_.value;
        if (!left) uncertainty.push_back(own);
      }
    }
    runs_.spend(ns * double(series[0].expansions() + series[1].expansions()));
    if (uncertainty.size() <= parted) {  // that ended before the doubles parted
      reference.run = doubles;
      return;
    }
    reference.other = std::move(other);
    reference.uncertainty = std::move(uncertainty);
    reference.samples = int(reference.uncertainty.size());
    reference.how += ", then the series with twice the digits of doubles";
    reference.is_whole = reference.samples == doubles.size() && doubles.status == RunStatus::finished;
    reference.why_no_further.clear();
    if (left)
      reference.why_no_further = "at t = " + format_significant(times_[reference.uncertainty.size()], 4) + " s " +
                                 to_string(reference.setting) +
                                 ", the most exact run that was tried, has left the motion that twice the digits of "
                                 "doubles give by more than that";
    else if (!reference.is_whole)
      reference.why_no_further = "the search with twice the digits of doubles went no further";
  }

  LongSeries<DoubleDouble> series_of(int which, long most) const {
    LongSeries<DoubleDouble> series(simulation_.chain, *simulation_.torque->affine(), kSeriesOrders[which], kSeriesTolerances[which]);
    series.start(0, {simulation_.q0.begin(), simulation_.q0.end()}, {simulation_.qd0.begin(), simulation_.qd0.end()});
    series.set_limits({}, most);
    return series;
  }

  static void put_row(const LongSeries<DoubleDouble>& series, std::size_t k, Trajectory& run) {
    const auto n = std::size_t(run.nq);
    for (std::size_t i = 0; i < n; ++i) {
      run.q[k * n + i] = double(series.q()[i]);
      run.qd[k * n + i] = double(series.v()[i]);
    }
  }

  [[noreturn]] void refuse(const ChoiceReference& reference) const {
    std::string text = "'accuracy': " + to_string(accuracy_) + " cannot be promised for a single frame: " +
                       reference.why_no_further + ". ";
    text += reference.attainable && *reference.attainable > accuracy_.value
                ? "Ask for " + format_significant(2 * *reference.attainable, 1) + " " + to_string(accuracy_.unit) +
                      " or more, or name a method"
                : "Ask for less, or name a method";
    throw Error(ExitCode::numerical, text);
  }

  CountedRuns& runs_;
  Simulation& simulation_;
  Accuracy accuracy_;
  std::span<const double> times_;
  double longest_step_ = 0;  // s
  std::optional<Deviation> deviation_;
};

}  // namespace

std::optional<ChoiceReference> find_quick_reference(CountedRuns& runs, const Accuracy& accuracy, std::span<const double> times) {
  return Finder(runs, accuracy, times).find_quickly();
}

ChoiceReference find_reference(CountedRuns& runs, const Accuracy& accuracy, std::span<const double> times) {
  return Finder(runs, accuracy, times).find();
}

}  // namespace chainreel
