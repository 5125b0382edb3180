// The text of an XML file, held to limits before any parser sees it: parsers recurse, and spend many times
// the text's size, so a hostile file must be refused by a scan that does neither.
#pragma once

#include <cstddef>
#include <string>

namespace chainreel {

inline constexpr std::size_t kLargestXmlFile = std::size_t(32) << 20;  // bytes
inline constexpr int kDeepestXml = 64;                                 // elements inside one another
inline constexpr int kMostXmlElements = 300'000;  // some 25,000 links with inertia, shape and joint

// Throws Error: exit 3 where the file cannot be read or is no text, exit 7 beyond a limit.
std::string read_xml_text(const std::string& path);

// The scan alone: depth and number of elements. Throws Error (exit 7, with the line).
void check_xml_limits(const std::string& text, const std::string& path);

}  // namespace chainreel
