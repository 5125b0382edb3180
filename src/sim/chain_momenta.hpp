// A chain under a torque law in coordinates and momenta; with floating joints, in local coordinates x and the
// momenta that belong to them.
#pragma once

#include "dynamics/local_coordinates.hpp"
#include "dynamics/momentum_form.hpp"
#include "integrate/system.hpp"
#include "sim/chain_system.hpp"

namespace chainreel {

class ChainMomenta final : public Momenta {
 public:
  // `local`: of a chain with floating joints, else null. Both must outlive it.
  ChainMomenta(ChainSystem& system, const LocalCoordinates* local);

  int n() const override { return system_.nv(); }
  bool is_separable() const override { return separable_; }
  void momentum(std::span<const double> q, std::span<const double> v, std::span<double> p) override;
  void velocity(std::span<const double> q, std::span<const double> p, std::span<double> v) override;
  void force(double t, std::span<const double> q, std::span<const double> v,
             std::span<double> p_dot) override;

 private:
  void own_force(double t, std::span<const double> q, std::span<const double> v, std::span<double> p_dot);

  ChainSystem& system_;
  MomentumForm form_;
  bool separable_;
  const LocalCoordinates* local_;
  std::vector<double> own_q_, own_v_, own_p_, own_p_dot_;  // of a chain with floating joints
};

}  // namespace chainreel
