// Results as JUnit XML, for services that show those of tests.
#pragma once

#include <string>
#include <vector>

namespace chainreel {

struct JunitCase {
  std::string group, name;  // printable() is not asked of them
  std::string fault{};      // its kind, "changed"; "": it passes
  std::string message{}, text{};
  bool is_error = false;    // nothing could be compared
};

// One suite, by a command as "verify", by whose name it is known as ours and told from others'.
std::string junit_text(const std::string& command, const std::string& suite, const std::vector<JunitCase>& cases);

// Whether the head of a file is such a text's.
bool is_own_junit(const std::string& head);

// To a file, which replaces none but such a one. Throws Error (file).
void write_junit(const std::string& path, const std::string& text);

}  // namespace chainreel
