// A chain under a torque law in coordinates and momenta.
#pragma once

#include "dynamics/momentum_form.hpp"
#include "integrate/system.hpp"
#include "sim/chain_system.hpp"

namespace chainreel {

class ChainMomenta final : public Momenta {
 public:
  // Throws Error (bad input) where the chain has a floating joint. `system` must outlive it.
  ChainMomenta(ChainSystem& system, const std::string& method);

  int n() const override { return system_.nv(); }
  bool is_separable() const override { return separable_; }
  void momentum(std::span<const double> q, std::span<const double> v, std::span<double> p) override;
  void velocity(std::span<const double> q, std::span<const double> p, std::span<double> v) override;
  void force(double t, std::span<const double> q, std::span<const double> v,
             std::span<double> p_dot) override;

 private:
  ChainSystem& system_;
  MomentumForm form_;
  bool separable_;
};

}  // namespace chainreel
