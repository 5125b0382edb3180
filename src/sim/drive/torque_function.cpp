#include "sim/drive/torque_function.hpp"

#include <algorithm>
#include <limits>

#include "sim/drive/prices.hpp"
#include "sim/drive/torque.hpp"

namespace chainreel {
namespace {

class FunctionTorque final : public TorqueLaw {
 public:
  explicit FunctionTorque(OwnTorque torque) : torque_(std::move(torque)) {}

  void evaluate(const Chain&, Workspace&, double t, ConstVec q, ConstVec qd, Vec tau) override {
    std::fill(tau.begin(), tau.end(), std::numeric_limits<double>::quiet_NaN());
    if (*torque_.failure) return;
    try {
      torque_.function(t, q, qd, tau);
    } catch (...) {
      *torque_.failure = std::current_exception();
    }
  }
  double price(const Chain&) const override { return kPriceOfFunction; }

 private:
  OwnTorque torque_;
};

}  // namespace

std::unique_ptr<TorqueLaw> make_function_torque(OwnTorque torque) {
  return std::make_unique<FunctionTorque>(std::move(torque));
}

}  // namespace chainreel
