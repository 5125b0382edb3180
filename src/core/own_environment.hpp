// Variables of the environment by which libraries would draw or shape otherwise: they are the program's own choice, so that
// bytes are the same wherever it runs.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace chainreel {

// For this process and what it starts, before the library that reads it does. A null value: it must not be set.
void set_own_variable(const char* name, const char* value);

// The same for all whose names begin so, but those in `kept`.
void clear_variables(std::span<const std::string_view> beginnings, std::span<const std::string_view> kept = {});

// "NAME=value" of those that were otherwise before; what they said is not followed.
std::vector<std::string> overruled_variables();

}  // namespace chainreel
