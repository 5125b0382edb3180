#include "draw/layers/cut_numbers.hpp"

#include <algorithm>
#include <cmath>

#include "core/format.hpp"
#include "draw/page/scales.hpp"

namespace chainreel {
namespace {

constexpr double kQuick = 1.3;         // times: more than that within kGlance, the third digit is not all that runs
constexpr double kGlance = 0.25;       // s: as long as an eye takes for a number
constexpr double kLeastReading = 0.5;  // s: words that stand shorter are not read before they change
constexpr double kLeastBound = 0.3;    // s: of one digit, and no shorter than any word stands
constexpr double kComing = 0.15;       // s: to come, and to go
constexpr double kOpen = 1e9;          // kg or m/s: as much an open axis counts where bounds are chosen
constexpr double kWritten = 1e5;       // numbers from here on are powers of ten

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

// Numbers stand for as long as it takes to read them, bounds between them and where the axis leads far out.
std::vector<Passage> passages_of(const std::vector<CutLength>& lengths, std::size_t begin, std::size_t end, double fps, double far_out) {
  const double least = kLeastReading * fps;
  std::vector<bool> bound = quick_frames(lengths, begin, end, fps);
  for (std::size_t k = begin; k < end; ++k)
    if (*lengths[k] > far_out) bound[k - begin] = true;
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

// The largest of 1, 2, 5 x 10^n below it.
double step_below(double length) {
  const double step = round_length(length);
  return step < length ? step : round_length(0.9 * length);
}

// The bounds of a passage: each stands for as long as it takes to read it, and so they are the largest that hold at every frame.
std::vector<double> bounds_along(const std::vector<CutLength>& lengths, const Passage& passage, double fps) {
  const std::size_t count = passage.end - passage.begin, shortest = std::clamp<std::size_t>(std::size_t(std::ceil(kLeastBound * fps)), 1, count);
  struct Way {
    double worth = -HUGE_VAL, bound = 0;
    std::size_t from = 0;
  };
  // Of the frames before k; a bound that stands twice as long might as well be two.
  std::vector<Way> ways(count + 1);
  ways[0].worth = 0;
  for (std::size_t k = shortest; k <= count; ++k) {
    double least = HUGE_VAL;
    for (std::size_t stood = 1; stood <= std::min(k, 2 * shortest); ++stood) {
      least = std::min(least, *lengths[passage.begin + k - stood]);
      const Way& before = ways[k - stood];
      if (stood < shortest || !(before.worth > -HUGE_VAL)) continue;
      const double bound = std::isfinite(least) ? step_below(least) : least;
      const double worth = before.worth + double(stood) * std::log(std::min(bound, kOpen));
      if (worth > ways[k].worth) ways[k] = {worth, bound, k - stood};
    }
  }
  std::vector<double> bounds(count);
  for (std::size_t k = count; k > 0; k = ways[k].from)
    std::fill(bounds.begin() + std::ptrdiff_t(ways[k].from), bounds.begin() + std::ptrdiff_t(k), ways[k].bound);
  return bounds;
}

std::string words_of_bound(double bound) {
  if (!std::isfinite(bound)) return "";
  return "> " + (bound < kWritten ? format_digits(bound, 1) : format_power(bound));
}

}  // namespace

std::string bound_below(double length) {
  return words_of_bound(std::isfinite(length) ? step_below(length) : length);
}

std::vector<CutNumber> numbers_along(const std::vector<CutLength>& lengths, double fps, double far_out) {
  const std::size_t count = lengths.size();
  std::vector<CutNumber> numbers(count);
  for (std::size_t begin = 0, end = 0; begin < count; begin = end + 1) {
    for (end = begin; end < count && lengths[end]; ++end) {}
    for (const Passage& passage : passages_of(lengths, begin, end, fps, far_out)) {
      // Of one that is short a third to come, a third to stand.
      const double way = std::max(1.0, std::round(std::min(kComing * fps, double(passage.end - passage.begin) / 3)));
      const std::vector<double> bounds = passage.is_bound ? bounds_along(lengths, passage, fps) : std::vector<double>();
      for (std::size_t k = passage.begin; k < passage.end; ++k) {
        // What is there in the first frame of the film has not come, and in the last one it does not go.
        const double since = passage.begin == 0 ? way : double(k - passage.begin + 1), until = passage.end == count ? way : double(passage.end - k);
        const std::string bound = passage.is_bound ? words_of_bound(bounds[k - passage.begin]) : "";
        numbers[k] = {*lengths[k], bound, std::min({1.0, since / way, until / way})};
      }
    }
  }
  return numbers;
}

}  // namespace chainreel
