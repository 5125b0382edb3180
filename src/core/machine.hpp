// Where a measurement was taken.
#pragma once

#include <string>

namespace chainreel {

std::string processor_name();  // as /proc/cpuinfo says
std::string system_name();     // as /etc/os-release says
std::string compiler_name();   // that built the program

// What follows `separator` in the first line of a file that starts with `key`, without quotes; "unknown"
// where there is none.
std::string value_in_file(const char* path, const std::string& key, char separator);

}  // namespace chainreel
