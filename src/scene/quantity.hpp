// One number as people write it: `1.5`, `90deg`, `pi/2`.
#pragma once

#include <string>

#include "core/error.hpp"

namespace chainreel {

// In SI units and radians. Throws Error at `place`.
double parse_quantity(const std::string& text, const Place& place);

}  // namespace chainreel
