// Where a measurement was taken.
#pragma once

#include <cstddef>
#include <string>

namespace chainreel {

std::string processor_name();  // as /proc/cpuinfo says
std::string system_name();     // as /etc/os-release says
std::string compiler_name();   // that built the program

// What follows `separator` in the first line of a file that starts with `key`, without quotes; "unknown"
// where there is none.
std::string value_in_file(const char* path, const std::string& key, char separator);

// Processors that this process may use at the same time: those that it is bound to, as far as its control group has time
// for them. At least 1.
int usable_cores();

// How much memory may be taken, so that what cannot fit is refused before it is begun.

// Bytes that this process may still take: the least of what the limits of the process and of its control group leave, and
// the machine's memory.
double memory_limit();

// Throws Error (exit 7) with both numbers where `what`, like "a picture of 100x100 px", needs more than there may be.
void require_memory(double bytes, const std::string& what);

// Has large pieces of memory go back to the system when they are freed, from now on. Else the first one that is freed makes
// the C library keep all of its size, and what encoders and renderers take by turns adds up.
void give_large_memory_back();
// What was freed and lies between what is held.
void give_freed_memory_back();

// "x86_64": all processors of one architecture draw the same pixels.
std::string processor_architecture();

}  // namespace chainreel
