// Words as a shell takes them.
#pragma once

#include <string>
#include <vector>

namespace chainreel {

// As it is where a shell leaves it so, else in single quotes.
std::string shell_word(const std::string& word);
// A whole line of them.
std::string shell_line(const std::vector<std::string>& words);

}  // namespace chainreel
