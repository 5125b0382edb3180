#include "model/followers.hpp"

#include <cmath>

#include "core/format.hpp"

namespace chainreel {

FollowerNumbers numbers_of_followers(const Chain& chain, std::span<const double> values, bool are_rates) {
  constexpr double kSame = 1e-6;  // rad or m, and of the number: lists are written with that many digits
  if (values.size() + 1 != chain.bodies.size() || chain.has_floating) return {};
  std::vector<std::size_t> followers;
  std::vector<double> leading(std::size_t(chain.nq));
  const auto follows = [&](const Joint& joint) { return chain.coordinate_names[std::size_t(joint.v_index)] != joint.name; };
  for (std::size_t b = 1; b < chain.bodies.size(); ++b) {
    const Joint& joint = chain.bodies[b].joint;
    if (follows(joint))
      followers.push_back(b - 1);
    else
      leading[std::size_t(joint.q_index)] = values[b - 1];
  }
  for (const std::size_t k : followers) {
    const Joint& joint = chain.bodies[k + 1].joint;
    const double value = joint.ratio * leading[std::size_t(joint.q_index)] + (are_rates ? 0 : joint.offset);
    if (!(std::abs(values[k] - value) <= kSame * (1 + std::abs(value))))
      return {{}, joint.name + " follows " + chain.coordinate_names[std::size_t(joint.v_index)] + ", which makes it " +
                      format_significant(value, 6) + ", not " + format_significant(values[k], 6)};
  }
  return {followers, ""};
}

std::string followers_of(const Chain& chain) {
  std::string words;
  for (std::size_t i = 1; i < chain.bodies.size(); ++i) {
    const Joint& joint = chain.bodies[i].joint;
    if (joint.kind == JointKind::floating) continue;
    const std::string& leader = chain.coordinate_names[std::size_t(joint.v_index)];
    if (leader == joint.name) continue;
    words += (words.empty() ? "" : ", ") + joint.name + " follows " + leader + " and has no number of its own";
  }
  return words;
}

}  // namespace chainreel
