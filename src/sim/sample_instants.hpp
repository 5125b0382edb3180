// At which instants a run is looked at: those of its samples, and where curves of it are to be seen more of them between.
#pragma once

#include <algorithm>
#include <cmath>
#include <deque>
#include <limits>
#include <optional>
#include <span>

namespace chainreel {

// Of samples from one to the next, on average.
inline double distance_of(std::span<const double> times) {
  return times.size() > 1 ? (times.back() - times.front()) / double(times.size() - 1) : std::numeric_limits<double>::infinity();
}

class SampleInstants {
 public:
  // `times` rising. `apart`: s, of those between; 0: there are none. `beside`: s, how near to a corner it is looked at.
  SampleInstants(std::span<const double> times, double apart, double beside)
      : times_(times), apart_(apart), beside_(beside), corners_left_(apart > 0 && !times.empty() ? times.back() / apart : 0) {}

  struct Instant {
    double t;
    bool is_sample;
  };

  // The next that is no later than `end`.
  std::optional<Instant> next(double end) {
    while (!around_.empty() && around_.front() <= last_) around_.pop_front();
    const double sample = has_samples() ? times_[next_] : kNever;
    const double between = part_ < parts_ ? times_[next_ - 1] + (sample - times_[next_ - 1]) * part_ / parts_ : kNever;
    const double corner = has_samples() && !around_.empty() ? around_.front() : kNever;
    const double t = std::min({sample, between, corner});
    if (!(t <= end)) return {};
    last_ = t;
    if (t == sample) {
      ++next_;
      part_ = 1;
      parts_ = apart_ > 0 && has_samples() ? std::max(1L, std::lround((times_[next_] - t) / apart_)) : 1;
      return Instant{t, true};
    }
    if (t == between) ++part_;
    return Instant{t, false};
  }

  // What is seen may jump at t: it is looked at just before and just after.
  void corner_at(double t) {
    if (corners_left_ < 1) return;
    --corners_left_;
    around_.push_back(t - beside_);
    around_.push_back(t + beside_);
  }

  // It is looked at at t, later than all that is known of.
  void look_at(double t) { around_.push_back(t); }

  bool has_samples() const { return next_ < times_.size(); }

 private:
  static constexpr double kNever = std::numeric_limits<double>::infinity();

  std::span<const double> times_;
  double apart_, beside_, corners_left_;
  std::size_t next_ = 0;
  long part_ = 1, parts_ = 1;  // of what lies between the last sample and the next
  std::deque<double> around_;
  double last_ = -kNever;
};

}  // namespace chainreel
