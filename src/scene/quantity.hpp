// One number as people write it: `1.5`, `90deg`, `pi/2`, `20ms`, `0.3 m`.
#pragma once

#include <string>

#include "core/error.hpp"

namespace chainreel {

// In SI units and radians. A unit is of the whole text, `2 + 1 m` being 3 m, but deg where it stands right behind a number, as it does
// in expressions: what is another angle in one way of reading than in the other, `1 + 90deg`, is refused. `in` is the unit that the number is told in, as the reference has it ("s", "rad", "rad or m");
// "": any. Throws Error at `place`, also of a unit of another kind: an instant of 90deg is none.
double parse_quantity(const std::string& text, const Place& place, const std::string& in = "");

// Whether a unit stands behind the number.
bool has_unit(const std::string& text);
// That unit's kind, as `rad` of 90deg; "": there is none.
std::string unit_kind(const std::string& text);

// "90 is in radians, 14.3 turns: for degrees write 90deg, for radians 90rad": of a number without a unit of more than a whole turn,
// which likely are degrees; "" of others. `of`: put behind the number, " of joint1".
std::string doubt_of_angle(const std::string& text, double value, const std::string& of = "");
// An angle, where nobody means more than a turn. Throws Error of what is doubtful, too.
double parse_angle(const std::string& text, const Place& place);

}  // namespace chainreel
