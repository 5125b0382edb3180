#include "sim/chain_chart.hpp"

namespace chainreel {

ChainChart::ChainChart(ChainSystem& system)
    : system_(system),
      local_(system.chain()),
      q_(std::size_t(system.nq())),
      v_(std::size_t(system.nv())),
      v_dot_(v_.size()) {}

void ChainChart::acceleration(double t, std::span<const double> x, std::span<const double> x_dot,
                              std::span<double> x_ddot) {
  local_.place(x, q_);
  local_.to_velocity(x, x_dot, v_);
  system_.acceleration(t, q_, v_, v_dot_);
  local_.to_second_rate(x, x_dot, v_dot_, x_ddot);
}

void ChainChart::move_to(std::span<const double> q, std::span<const double> v, std::span<double> x,
                         std::span<double> x_dot) {
  local_.move_to(q, x);
  local_.to_rate(x, v, x_dot);
}

void ChainChart::leave(std::span<const double> x, std::span<const double> x_dot, std::span<double> q,
                       std::span<double> v) const {
  local_.place(x, q);
  local_.to_velocity(x, x_dot, v);
}

}  // namespace chainreel
