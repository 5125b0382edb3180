// Where ticks stand and what they say.
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numbers>

#include "core/format.hpp"
#include "picture/plot.hpp"

namespace chainreel {
namespace {

constexpr double kSlack = 1e-9;  // of a step: an end of the axis that is a tick up to round-off has its tick
constexpr double kDecadesWithParts = 4.2;     // log axes up to this long show 2 .. 9 of each decade
constexpr double kDecadesOfPlainTicks = 1.5;  // and up to this long label 1, 2, 5
constexpr const char* kMinusSign = "\u2212";

std::string signed_text(std::string digits) {
  return digits.starts_with('-') ? kMinusSign + digits.substr(1) : digits;
}

// 10^n with what stands before it: "3 x 10" and "-4".
Tick tick_with_power(double value, const std::string& mantissa, int exponent) {
  const std::string base = mantissa.empty() ? "10" : mantissa + "\u00D710";
  return {value, base, signed_text(std::to_string(exponent))};
}

Tick power_of_ten(int exponent) {
  const double value = std::pow(10.0, exponent);
  if (exponent == 0) return {value, "1", ""};
  if (exponent == 1) return {value, "10", ""};
  return tick_with_power(value, "", exponent);
}

double nice_step(double range, int most) {
  const double least = range / std::max(most, 1);
  const double decade = std::pow(10.0, std::floor(std::log10(least)));
  for (const double factor : {1.0, 2.0, 5.0})
    if (factor * decade >= least * (1 - kSlack)) return factor * decade;
  return 10 * decade;
}

// Whole multiples of `step` inside the axis.
std::vector<double> multiples(const Axis& axis, double step) {
  std::vector<double> found;
  const double first = std::ceil(axis.low / step - kSlack), last = std::floor(axis.high / step + kSlack);
  for (double k = first; k <= last; ++k) found.push_back(k * step);
  return found;
}

std::vector<Tick> linear_ticks(const Axis& axis, int most) {
  const double range = axis.high - axis.low;
  if (!(range > 0) || !std::isfinite(range)) return {};
  // That many ticks may stand on one interval more than their number.
  double step = nice_step(range, most + 1);
  while (int(multiples(axis, step).size()) > most) step = nice_step(step * 1.5, 1);
  const double largest = std::max(std::abs(axis.low), std::abs(axis.high));
  const int step_exponent = int(std::floor(std::log10(step) + kSlack));
  const int exponent = int(std::floor(std::log10(largest) + kSlack));
  // Small steps beside 1 to 9999 need digits, not a power: 1.04720.
  const bool needs_power = largest >= 1e5 || (step < 0.999e-4 && !(exponent >= 0 && step >= 0.999e-7));
  const int decimals = std::max(0, (needs_power ? exponent : 0) - step_exponent);
  std::vector<Tick> ticks;
  for (const double value : multiples(axis, step)) {
    if (needs_power && value != 0)
      ticks.push_back(tick_with_power(
          value, signed_text(format_fixed(value / std::pow(10.0, exponent), decimals)), exponent));
    else
      ticks.push_back({value, signed_text(format_fixed(value, needs_power ? 0 : decimals)), ""});
  }
  return ticks;
}

// "pi/2", "-3pi/2", "2pi" with the Greek letter; `halves` of pi.
std::string angle_text(long halves) {
  if (halves == 0) return "0";
  const bool is_whole = halves % 2 == 0;
  const long count = std::labs(is_whole ? halves / 2 : halves);
  return (halves < 0 ? kMinusSign : "") + (count == 1 ? "" : std::to_string(count)) + "\u03C0" +
         (is_whole ? "" : "/2");
}

std::vector<Tick> angle_ticks(const Axis& axis, int most) {
  using std::numbers::pi;
  if (!(axis.high - axis.low >= pi)) return linear_ticks(axis, most);
  std::vector<Tick> ticks;
  for (long halves : {1, 2, 4, 8, 10, 20, 40, 100, 200, 400, 1000}) {
    ticks.clear();
    for (const double value : multiples(axis, halves * pi / 2))
      ticks.push_back({value, angle_text(std::lround(value / (pi / 2))), ""});
    if (int(ticks.size()) <= most) return ticks;
  }
  return linear_ticks(axis, most);  // thousands of turns read better as numbers
}

// 1, 2 and 5 of each decade, written out where that is short.
std::vector<Tick> plain_log_ticks(const Axis& axis) {
  std::vector<Tick> ticks;
  const int first = int(std::floor(std::log10(axis.low))), last = int(std::ceil(std::log10(axis.high)));
  for (int exponent = first; exponent <= last; ++exponent)
    for (int digit = 1; digit <= 9; ++digit) {
      const double value = digit * std::pow(10.0, exponent);
      if (value < axis.low * (1 - kSlack) || value > axis.high * (1 + kSlack)) continue;
      const bool has_label = digit == 1 || digit == 2 || digit == 5;
      const bool is_short = exponent >= -3 && exponent <= 3;
      if (!has_label)
        ticks.push_back({value, "", ""});
      else if (is_short)
        ticks.push_back({value, format_fixed(value, std::max(0, -exponent)), ""});
      else
        ticks.push_back(digit == 1 ? power_of_ten(exponent)
                                   : tick_with_power(value, std::to_string(digit), exponent));
    }
  return ticks;
}

int multiples_between(int first, int last, int stride) {
  int count = 0;
  for (int n = first; n <= last; ++n) count += n % stride == 0;
  return count;
}

// Of decades: 1, 2, 3, 4, 5, 6, 10, 20, 30, 50, 100, ..
int next_stride(int stride) {
  int of_ten = 1;
  while (stride >= 10 * of_ten) of_ten *= 10;
  const int digit = stride / of_ten;
  if (of_ten == 1) return digit < 6 ? digit + 1 : 10;
  return of_ten * (digit < 3 ? digit + 1 : digit < 5 ? 5 : 10);
}

std::vector<Tick> log_ticks(const Axis& axis, int most) {
  if (!(axis.low > 0) || !(axis.high > axis.low) || !std::isfinite(axis.high)) return {};
  const double low = std::log10(axis.low), high = std::log10(axis.high);
  if (high - low < kDecadesOfPlainTicks) return plain_log_ticks(axis);
  const int first = int(std::ceil(low - kSlack)), last = int(std::floor(high + kSlack));
  int stride = 1;
  while (multiples_between(first, last, stride) > most) stride = next_stride(stride);

  std::vector<Tick> ticks;
  for (int exponent = first - 1; exponent <= last; ++exponent) {
    const bool is_inside = exponent >= first;
    if (is_inside && exponent % stride == 0) ticks.push_back(power_of_ten(exponent));
    if (is_inside && exponent % stride != 0) ticks.push_back({std::pow(10.0, exponent), "", ""});
    for (int digit = 2; high - low <= kDecadesWithParts && digit <= 9; ++digit) {
      const double value = digit * std::pow(10.0, exponent);
      if (value > axis.low && value < axis.high) ticks.push_back({value, "", ""});
    }
  }
  return ticks;
}

}  // namespace

// At every one of the values, or every other one, ..
static std::vector<Tick> ticks_at(const std::vector<double>& values, int most) {
  const std::size_t every = (values.size() + std::size_t(std::max(most, 1)) - 1) / std::size_t(std::max(most, 1));
  std::vector<Tick> ticks;
  for (std::size_t i = 0; i < values.size(); i += every) ticks.push_back({values[i], signed_text(format_significant(values[i], 4)), ""});
  return ticks;
}

std::vector<Tick> ticks_of(const Axis& axis, int most) {
  if (!axis.at.empty()) return ticks_at(axis.at, most);
  switch (axis.scale) {
    case Scale::linear:
      return linear_ticks(axis, most);
    case Scale::angle:
      return angle_ticks(axis, most);
    case Scale::log:
      return log_ticks(axis, most);
  }
  return {};
}

Axis rounded_out(Axis axis) {
  constexpr int kMostSteps = 5;
  if (axis.scale == Scale::log) {
    axis.low = std::pow(10.0, std::floor(std::log10(axis.low) + kSlack));
    axis.high = std::pow(10.0, std::ceil(std::log10(axis.high) - kSlack));
    if (!(axis.high > axis.low)) axis.high = 10 * axis.low;
    return axis;
  }
  if (!(axis.high > axis.low)) {  // a constant: room above and below it
    const double room = axis.low == 0 ? 1 : std::abs(axis.low) / 2;
    axis.low -= room;
    axis.high += room;
  }
  const bool in_quarters = axis.scale == Scale::angle && axis.high - axis.low >= std::numbers::pi;
  const double step = in_quarters ? std::numbers::pi / 2 : nice_step(axis.high - axis.low, kMostSteps);
  axis.low = step * std::floor(axis.low / step + kSlack);
  axis.high = step * std::ceil(axis.high / step - kSlack);
  return axis;
}

}  // namespace chainreel
