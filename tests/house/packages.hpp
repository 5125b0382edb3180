// The one list of Debian packages, packages.txt: sections in brackets, a package a line, `#` starts a
// comment.
#pragma once

#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <string_view>

namespace chainreel {

// Section -> packages. Throws std::runtime_error on a line that is none of the above.
std::map<std::string, std::set<std::string>> read_packages(std::string_view text);

// The packages that a page asks its reader to install: the words behind `apt install` or `apt-get install`
// that are not options, to the end of the command (a backslash continues it).
std::set<std::string> packages_named_by(std::string_view page);

}  // namespace chainreel
