#include "draw/layers/torque_run.hpp"

#include <algorithm>
#include <cmath>
#include <functional>

#include "draw/layers/devices.hpp"
#include "draw/layers/peaks.hpp"
#include "draw/layers/vectors.hpp"
#include "sim/torques_along.hpp"

namespace chainreel {
namespace {

constexpr int kMostTorqueLabels = 6;
constexpr double kKeepsName = 0.3;      // s of the film: for so long it may be small and keep its name

}  // namespace

TorqueRun::TorqueRun(const Stage& stage, const StagedRun& motion)
    : nv_(std::size_t(motion.chain().nv)),
      tau_(torques_along(*motion.simulation(), motion.trajectory())),
      shown_(nv_),
      rings_(nv_),
      extremes_(nv_),
      named_(nv_) {
  const std::vector<double>& t = motion.trajectory().t;
  for (std::size_t at = 0; at < tau_.size(); ++at)
    if (std::isfinite(tau_[at]) && tau_[at] != 0) shown_[at % nv_] = true;
  for (const Device& device : devices_of(stage, motion))
    if (device.is_all_of_it()) shown_[std::size_t(device.drive.freedom)] = false;
  // Pictures to be laid over others have no words but those that were asked for.
  labelled_ = !is_transparent(stage.page) && std::count(shown_.begin(), shown_.end(), true) <= kMostTorqueLabels;
  if (!shows_any()) {
    tau_ = {};  // long films of motions without torques need no room for them
    return;
  }
  std::vector<Magnitude> magnitudes;
  magnitudes.reserve(tau_.size());
  for (std::size_t at = 0; at < tau_.size(); ++at) magnitudes.push_back({std::abs(tau_[at]), lasts(t, at / nv_)});
  const double full = full_magnitude(std::move(magnitudes));
  const std::vector<double> curve = torques_along(*motion.simulation(), motion.curve_run());
  const int keeps_name = int(std::lround(kKeepsName * stage.page.video.fps.value()));
  for (std::size_t i = 0; i < nv_; ++i) {
    if (!shown_[i]) continue;
    std::vector<bool> rests(t.size());
    for (std::size_t k = 0; k < t.size(); ++k) rests[k] = !(std::abs(tau_[k * nv_ + i]) >= kRestBelow * full);
    rings_[i] = rings_along(t, rests);
    extremes_[i] = extremes_near(of_freedom(tau_, i), t, of_freedom(curve, i), motion.curve_run().t);
    find_names(i, full * kLeastNamed * kWidestTurn / kTurnOfFull, keeps_name);
  }
}

bool TorqueRun::shows_any() const {
  return std::ranges::any_of(shown_, std::identity());
}

// Between two samples at which it is large enough for a name, no farther apart than `keeps`, it keeps that.
void TorqueRun::find_names(std::size_t i, double least, int keeps) {
  const int samples = int(tau_.size() / nv_);
  named_[i].resize(std::size_t(samples));
  for (int k = 0, named = -1; k < samples; ++k) {
    if (!(std::abs(tau_[std::size_t(k) * nv_ + i]) > least)) continue;
    for (int between = named + 1; named >= 0 && k - named <= keeps && between < k; ++between) named_[i][std::size_t(between)] = true;
    named = k;
  }
}

std::vector<double> TorqueRun::of_freedom(const std::vector<double>& tau, std::size_t i) const {
  std::vector<double> own;
  own.reserve(tau.size() / nv_);
  for (std::size_t at = i; at < tau.size(); at += nv_) own.push_back(tau[at]);
  return own;
}

}  // namespace chainreel
