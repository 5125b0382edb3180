// Standard output and error as this program uses them.
#pragma once

#include "core/error.hpp"

namespace chainreel {

// From now on whatever is printed is fit for a terminal (core/printable), and no line of standard error is longer than
// some lines of a terminal. Streams that the caller closed are held by ones that take nothing, so that no file of ours
// gets their number. To be called first.
void guard_streams();

// Every problem on standard error: each some lines long at most, temporary files under their final names.
void print_error(const Error& error);

// Hands on what was printed. False, with words on standard error, where not all of it was taken.
bool flush_standard_output();

}  // namespace chainreel
