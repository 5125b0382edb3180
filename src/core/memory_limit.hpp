// How much memory may be taken, so that what cannot fit is refused before it is begun.
#pragma once

#include <string>

namespace chainreel {

// Bytes that this process may still take: the least of what the limits of the process and of its control group leave, and
// the machine's memory.
double memory_limit();

// Throws Error (exit 7) with both numbers where `what`, like "a picture of 100x100 px", needs more than there may be.
void require_memory(double bytes, const std::string& what);

}  // namespace chainreel
