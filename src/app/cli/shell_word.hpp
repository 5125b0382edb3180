// Words as a shell takes them.
#pragma once

#include <string>

namespace chainreel {

// As it is where a shell leaves it so, else in single quotes.
std::string shell_word(const std::string& word);

}  // namespace chainreel
