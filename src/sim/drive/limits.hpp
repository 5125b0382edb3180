// The limits of the model's joints during a run: what was passed first, where and when.
#pragma once

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "core/names.hpp"
#include "dynamics/workspace.hpp"
#include "model/chain.hpp"

namespace chainreel {

enum class LimitPolicy {
  report,  // say so in the audit
  clamp,   // and cut torques at the joint's effort
  stop,    // and end the run where one is passed
};

std::span<const Name> names_of(LimitPolicy);

// What lies beyond a limit by no more than this of it, or of 1, is rounding: it was touched.
inline constexpr double kTouched = 1e-12;
inline double touched(double limit) { return kTouched * std::max(1.0, std::abs(limit)); }

// The first time that a joint passed one of its limits.
struct LimitEvent {
  std::string joint;
  std::string quantity;  // "position", "velocity" or "effort"
  double t = 0;          // s
  double value = 0;      // rad, m, rad/s, m/s, N m or N
  double limit = 0;
};

// Whether its torque was cut there, as `limit: clamp` asks for, and did not pass it.
inline bool is_cut(const LimitEvent& event, LimitPolicy policy) { return policy == LimitPolicy::clamp && event.quantity == "effort"; }

// "joint 'elbow' passed its position limit 1.5 with 1.52 at t = 0.31 s"
std::string to_string(const LimitEvent& event);

class LimitWatch {
 public:
  explicit LimitWatch(const Chain& chain);

  // Adds what is passed for the first time; allocates only then. True if something was added.
  bool check_state(double t, ConstVec q, ConstVec qd);
  bool check_effort(double t, Vec tau, bool clamp);  // cuts tau where `clamp`
  void cut(Vec tau) const;                           // and says nothing of it

  // How far within each limit a state is, at most `measures()` of them: position above and below, rate and effort of each joint; infinite where there is no
  // such limit, or it was passed. `tau`: uncut; empty: efforts are not looked at.
  std::size_t measures() const { return 4 * watched_.size(); }
  double distance(std::size_t measure, ConstVec q, ConstVec qd, ConstVec tau) const;

  bool are_none() const { return watched_.empty(); }
  bool have_effort() const;
  const std::vector<LimitEvent>& events() const { return events_; }

 private:
  struct Watched {
    const Joint* joint = nullptr;
    bool has_torque = true;  // of its own: not a mimic joint, which shares that of the joint it follows
    bool position_passed = false, velocity_passed = false, effort_passed = false;
  };
  static double* excessive(const Watched& one, Vec tau);  // its torque; null: within its effort, or none
  bool add(const Joint& joint, const char* quantity, double t, double value, double limit);

  std::vector<Watched> watched_;  // joints that have a limit
  std::vector<LimitEvent> events_;
};

}  // namespace chainreel
