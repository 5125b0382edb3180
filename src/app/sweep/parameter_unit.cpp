#include "app/sweep/parameter_unit.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <cstdlib>
#include <optional>
#include <vector>

#include "core/error.hpp"
#include "expr/expression.hpp"
#include "model/model_description.hpp"
#include "sim/drive/probe.hpp"

namespace chainreel {
namespace {

// Powers of kg, m, s and rad.
struct UnitPowers {
  const char* name;
  std::array<int, 4> of;
};

constexpr UnitPowers kNewton{"N", {1, 1, -2, 0}}, kNewtonMetre{"N m", {1, 2, -2, 0}};
constexpr UnitPowers kUnitsOfParameters[] = {
    kNewton, kNewtonMetre, {"N/m", {1, 0, -2, 0}}, {"N s/m", {1, 0, -1, 0}}, {"N m/rad", {1, 2, -2, -1}}, {"N m s/rad", {1, 2, -1, -1}},
    {"kg", {1, 0, 0, 0}}, {"m", {0, 1, 0, 0}}, {"s", {0, 0, 1, 0}}, {"rad", {0, 0, 0, 1}}, {"1/s", {0, 0, -1, 0}}, {"rad/s", {0, 0, -1, 1}},
    {"m/s", {0, 1, -1, 0}}, {"m/s\u00B2", {0, 1, -2, 0}}, {"", {0, 0, 0, 0}}};

// How many of other units one is. With a radian of its own sin(q1) has no meaning, but a stiffness is none of a moment.
using Sizes = std::array<double, 4>;
constexpr Sizes kOther{1.37, 0.83, 1.19, 1.51}, kOtherButAngles{1.37, 0.83, 1.19, 1};

double factor_of(const UnitPowers& unit, const Sizes& sizes) {
  double factor = 1;
  for (std::size_t i = 0; i < sizes.size(); ++i) factor *= std::pow(sizes[i], unit.of[i]);
  return factor;
}

// 100 * y_G hides N/m, 2 * k nothing.
bool hides_units(const std::string& text) {
  for (std::size_t i = 0; i < text.size();) {
    const bool in_name = i > 0 && (std::isalnum(static_cast<unsigned char>(text[i - 1])) || text[i - 1] == '_');
    if (in_name || !(std::isdigit(static_cast<unsigned char>(text[i])) || text[i] == '.')) {
      ++i;
      continue;
    }
    char* end = nullptr;
    const double value = std::strtod(text.c_str() + i, &end);
    if (value != 0 && value != 0.5 && value != 1 && value != 2) return true;
    i = std::max(std::size_t(end - text.c_str()), i + 1);
  }
  return false;
}

// Of what a probe reads; nothing of other parameters than the one.
std::optional<UnitPowers> unit_of_slot(const Probe& probe, const std::vector<DescribedCoordinate>& coordinates, int slot, int parameter, const UnitPowers& unit) {
  if (slot == parameter) return unit;
  if (slot == 0) return UnitPowers{"s", {0, 0, 1, 0}};
  const int rate = probe.is_velocity(slot) ? -1 : 0;
  if (probe.is_kinematic(slot)) return UnitPowers{"", {0, 1, rate, 0}};
  const std::size_t joint = std::size_t(slot - 1) % coordinates.size();
  if (std::size_t(slot) > 2 * coordinates.size()) return {};
  const bool is_angle = coordinates[joint].unit == "rad";
  return UnitPowers{"", {0, is_angle ? 0 : 1, rate, is_angle ? 1 : 0}};
}

// Whether it is a torque in other units, too, where the parameter has this one.
bool keeps_meaning(const Expression& torque, const Probe& probe, const std::vector<DescribedCoordinate>& coordinates, int parameter, const UnitPowers& unit,
                   const UnitPowers& of_torque, const Sizes& sizes) {
  constexpr int kSamples = 12;
  constexpr double kRoundOff = 1e-10;
  bool is_seen = false;
  for (int sample = 0; sample < kSamples; ++sample) {
    std::vector<double> values(probe.names().size()), others(values.size());
    for (const int slot : torque.used_variables()) {
      const auto powers = unit_of_slot(probe, coordinates, slot, parameter, unit);
      if (!powers) return false;
      values[std::size_t(slot)] = 0.2 + 1.3 * std::abs(std::sin(1.7 * slot + 2.3 * sample + 0.4));
      others[std::size_t(slot)] = values[std::size_t(slot)] * factor_of(*powers, sizes);
    }
    const double value = torque.evaluate<double>(values) * factor_of(of_torque, sizes), other = torque.evaluate<double>(others);
    if (!std::isfinite(value) || !std::isfinite(other)) continue;
    if (std::abs(value - other) > kRoundOff * std::max(std::abs(value), std::abs(other))) return false;
    is_seen = is_seen || value != 0;
  }
  return is_seen;
}

}  // namespace

std::string unit_of_parameter(const Chain& chain, const Scene& scene, const std::string& name) {
  const std::vector<DescribedCoordinate> coordinates = coordinates_of(chain);
  if (scene.torque.size() != coordinates.size() || chain.nq != chain.nv) return "";
  const Probe probe(chain, scene.parameters);
  const auto slot = std::ranges::find(probe.names(), name);
  const int parameter = int(slot - probe.names().begin());
  std::vector<const UnitPowers*> left;
  for (const UnitPowers& unit : kUnitsOfParameters) left.push_back(&unit);
  bool is_read = false;
  for (std::size_t i = 0; i < scene.torque.size(); ++i) {
    if (scene.torque[i].control) continue;
    std::optional<Expression> torque;
    try {
      torque = Expression::parse(scene.torque[i].text, probe.names(), scene.torque[i].place);
    } catch (const Error&) {
      return "";  // it reads frames of its own
    }
    if (!std::ranges::count(torque->used_variables(), parameter)) continue;
    if (hides_units(torque->text())) return "";
    is_read = true;
    const UnitPowers& of_torque = coordinates[i].unit == "rad" ? kNewtonMetre : kNewton;
    const auto without = [&](const Sizes& sizes) {
      std::vector<const UnitPowers*> kept;
      for (const UnitPowers* const unit : left)
        if (keeps_meaning(*torque, probe, coordinates, parameter, *unit, of_torque, sizes)) kept.push_back(unit);
      return kept;
    };
    std::vector<const UnitPowers*> kept = without(kOther);
    if (kept.empty()) {
      kept = without(kOtherButAngles);
      std::erase_if(kept, [](const UnitPowers* unit) { return unit->of[3] != 0; });
    }
    left = std::move(kept);
  }
  return is_read && left.size() == 1 ? left.front()->name : "";
}

}  // namespace chainreel
