#include "draw/layers/peaks.hpp"

#include <algorithm>
#include <cmath>

#include "core/format.hpp"
#include "draw/page/word_plan.hpp"

namespace chainreel {
namespace {

constexpr double kPeakStays = 0.2;    // s after what is cut, in which the number goes
constexpr double kSamePassage = 0.6;  // s between two that are told as one

// Frames [begin, end) at which a number stands.
struct NumberedPassage {
  int begin, end;
  double value;
};

bool in_one_sense(double a, double b) {
  return std::signbit(a) == std::signbit(b);
}

// Those that are cut, of one sense each.
std::vector<NumberedPassage> cut_passages(const std::vector<double>& values, double cut, int apart) {
  std::vector<NumberedPassage> passages;
  for (int k = 0; k < int(values.size()); ++k) {
    const double value = values[std::size_t(k)];
    if (!(std::abs(value) > cut)) continue;
    if (passages.empty() || k - passages.back().end > apart || !in_one_sense(value, passages.back().value)) {
      passages.push_back({k, k + 1, value});
      continue;
    }
    passages.back().end = k + 1;
    if (std::abs(value) > std::abs(passages.back().value)) passages.back().value = value;
  }
  return passages;
}

bool is_said_alike(const NumberedPassage& passage, const std::vector<double>& values) {
  const std::string said = format_significant(passage.value, 2);
  return std::all_of(values.begin() + passage.begin, values.begin() + passage.end, [&](double value) { return format_significant(value, 2) == said; });
}

}  // namespace

std::vector<std::optional<Peak>> peaks_along(const std::vector<double>& values, double cut, double fps) {
  const int count = int(values.size());
  const int shortest = std::min(count, int(std::lround(kShortestStay * fps)));
  std::vector<std::optional<Peak>> peaks(values.size());
  std::vector<NumberedPassage> passages = cut_passages(values, cut, int(std::lround(kSamePassage * fps)));
  for (std::size_t i = 0; i < passages.size(); ++i) {
    NumberedPassage& passage = passages[i];
    // Beside an arrow that is whole a number would be read as its: it stays behind for a blink, or as long as it takes to be read, and never stands before.
    const int last = i + 1 < passages.size() ? passages[i + 1].begin : count, stays = int(std::lround(kPeakStays * fps));
    for (int k = 0; k < stays && passage.end < last && in_one_sense(values[std::size_t(passage.end)], passage.value); ++k) ++passage.end;
    passage.end = std::max(passage.end, std::min(last, passage.begin + shortest));
    if (passage.end - passage.begin < shortest && passage.end < count) continue;  // the film's last picture stays
    const Peak peak{passage.value, is_said_alike(passage, values)};
    std::fill(peaks.begin() + passage.begin, peaks.begin() + passage.end, peak);
  }
  return peaks;
}

std::vector<double> extremes_near(std::span<const double> values, std::span<const double> t, std::span<const double> curve, std::span<const double> curve_t) {
  std::vector<double> extremes(values.begin(), values.end());
  for (std::size_t k = 0; k < extremes.size(); ++k) {
    const double from = t[k > 0 ? k - 1 : 0], to = t[std::min(k + 1, t.size() - 1)];
    for (auto at = std::ranges::lower_bound(curve_t, from); at != curve_t.end() && *at <= to; ++at) {
      const double one = curve[std::size_t(at - curve_t.begin())];
      if (in_one_sense(one, values[k]) && std::abs(one) > std::abs(extremes[k])) extremes[k] = one;
    }
  }
  return extremes;
}

}  // namespace chainreel
