// Chains built in code, so that tests of the dynamics need no file and reach what no file in models/ has.
#pragma once

#include <cstdint>
#include <random>
#include <vector>

#include "model/chain.hpp"

namespace chainreel::test {

// The same numbers on every machine; std::uniform_real_distribution promises none.
class Random {
 public:
  explicit Random(std::uint64_t seed) : engine_(seed) {}
  double between(double low, double high) { return low + (high - low) * double(engine_() >> 11) * 0x1p-53; }
  int below(int n) { return int(engine_() % std::uint64_t(n)); }
  Eigen::Vector3d vector(double size) {
    return {between(-size, size), between(-size, size), between(-size, size)};
  }
  Eigen::Vector3d unit_vector();
  Eigen::Matrix3d rotation();
  Eigen::Isometry3d pose(double size);

 private:
  std::mt19937_64 engine_;
};

// Two point masses at the ends of two links, axes z, gravity along -y: Modern Robotics, eq. 8.9.
struct RR {
  double L1 = 1, L2 = 1, m1 = 1, m2 = 1, g = 9.81;
};
Chain rr_chain(const RR& rr = {});
Chain rrr_chain();  // three uniform rods of 1 m and 1 kg
Chain pp_chain();   // x carries y, 1 kg each, gravity along -y

// n links that turn about z: rods with point loads, lengths about 1/n m. For speed and for long chains.
Chain planar_serial_chain(int n);
// Seven revolute joints with the twists of +-90 degrees of a common arm, random inertias.
Chain arm_chain(std::uint64_t seed);

struct TreeOptions {
  int bodies = 10;
  bool serial = false;
  bool floating_base = false;
  double floating = 0;  // share of joints
  double prismatic = 0.3;
  double mimic = 0;
  double massless = 0;  // share of bodies without inertia that carry others
};
Chain random_tree(std::uint64_t seed, const TreeOptions& options);
// All motion in one plane, itself turned at random in space (in xy if not `turned`).
Chain random_planar_tree(std::uint64_t seed, const TreeOptions& options, bool turned = true);

// Numbers coordinates in body order, makes a frame a body (and one off each body), sets the flags and the
// planar form.
void finish(Chain& chain);
// The same mechanism, through the spatial algebra.
Chain without_planar_form(Chain chain);

struct State {
  std::vector<double> q, qd, qdd, tau;
};
State random_state(const Chain& chain, Random& random, double speed = 2);
std::vector<double> random_vector(std::size_t n, Random& random, double size);

}  // namespace chainreel::test
