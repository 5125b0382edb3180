#include "sim/choice/error_growth.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace chainreel {
namespace {

std::vector<double> largest_so_far(std::vector<double> errors) {
  for (std::size_t k = 1; k < errors.size(); ++k) errors[k] = std::max(errors[k], errors[k - 1]);
  return errors;
}

}  // namespace

void ErrorGrowth::learn(const std::vector<double>& errors) {
  const std::vector<double> largest = largest_so_far(errors);
  if (largest.empty() || !(largest.back() > 0) || !(largest.back() <= small_)) return;
  if (growth_.empty()) growth_.assign(largest.size(), std::numeric_limits<double>::infinity());
  if (growth_.size() != largest.size()) return;
  for (std::size_t k = 0; k < largest.size(); ++k)
    if (largest[k] > 0) growth_[k] = std::min(growth_[k], largest.back() / largest[k]);
}

double ErrorGrowth::unbounded(const std::vector<double>& errors) const {
  const std::vector<double> largest = largest_so_far(errors);
  if (largest.empty()) return std::numeric_limits<double>::infinity();
  if (growth_.size() != largest.size()) return largest.back();
  // From where its errors were small for the last time.
  const auto first_large = std::upper_bound(largest.begin(), largest.end(), small_);
  if (first_large == largest.begin() || first_large == largest.end()) return largest.back();
  const auto k = std::size_t(first_large - largest.begin()) - 1;
  return std::isfinite(growth_[k]) ? std::max(largest.back(), largest[k] * growth_[k]) : largest.back();
}

}  // namespace chainreel
