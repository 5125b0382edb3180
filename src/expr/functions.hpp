// The functions that expressions know, as they are told to people.
#pragma once

#include <vector>

#include "core/names.hpp"

namespace chainreel {

// "atan2(y, x)" and what it is.
std::vector<Name> expression_functions();

}  // namespace chainreel
