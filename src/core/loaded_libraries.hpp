// Which builds of libraries this process runs with: two of one version may still differ.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace chainreel {

// "libx264.so.164 5f1c.." of each that is loaded and whose file's name begins as one of these, in the order of names: with its build id,
// else the hash of its file.
std::vector<std::string> loaded_libraries(std::span<const std::string_view> beginnings);

// Has the system take back the memory in which these libraries' code lies; what of it is called again comes back from the file.
void give_code_back(std::span<const std::string_view> beginnings);

}  // namespace chainreel
