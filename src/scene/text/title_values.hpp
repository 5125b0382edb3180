// Values as titles have them. Internal to this shelf.
#pragma once

#include <string>
#include <vector>

namespace chainreel {

// Signs as one reads them: "\u22120.5" of "-0.5".
std::string with_minus_signs(const std::string& text);

// A value and the unit behind it; degrees are part of the value.
struct TitleValue {
  std::string words, unit;
  friend bool operator==(const TitleValue&, const TitleValue&) = default;
};

// Of a number, "30deg" and an expression as YAML has them; `unit`: of the number, SI. Angles in rad become degrees, expressions keep their
// numbers and have no unit.
TitleValue title_value(const std::string& text, const std::string& unit);

// "2 kg"; of several "(1, 0) N m", units within where they differ.
std::string joined_value(const TitleValue& value);
std::string joined_values(const std::vector<TitleValue>& values);

// Numbers of more digits than one reads, such as those of degrees in rad, with four of them; whole parts of pi with its letter.
std::string with_readable_numbers(const std::string& text);

}  // namespace chainreel
