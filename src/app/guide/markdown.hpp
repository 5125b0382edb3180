// Markdown that reads well in a terminal, too.
#pragma once

#include <string>
#include <vector>

namespace chainreel {

// A table whose columns are as wide as their longest cell; the first row is its head. `|` in cells is escaped.
std::string markdown_table(const std::vector<std::vector<std::string>>& rows);
std::string code(const std::string& text);                                // `text`, "" of nothing
std::string code_block(const std::string& language, const std::string& text);

}  // namespace chainreel
