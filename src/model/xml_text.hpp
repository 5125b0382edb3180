// The text of an XML file, held to limits before any parser sees it: parsers recurse, and spend many times
// the text's size, so a hostile file must be refused by a scan that does neither.
#pragma once

#include <cstddef>
#include <string>

namespace chainreel {

inline constexpr std::size_t kLargestXmlFile = std::size_t(16) << 20;  // bytes
inline constexpr int kDeepestXml = 64;                                 // elements inside one another
inline constexpr int kMostXmlElements = 150'000;  // some 12,000 links with inertia, shape and joint
inline constexpr int kLongestXmlTag = 8192;       // characters: names and paths are repeated in messages
inline constexpr int kMostXmlAttributes = 64;     // in one tag: parsers compare each with all others

// Throws Error: exit 3 where the file cannot be read or is no text, exit 7 beyond a limit.
std::string read_xml_text(const std::string& path);

// The scan alone: depth, number of elements, tags. Throws Error (exit 7, with the line).
void check_xml_limits(const std::string& text, const std::string& path);

// The same for two texts that differ in nothing but comments and line breaks. Throws Error (exit 3) where it is no XML; `path` is named.
std::string sha256_of_elements(const std::string& text, const std::string& path);

}  // namespace chainreel
