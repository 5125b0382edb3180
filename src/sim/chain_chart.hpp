// A chain with floating joints in local coordinates, where it is a system with q' = v.
#pragma once

#include "dynamics/local_coordinates.hpp"
#include "integrate/system.hpp"
#include "sim/chain_system.hpp"

namespace chainreel {

class ChainChart final : public SecondOrder, public Chart {
 public:
  // `system` must outlive it.
  explicit ChainChart(ChainSystem& system);

  // As a system: q, v of SecondOrder are x, x'.
  int nq() const override { return system_.nv(); }
  int nv() const override { return system_.nv(); }
  void acceleration(double t, std::span<const double> x, std::span<const double> x_dot,
                    std::span<double> x_ddot) override;

  int own_coordinates() const override { return system_.nq(); }
  void move_to(std::span<const double> q, std::span<const double> v, std::span<double> x,
               std::span<double> x_dot) override;
  void leave(std::span<const double> x, std::span<const double> x_dot, std::span<double> q,
             std::span<double> v) const override;

  const LocalCoordinates& local() const { return local_; }

 private:
  ChainSystem& system_;
  LocalCoordinates local_;
  std::vector<double> q_, v_, v_dot_;
};

}  // namespace chainreel
