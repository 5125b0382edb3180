// Pages for terminals, manual pages and completion of shells, made of the command line's own table.
#pragma once

#include <string>

#include "app/cli/command_line.hpp"
#include "core/names.hpp"

namespace chainreel {

enum class Shell { bash, zsh, fish };
std::span<const Name> names_of(Shell);

// The script that teaches a shell the commands, their options, and the words that these take.
std::string completion_script(const CommandLine& app, Shell shell);

// chainreel(1), or with a command's name chainreel-NAME(1), in the man macros of roff; `version` stands at its foot. Throws Error (usage) of a name
// that is none.
std::string manual_page(const CommandLine& app, const std::string& version, const std::string& command = "");

// A page of the guide as a terminal of so many columns shows it: paragraphs fill its lines, longer rows go on in the next one, below the table's
// last column or the list's words.
std::string page_on_terminal(const std::string& page, std::size_t columns);

}  // namespace chainreel
