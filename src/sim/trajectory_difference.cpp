#include "sim/trajectory_difference.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "core/change_words.hpp"
#include "core/format.hpp"

namespace chainreel {
namespace {

constexpr double kAbsolute = 1e-12;  // rad, m and their rates
constexpr double kSameTime = 1e-9;   // of 1 s and of the instant itself
constexpr double kSameMotion = 1e-8;   // of 1 and of a number's range

constexpr char kQuaternion[] = "quaternion";

bool is_same_time(double a, double b) {
  return std::abs(a - b) <= kSameTime * (1 + std::abs(a));
}

// Not numbers are alike.
double distance(double a, double b) {
  if (std::isnan(a) && std::isnan(b)) return 0;
  if (a == b) return 0;
  const double far = std::abs(a - b);
  return std::isnan(far) ? std::numeric_limits<double>::infinity() : far;
}

// Angle of the rotation from one quaternion (x y z w, of any length) to another, either sign of which means
// the same.
double angle_between(const double* a, const double* b) {
  const double w = a[0] * b[0] + a[1] * b[1] + a[2] * b[2] + a[3] * b[3];
  const double x = a[3] * b[0] - a[0] * b[3] - a[1] * b[2] + a[2] * b[1];
  const double y = a[3] * b[1] - a[1] * b[3] - a[2] * b[0] + a[0] * b[2];
  const double z = a[3] * b[2] - a[2] * b[3] - a[0] * b[1] + a[1] * b[0];
  return 2 * std::atan2(std::hypot(x, y, z), std::abs(w));
}

// Samples that both have.
using Instants = std::vector<std::pair<std::size_t, std::size_t>>;
Instants shared_instants(const std::vector<double>& before, const std::vector<double>& after) {
  Instants shared;
  for (std::size_t i = 0, k = 0; i < before.size() && k < after.size();) {
    if (is_same_time(before[i], after[k]))
      shared.push_back({i++, k++});
    else
      ++(before[i] < after[k] ? i : k);
  }
  return shared;
}

// The numbers of q, or of qd, of both.
struct Columns {
  const std::vector<SampledNumber>& numbers;
  const std::vector<double>& values;

  const double* at(std::size_t sample, std::size_t number) const {
    return &values[sample * numbers.size() + number];
  }
};

struct Parting {
  FreedomDifference freedom;
  double by_range = 0;  // how far at the first instant, for the range
};

std::vector<FreedomDifference> partings(const Columns& before, const Columns& after,
                                        const std::vector<double>& t, const Instants& instants, double of_range) {
  std::vector<Parting> found;
  for (std::size_t i = 0; i < after.numbers.size(); ++i) {
    const bool turns = after.numbers[i].unit == kQuaternion && i + 3 < after.numbers.size();
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (const auto& [a, b] : instants)
      for (const double x : {*before.at(a, i), *after.at(b, i)})
        if (std::isfinite(x)) low = std::min(low, x), high = std::max(high, x);
    // Numbers of either sign may lie farther apart than any number is large, which no tolerance holds.
    constexpr double kLargest = std::numeric_limits<double>::max();
    const double range = turns ? 1 : std::clamp(high - low, 0.0, kLargest);
    const double tolerance = std::clamp(of_range * range, kAbsolute, kLargest);
    Parting one{{after.numbers[i].label, turns ? "rad" : after.numbers[i].unit}, -1};
    one.freedom.range = range;
    for (const auto& [a, b] : instants) {
      const double far = turns ? angle_between(before.at(a, i), after.at(b, i))
                               : distance(*before.at(a, i), *after.at(b, i));
      if (far > tolerance && one.by_range < 0)
        one.freedom.first_time = t[b], one.freedom.at_first = far,
        one.by_range = far / std::max(range, kAbsolute);
      if (far > one.freedom.largest) one.freedom.largest = far, one.freedom.largest_time = t[b];
    }
    if (one.by_range >= 0) found.push_back(one);
    if (turns) i += 3;
  }
  std::stable_sort(found.begin(), found.end(), [](const Parting& a, const Parting& b) {
    return a.freedom.first_time != b.freedom.first_time ? a.freedom.first_time < b.freedom.first_time
                                                        : a.by_range > b.by_range;
  });
  std::vector<FreedomDifference> freedoms;
  for (Parting& one : found) freedoms.push_back(std::move(one.freedom));
  return freedoms;
}

std::vector<std::string> labels_of(const std::vector<SampledNumber>& numbers) {
  std::vector<std::string> labels;
  for (const SampledNumber& number : numbers)
    if (labels.empty() || labels.back() != number.label) labels.push_back(number.label);
  return labels;
}

std::string time_text(double t) {
  return "t = " + format_significant(t, 6) + " s";
}

// Each event by its first occurrence; then how often.
void compare_events(const SampledTrajectory& before, const SampledTrajectory& after,
                    std::vector<std::string>& words) {
  struct Course {
    std::vector<double> before, after;
  };
  std::map<std::string, Course> courses;
  for (const SampledEvent& event : before.events) courses[event.name].before.push_back(event.t);
  for (const SampledEvent& event : after.events) courses[event.name].after.push_back(event.t);
  for (const auto& [name, course] : courses) {
    const std::string event = "event " + name + ": ";
    if (course.after.empty())
      words.push_back(event + "does not happen any more (was at " + time_text(course.before.front()) + ")");
    else if (course.before.empty())
      words.push_back(event + "happens now, at " + time_text(course.after.front()));
    else if (course.before.size() != course.after.size())
      words.push_back(event + "happens " +
                      change_text(std::to_string(course.before.size()), std::to_string(course.after.size())) +
                      " times");
    else
      for (std::size_t i = 0; i < course.after.size(); ++i) {
        if (is_same_time(course.before[i], course.after[i])) continue;
        words.push_back(event + "at t = " + change_text(course.before[i], course.after[i], "s"));
        break;
      }
  }
}

}  // namespace

SampledTrajectory sampled(const Chain& chain, const Trajectory& trajectory, int most) {
  SampledTrajectory result;
  const bool is_plain = chain.serial && !chain.has_floating;
  const std::vector<std::string> names = position_names(chain);
  for (int i = 0; i < chain.nq; ++i)
    result.q_numbers.push_back(
        {is_plain ? "q" + std::to_string(i + 1) + " (" + names[std::size_t(i)] + ")" : names[std::size_t(i)],
         ""});
  for (int i = 0; i < chain.nv; ++i) {
    const std::string& name = chain.coordinate_names[std::size_t(i)];
    result.qd_numbers.push_back(
        {is_plain ? "qd" + std::to_string(i + 1) + " (" + name + ")" : "rate of " + name, ""});
  }
  for (std::size_t b = 1; b < chain.bodies.size(); ++b) {
    const Joint& joint = chain.bodies[b].joint;
    const auto q = std::size_t(joint.q_index), v = std::size_t(joint.v_index);
    if (joint.ratio != 1 || joint.offset != 0) continue;  // it reads another joint's coordinate
    if (joint.kind != JointKind::floating) {
      const bool turns = joint.kind == JointKind::revolute;
      result.q_numbers[q].unit = turns ? "rad" : "m";
      result.qd_numbers[v].unit = turns ? "rad/s" : "m/s";
      continue;
    }
    for (std::size_t k = 0; k < 3; ++k) {
      result.q_numbers[q + k].unit = "m";
      result.qd_numbers[v + k].unit = "m/s";
      result.qd_numbers[v + 3 + k].unit = "rad/s";
    }
    for (std::size_t k = 3; k < 7; ++k) result.q_numbers[q + k] = {"rotation of " + joint.name, kQuaternion};
  }
  result.status = to_string(trajectory.status);
  result.end_time = trajectory.end_time;
  int stride = 1;
  while ((trajectory.size() - 1) / stride + 2 > most) stride *= 2;
  for (int k = 0; k < trajectory.size(); ++k) {
    if (k % stride != 0 && k + 1 != trajectory.size()) continue;
    result.t.push_back(trajectory.t[std::size_t(k)]);
    result.q.insert(result.q.end(), trajectory.q_at(k).begin(), trajectory.q_at(k).end());
    result.qd.insert(result.qd.end(), trajectory.qd_at(k).begin(), trajectory.qd_at(k).end());
  }
  return result;
}

void join_rotations(std::vector<SampledNumber>& numbers) {
  constexpr const char* kParts[] = {".qx", ".qy", ".qz", ".qw"};
  for (std::size_t i = 0; i + 3 < numbers.size(); ++i) {
    if (!numbers[i].label.ends_with(kParts[0])) continue;
    const std::string name = numbers[i].label.substr(0, numbers[i].label.size() - 3);
    bool are_one = true;
    for (std::size_t k = 1; k < 4; ++k) are_one &= numbers[i + k].label == name + kParts[k];
    for (std::size_t k = 0; are_one && k < 4; ++k) numbers[i + k] = {"rotation of " + name, kQuaternion};
  }
}

// And nothing else that tables hold.
static bool are_rates(const std::vector<SampledNumber>& numbers) {
  return std::ranges::all_of(numbers, [](const SampledNumber& one) { return one.label.starts_with("qd") || one.label.starts_with("rate of "); });
}

TrajectoryDifference difference_of(const SampledTrajectory& before, const SampledTrajectory& after, double of_range) {
  TrajectoryDifference difference;
  const Instants instants = shared_instants(before.t, after.t);
  difference.instants = int(instants.size());
  const bool same_freedoms = before.q_numbers.size() == after.q_numbers.size(),
             same_rates = before.qd_numbers.size() == after.qd_numbers.size();
  const auto change_of_names = [](const std::string& what, const auto& old, const auto& now) {
    const auto names = [](const auto& numbers) { return numbers.empty() ? "none" : joined(labels_of(numbers)); };
    return what + " " + change_text(names(old), names(now));
  };
  if (!same_freedoms) {
    difference.others.push_back(change_of_names("freedoms", before.q_numbers, after.q_numbers));
  } else {
    const auto find = [&](const std::vector<SampledNumber>& numbers, const auto& old, const auto& now) {
      return partings({numbers, old}, {numbers, now}, after.t, instants, of_range);
    };
    difference.freedoms = find(after.q_numbers, before.q, after.q);
    if (!same_rates)
      difference.others.push_back(change_of_names(are_rates(before.qd_numbers) && are_rates(after.qd_numbers) ? "rates" : "columns", before.qd_numbers, after.qd_numbers));
    const std::vector<FreedomDifference> rates =
        same_rates ? find(after.qd_numbers, before.qd, after.qd) : std::vector<FreedomDifference>{};
    difference.numbers = difference.freedoms;
    difference.numbers.insert(difference.numbers.end(), rates.begin(), rates.end());
    if (difference.freedoms.empty()) difference.freedoms = rates;
    if (instants.size() < 2 && std::max(before.size(), after.size()) > 1)
      difference.others.push_back("the runs are sampled at other instants and share " +
                                  std::to_string(instants.size()));
  }
  compare_events(before, after, difference.others);
  const auto end = [](const SampledTrajectory& run) { return "t = " + format_shortest(run.end_time) + " s"; };
  if (before.status != after.status)
    difference.others.push_back(
        "the run: " + change_text(before.status + " at " + end(before), after.status + " at " + end(after)));
  else if (!is_same_time(before.end_time, after.end_time))
    difference.others.push_back("the run ends at " + change_text(end(before), end(after)));
  return difference;
}

bool is_rounding(const TrajectoryDifference& difference) {
  return std::all_of(difference.freedoms.begin(), difference.freedoms.end(), [](const FreedomDifference& one) {
    return one.largest <= kSameMotion * (1 + one.range);
  });
}

std::string freedom_words(const TrajectoryDifference& difference) {
  if (difference.freedoms.empty()) return "";
  const FreedomDifference& first = difference.freedoms.front();
  const auto amount = [&](double value) { return amount_text(format_significant(value, 2), first.unit); };
  std::string words = first.label + " differs by " + amount(first.at_first) + " from " +
                      time_text(first.first_time) + " on";
  if (first.largest_time != first.first_time)
    words += " (largest " + amount(first.largest) + " at " + time_text(first.largest_time) + ")";
  const auto farthest = std::max_element(difference.freedoms.begin(), difference.freedoms.end(), [&](const auto& a, const auto& b) {
    return (a.unit == first.unit ? a.largest : 0) < (b.unit == first.unit ? b.largest : 0);
  });
  if (farthest != difference.freedoms.begin())
    words += ", most of all " + farthest->label + ", by " + amount(farthest->largest) + " at " + time_text(farthest->largest_time);
  const std::size_t more = difference.freedoms.size() - (farthest != difference.freedoms.begin() ? 2 : 1);
  if (more > 0) words += more > 1 ? ", as do " + std::to_string(more) + " others" : ", as does 1 other";
  return words;
}

}  // namespace chainreel
