// Numbers of vectors that are longer than their scale has room for. A number that runs cannot be read, and one that is there for an
// instant neither: for as long as such a passage lasts, and a blink behind, one number stands, that of its peak.
#pragma once

#include <optional>
#include <span>
#include <vector>

namespace chainreel {

struct Peak {
  double value = 0;        // with its sign
  bool is_steady = false;  // what it says is true at all frames at which it stands, and not at the peak alone
  bool is_told = true;     // else the word has its place, but names what it stands at: in a picture by itself of what is not cut there
};

// What is said at each frame of a film of so many a second: of `values`, those beyond `cut` are cut. Passages of one sense that lie
// near to one another are one; what is cut for so short between others that nobody could read its number has none.
std::vector<std::optional<Peak>> peaks_along(const std::vector<double>& values, double cut, double fps);

// Frames pass by what lies between them, and curves beside them do not: of each of `values` at instants `t` the largest up to its
// neighbours, in its sense, of the same at the instants `curve_t`, s, rising.
std::vector<double> extremes_near(std::span<const double> values, std::span<const double> t, std::span<const double> curve, std::span<const double> curve_t);

}  // namespace chainreel
