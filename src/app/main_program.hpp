// What every executable of this program does from its first line to its exit code.
#pragma once

#include "app/cli/command_line.hpp"

namespace chainreel {

// Runs the command that the words name, of those that add_commands adds; whatever goes wrong is told and is an exit code.
int main_program(int argc, char** argv, void (*add_commands)(CommandLine&));

}  // namespace chainreel
