#include "draw/layers/cut_numbers.hpp"

#include <algorithm>
#include <cmath>

#include "core/format.hpp"

namespace chainreel {
namespace {

constexpr double kQuick = 1.3;         // times: more than that within kGlance, the third digit is not all that runs
constexpr double kGlance = 0.25;       // s: as long as an eye takes for a number
constexpr double kLeastReading = 0.5;  // s: words that stand shorter are not read before they change
constexpr double kComing = 0.15;       // s: to come, and to go

// Frames [begin, end) of which the same kind of words is said.
struct Passage {
  std::size_t begin, end;
  bool is_bound;
};

// Of the frames [begin, end), all of them cut, those whose number runs: within no glance that they are part of it can be read.
std::vector<bool> quick_frames(const std::vector<CutLength>& lengths, std::size_t begin, std::size_t end, double fps) {
  const auto glance = std::size_t(std::ceil(kGlance * fps)) + 1;
  std::vector<bool> quick(end - begin, true);
  for (std::size_t k = begin; k + glance <= end; ++k) {
    const auto first = lengths.begin() + std::ptrdiff_t(k), last = first + std::ptrdiff_t(glance);
    const auto [least, most] = std::minmax_element(first, last);
    if (**most <= kQuick * **least) std::fill_n(quick.begin() + std::ptrdiff_t(k - begin), glance, false);
  }
  return quick;
}

// Numbers stand for as long as it takes to read them, bounds between them.
std::vector<Passage> passages_of(const std::vector<CutLength>& lengths, std::size_t begin, std::size_t end, double fps) {
  const double least = kLeastReading * fps;
  const std::vector<bool> bound = quick_frames(lengths, begin, end, fps);
  std::vector<Passage> passages;
  for (std::size_t k = 0, next = 0; k < bound.size(); k = next) {
    while (next < bound.size() && bound[next] == bound[k]) ++next;
    const bool is_bound = bound[k] || double(next - k) < least;
    if (!passages.empty() && passages.back().is_bound && is_bound)
      passages.back().end = begin + next;
    else
      passages.push_back({begin + k, begin + next, is_bound});
  }
  return passages;
}

}  // namespace

std::string bound_below(double least) {
  if (!std::isfinite(least)) return "";
  const double decade = std::pow(10.0, std::floor(std::log10(least)));
  double digit = std::floor(least / decade);
  if (!(digit * decade < least)) --digit;
  return "> " + (digit > 0 ? format_digits(digit * decade, 1) : format_digits(0.9 * decade, 1));
}

std::vector<CutNumber> numbers_along(const std::vector<CutLength>& lengths, double fps) {
  const std::size_t count = lengths.size();
  std::vector<CutNumber> numbers(count);
  for (std::size_t begin = 0, end = 0; begin < count; begin = end + 1) {
    for (end = begin; end < count && lengths[end]; ++end) {}
    for (const Passage& passage : passages_of(lengths, begin, end, fps)) {
      double least = HUGE_VAL;
      for (std::size_t k = passage.begin; k < passage.end; ++k) least = std::min(least, *lengths[k]);
      // Of one that is short a third to come, a third to stand.
      const double way = std::max(1.0, std::round(std::min(kComing * fps, double(passage.end - passage.begin) / 3)));
      const std::string bound = passage.is_bound ? bound_below(least) : "";
      for (std::size_t k = passage.begin; k < passage.end; ++k) {
        // What is there in the first frame of the film has not come, and in the last one it does not go.
        const double since = passage.begin == 0 ? way : double(k - passage.begin + 1), until = passage.end == count ? way : double(passage.end - k);
        numbers[k] = {*lengths[k], bound, std::min({1.0, since / way, until / way})};
      }
    }
  }
  return numbers;
}

}  // namespace chainreel
