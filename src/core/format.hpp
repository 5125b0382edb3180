// Numbers as text and back, always in the C locale.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace chainreel {

std::string format_shortest(double value);             // fewest digits that read back as the same double
std::string format_exact(double value);                // 17 significant digits
std::string format_fixed(double value, int decimals);  // never "-0.00"
std::string format_significant(double value, int digits);

std::string joined(const std::vector<std::string>& words, const std::string& between = ", ");
std::string quoted_list(const std::vector<std::string>& names);  // 'a', 'b'
std::string bracketed(const std::vector<double>& values);  // [1, 0.25, -3], six digits

// The whole text must be one finite number; leading '+' allowed, nothing else around it.
std::optional<double> parse_number(std::string_view text);

}  // namespace chainreel
