#include "sim/drive/linear_drive.hpp"

#include <algorithm>
#include <cmath>

#include "dynamics/kinematics.hpp"

namespace chainreel {
namespace {

constexpr double kRoundOff = 1e-12;  // of the largest factor: what rotations by rpy leave of a zero

// Component `axis` of a frame's place as a sum over coordinates, which holds at every pose; nothing where it is none.
struct PlaceForm {
  double at_zero = 0;           // m, where all coordinates are zero
  std::vector<double> factors;  // one a freedom
};
std::optional<PlaceForm> place_form_of(const Chain& chain, int frame, int axis) {
  if (frame < 0) return {};
  Workspace ws(chain);
  const std::vector<double> zero(std::size_t(chain.nv));
  compute_kinematics(chain, ws, zero, zero);
  PlaceForm form{frame_position(chain, ws, frame)[axis], std::vector<double>(std::size_t(chain.nv))};
  for (int b = chain.frames[std::size_t(frame)].body; b > 0; b = chain.bodies[std::size_t(b)].parent) {
    const Joint& joint = chain.bodies[std::size_t(b)].joint;
    if (joint.kind != JointKind::prismatic) return {};
    form.factors[std::size_t(joint.v_index)] +=
        joint.ratio * (ws.X_WB[std::size_t(b)].linear() * joint.axis)[axis];
  }
  return form;
}

// One freedom's torque with everything in coordinates: sum K q + sum D qd + constant.
struct InCoordinates {
  std::vector<double> K, D;
  double constant = 0;
};

std::optional<InCoordinates> in_coordinates(const Chain& chain, const Probe& probe, const AffineForm<double>& form) {
  const auto n = std::size_t(chain.nv);
  if (std::any_of(form.powers.begin() + 1, form.powers.end(), [](double one) { return one != 0; })) return {};
  InCoordinates sum{{form.weights.begin() + 1, form.weights.begin() + 1 + std::ptrdiff_t(n)},
                    {form.weights.begin() + 1 + std::ptrdiff_t(n), form.weights.begin() + 1 + std::ptrdiff_t(2 * n)},
                    form.powers[0]};
  for (std::size_t slot = 1 + 2 * n; slot < form.weights.size(); ++slot) {
    const double weight = form.weights[slot];
    if (weight == 0) continue;
    const auto place = place_form_of(chain, probe.frame_of(chain, int(slot)), probe.axis_of(int(slot)));
    if (!place) return {};
    const bool is_rate = probe.is_velocity(int(slot));
    std::vector<double>& factors = is_rate ? sum.D : sum.K;
    for (std::size_t j = 0; j < n; ++j) factors[j] += weight * place->factors[j];
    if (!is_rate) sum.constant += weight * place->at_zero;
  }
  return sum;
}

// The factor at place i where all others are zero; nothing where they are not.
std::optional<double> only_factor(const std::vector<double>& factors, std::size_t i) {
  double largest = 0;
  for (const double one : factors) largest = std::max(largest, std::abs(one));
  for (std::size_t j = 0; j < factors.size(); ++j)
    if (j != i && std::abs(factors[j]) > kRoundOff * largest) return {};
  return std::abs(factors[i]) > kRoundOff * largest ? factors[i] : 0;
}

}  // namespace

int body_of_freedom(const Chain& chain, int freedom) {
  for (int b = 1; b < int(chain.bodies.size()); ++b) {
    const Joint& joint = chain.bodies[std::size_t(b)].joint;
    if (joint.kind != JointKind::floating && joint.v_index == freedom && joint.ratio == 1 && joint.offset == 0) return b;
  }
  return -1;
}

std::vector<LinearDrive> linear_drives_of(const Chain& chain, const Probe& probe,
                                          std::span<const std::optional<AffineForm<double>>> forms) {
  std::vector<LinearDrive> drives;
  if (chain.has_floating) return drives;
  for (std::size_t i = 0; i < forms.size(); ++i) {
    if (!forms[i]) continue;
    const auto sum = in_coordinates(chain, probe, *forms[i]);
    if (!sum) continue;
    const std::optional<double> k = only_factor(sum->K, i), d = only_factor(sum->D, i);
    // What pushes away is no spring, and what speeds up no damper.
    if (!k || !d || *k > 0 || *d > 0 || (*k == 0 && *d == 0)) continue;
    LinearDrive drive{int(i), -*k, -*d};
    if (drive.is_spring())
      drive.rest = sum->constant / drive.stiffness;
    else
      drive.bias = sum->constant;
    drives.push_back(drive);
  }
  return drives;
}

}  // namespace chainreel
