// Files that are read: plain files of a size that memory can bear, and a list of them, so that no output replaces what
// the run was made of.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace chainreel {

inline constexpr std::uintmax_t kLargestInput = std::uintmax_t(1) << 30;  // bytes

// Throws Error (exit 3) unless `path` is a plain file: a pipe would wait for ever, a device never end. Throws Error (exit
// 7) where it is larger than `largest`.
void require_plain_file(const std::string& path, std::uintmax_t largest = kLargestInput);

// All its bytes. Throws as above, and Error (exit 3) where it cannot be read.
std::string read_plain_file(const std::string& path, std::uintmax_t largest = kLargestInput);

// What came by standard input, under a name of its own that no file needs to have: known to those that read scenes.
inline constexpr const char* kStandardInput = "stdin";
void hold_standard_input(std::string text);
const std::string* standard_input_at(const std::string& path);  // null where the path is another, or nothing came

// Remembers the file at `path`, if there is one, as an input of this program's run. Safe among threads.
void note_input(const std::string& path);

// The name under which the very file at `path` was noted, through links of either kind; "" where it was not.
std::string noted_input(const std::string& path);

// The names of all that was noted, sorted.
std::vector<std::string> noted_inputs();

}  // namespace chainreel
