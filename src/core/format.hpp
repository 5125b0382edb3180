// Numbers as text and back, always in the C locale.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace chainreel {

std::string format_shortest(double value);             // fewest digits that read back as the same double
std::string format_fixed(double value, int decimals);  // never "-0.00"
std::string format_power(double value);               // "3\u00D710\u207B\u00B9\u2074": of what is above zero, one digit
std::string format_significant(double value, int digits);  // below 1e5 without an exponent: 430 of 432.1, two digits

double rounded_down(double value, int digits);  // to so many, of what is not below zero

// So many digits also where the last ones are zeros, as numbers of one table have them: 4.10 of 4.1, three digits.
std::string format_digits(double value, int digits);

// ".mp4" of "a/B.MP4", as cameras and editors write it; "" where there is none.
std::string lower_case_ending(const std::string& path);

std::string joined(const std::vector<std::string>& words, const std::string& between = ", ");
// Without what stands at both ends of it: spaces, tabs, carriage returns.
std::string trimmed(const std::string& text);
// What stands between the signs: "a,,b" is three, nothing none; behind the last sign nothing is counted.
std::vector<std::string> separated(const std::string& text, char sign);
std::string quoted_list(const std::vector<std::string>& names);  // 'a', 'b'
std::string bracketed(const std::vector<double>& values, int digits = 6);  // [1, 0.25, -3]

// The whole text must be one finite number; leading '+' allowed, nothing else around it.
std::optional<double> parse_number(std::string_view text);

// Text of others (names, titles, cells of tables) made fit for a terminal, which takes some bytes as orders.

// Control characters but newline and tabulator, marks that turn the direction of writing, and bytes that are no UTF-8
// as \u001b, in the way of JSON, which stays JSON; all else as it is.
std::string printable(std::string_view text);

// The characters of a text; bytes that are no UTF-8 become U+FFFD.
std::u32string code_points(std::string_view text);

// `printable` of a text that comes in pieces: a character may be cut between two of them.
class PrintableStream {
 public:
  std::string next(std::string_view piece);
  std::string end();  // what was left waiting for its other half

 private:
  std::string waiting_;
};

// At most about `most` bytes, whole characters; what was cut off is said: "abc.. (60000 bytes more)".
std::string shortened(std::string_view text, std::size_t most);

}  // namespace chainreel
