// When a run of the program on spoilt input is a fault of the program.
#pragma once

#include <string>
#include <vector>

#include "support/run_program.hpp"

namespace chainreel {

inline constexpr double kHang = 60;  // s: nothing that the cases ask for takes a tenth of it, also under load

// "" or what is wrong: a signal, no end, an undocumented exit code, an exception that nobody expected, a failure without a
// word, more words than anybody reads, bytes that a terminal takes as orders, or files left behind: hidden ones ever, and
// after a failure any that is not called .partial.
std::string fault_of(const ProgramResult& result, const std::vector<std::string>& new_files);

}  // namespace chainreel
