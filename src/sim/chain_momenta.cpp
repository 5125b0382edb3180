#include "sim/chain_momenta.hpp"

#include <algorithm>

#include "core/error.hpp"

namespace chainreel {
namespace {

// Of a chain all of whose joints slide: what slides turns nothing.
bool has_constant_mass_matrix(const Chain& chain) {
  return std::all_of(chain.bodies.begin() + 1, chain.bodies.end(),
                     [](const Body& body) { return body.joint.kind == JointKind::prismatic; });
}

const Chain& checked(const Chain& chain, const std::string& method) {
  if (!chain.has_floating) return chain;
  throw Error(ExitCode::bad_input,
              "the method " + method +
                  " takes one momentum for each coordinate, and the orientation of a floating joint has " +
                  "four numbers for three: take dop853");
}

}  // namespace

ChainMomenta::ChainMomenta(ChainSystem& system, const std::string& method)
    : system_(system),
      form_(checked(system.chain(), method)),
      separable_(has_constant_mass_matrix(system.chain()) && !system.chain().has_dissipation &&
                 !system.law().depends_on_velocity()) {}

void ChainMomenta::momentum(std::span<const double> q, std::span<const double> v, std::span<double> p) {
  form_.momentum(q, v, p);
}

void ChainMomenta::velocity(std::span<const double> q, std::span<const double> p, std::span<double> v) {
  form_.velocity(q, p, v);
}

void ChainMomenta::force(double t, std::span<const double> q, std::span<const double> v,
                         std::span<double> p_dot) {
  system_.count_evaluation();
  form_.force(q, v, p_dot);
  const ConstVec tau = system_.net_torque(t, q, v);
  for (std::size_t i = 0; i < p_dot.size(); ++i) p_dot[i] += tau[i];
}

}  // namespace chainreel
