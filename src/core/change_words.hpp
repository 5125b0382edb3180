// What changed, and by how much, in words: numbers with as many digits as tell them apart.
#pragma once

#include <string>

namespace chainreel {

// "1.2 kg"; the unit may be "".
std::string amount_text(const std::string& number, const std::string& unit);

// "1.2 -> 1.25 kg"; the unit may be "". As many digits as show the change to a fiftieth of it, six at least
// where there are so many.
std::string change_text(double before, double after, const std::string& unit);
std::string change_text(const std::string& before, const std::string& after);

// Of a way or a turn, three digits: "4 mm", "1.2 m"; "0.1 deg".
std::string length_text(double metres);
std::string angle_text(double radians);

}  // namespace chainreel
