#include <algorithm>
#include <sstream>

#include "app/guide/manual.hpp"

namespace chainreel {
namespace {

// Characters as a terminal counts them, of text without wide ones.
std::size_t width_of(std::string_view text) {
  return std::size_t(std::count_if(text.begin(), text.end(), [](char c) { return (static_cast<unsigned char>(c) & 0xC0) != 0x80; }));
}

// Where what continues a line begins: below a table's last column, behind a list's dash, else as the line itself.
std::size_t indent_of(const std::string& line, std::size_t columns) {
  const std::size_t begin = std::min(line.find_first_not_of(' '), line.size());
  if (line.compare(begin, 2, "- ") == 0) return begin + 2;
  if (line.compare(begin, 2, "| ") != 0) return begin;
  const std::size_t end = line.find_last_not_of(" |"), last = end == std::string::npos ? end : line.rfind(" | ", end);
  const std::size_t column = last == std::string::npos ? begin + 2 : width_of(std::string_view(line).substr(0, last + 3));
  return column <= columns * 2 / 3 ? column : begin + 4;
}

// What pages break at their own width, each paragraph and each entry of a list in one line again. Code and tables stay.
std::string with_whole_paragraphs(const std::string& page) {
  std::string whole;
  bool is_code = false, goes_on = false;
  std::istringstream lines(page);
  for (std::string line; std::getline(lines, line);) {
    const std::size_t begin = std::min(line.find_first_not_of(' '), line.size());
    const bool is_fence = line.compare(begin, 3, "```") == 0;
    const bool is_own = line.empty() || is_code || is_fence || line[begin] == '|' || line[begin] == '#' || line.compare(begin, 2, "- ") == 0;
    if (goes_on && !is_own)
      whole.back() = ' ', whole += line.substr(begin) + "\n";
    else
      whole += line + "\n";
    if (is_fence) is_code = !is_code;
    goes_on = !line.empty() && !is_code && !is_fence && line[begin] != '|' && line[begin] != '#';
  }
  return whole;
}

}  // namespace

std::string page_on_terminal(const std::string& page, std::size_t columns) {
  std::string shown;
  std::istringstream lines(with_whole_paragraphs(page));
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with("| -")) line.resize(std::min(line.size(), columns));
    const std::size_t indent = indent_of(line, columns);
    if (width_of(line) > columns && line.starts_with("| ") && line.ends_with(" |")) line.erase(line.find_last_not_of(" |") + 1);
    for (bool is_first = true; width_of(line) > columns; is_first = false) {
      // The last blank within the columns, behind what indents the line; where there is none, the next one.
      std::size_t cut = std::string::npos, seen = 0;
      const std::size_t words = is_first ? line.find_first_not_of(' ') + 1 : indent;
      for (std::size_t i = 0; i < line.size() && (seen <= columns || cut == std::string::npos); ++i) {
        if (line[i] == ' ' && i > words && (i > indent || is_first)) cut = i;
        if ((static_cast<unsigned char>(line[i]) & 0xC0) != 0x80) ++seen;
      }
      if (cut == std::string::npos) break;
      const std::size_t next = line.find_first_not_of(' ', cut);
      if (next == std::string::npos) break;
      shown += line.substr(0, line.find_last_not_of(' ', cut) + 1) + "\n";
      line = std::string(indent, ' ') + line.substr(next);
    }
    shown += line + "\n";
  }
  return shown;
}

}  // namespace chainreel
