#include "scene/run/grid.hpp"

#include <set>

#include "core/error.hpp"

namespace chainreel {
namespace {

constexpr std::size_t kMostCombinations = 100'000'000;

}  // namespace

Grid::Grid(const std::vector<std::string>& texts, const std::string& option) {
  std::set<std::string> keys;
  for (const std::string& text : texts) {
    axes_.push_back(parse_sweep(text, option));
    if (!keys.insert(axes_.back().key).second)
      throw Error(ExitCode::usage, option + " " + text + ": " + axes_.back().key + " varies already");
    size_ *= axes_.back().values.size();  // each below a million: no overflow before it is looked at
    if (size_ > kMostCombinations)
      throw Error(ExitCode::limit, option + " makes more than a hundred million combinations: give fewer values");
  }
}

std::vector<std::size_t> Grid::places(std::size_t k) const {
  std::vector<std::size_t> places(axes_.size());
  for (std::size_t i = axes_.size(); i-- > 0;) {
    places[i] = k % axes_[i].values.size();
    k /= axes_[i].values.size();
  }
  return places;
}

std::vector<std::string> Grid::settings(std::size_t k) const {
  std::vector<std::string> settings;
  const std::vector<std::size_t> at = places(k);
  for (std::size_t i = 0; i < axes_.size(); ++i) settings.push_back(axes_[i].setting(at[i]));
  return settings;
}

}  // namespace chainreel
