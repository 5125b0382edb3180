#include "sim/chain_series.hpp"

#include <cmath>

#include "core/error.hpp"

namespace chainreel {
namespace {

bool has_effort_limit(const Chain& chain) {
  for (std::size_t i = 1; i < chain.bodies.size(); ++i)
    if (std::isfinite(chain.bodies[i].joint.limit.effort)) return true;
  return false;
}

class ChainSeries final : public Series {
 public:
  ChainSeries(ChainSystem& system, const AffineTorque& torque, int highest_order)
      : system_(system),
        series_(system.chain(), torque, highest_order),
        watches_effort_(has_effort_limit(system.chain())) {}

  int n() const override { return system_.nv(); }

  void expand(double t, std::span<const double> q, std::span<const double> v, int order,
              std::span<double> c) override {
    system_.count_evaluation();
    if (watches_effort_) system_.torque(t, q, v);  // which reports what passes a limit
    series_.expand(t, q, v, order, c);
  }

 private:
  ChainSystem& system_;
  PlanarSeries<double> series_;
  bool watches_effort_;
};

}  // namespace

bool cuts_torques(const Chain& chain, LimitPolicy limit) {
  return limit == LimitPolicy::clamp && has_effort_limit(chain);
}

std::optional<std::string> why_no_series(const Chain& chain, const TorqueLaw& law, LimitPolicy limit) {
  if (auto why = why_no_planar_series(chain)) return why;
  if (cuts_torques(chain, limit)) return "torques are cut at the joints' effort";
  if (!law.affine()) return "a torque is neither a polynomial in t nor affine in the state";
  return {};
}

std::unique_ptr<Series> make_chain_series(ChainSystem& system, int highest_order) {
  if (const auto why = why_no_series(system.chain(), system.law(), system.limit_policy()))
    throw Error(ExitCode::bad_input,
                "method taylor does not take this scene, because " + *why + ": take dop853 instead");
  return std::make_unique<ChainSeries>(system, *system.law().affine(), highest_order);
}

}  // namespace chainreel
