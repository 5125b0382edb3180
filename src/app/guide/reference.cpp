#include "app/guide/reference.hpp"

#include <algorithm>

namespace chainreel {
namespace {

std::string escaped(const std::string& cell) {
  std::string text;
  for (const char c : cell) text += c == '|' ? "\\|" : std::string(1, c);
  return text;
}

// Letters, not bytes.
std::size_t width_of(const std::string& text) {
  return std::size_t(std::count_if(text.begin(), text.end(), [](char c) { return (c & 0xC0) != 0x80; }));
}

}  // namespace

std::string markdown_table(const std::vector<std::vector<std::string>>& rows) {
  std::vector<std::size_t> widths;
  for (const auto& row : rows) {
    widths.resize(std::max(widths.size(), row.size()), 3);
    for (std::size_t i = 0; i < row.size(); ++i) widths[i] = std::max(widths[i], width_of(escaped(row[i])));
  }
  std::string text;
  const auto add_row = [&](const std::vector<std::string>& row) {
    for (std::size_t i = 0; i < row.size(); ++i) {
      const std::string cell = escaped(row[i]);
      // The last column is not filled up: its sentences differ much in length.
      text += "| " + cell + std::string(i + 1 < row.size() ? widths[i] - width_of(cell) : 0, ' ') + " ";
    }
    text += "|\n";
  };
  add_row(rows.front());
  std::vector<std::string> rule;
  for (std::size_t i = 0; i < rows.front().size(); ++i)
    rule.push_back(std::string(i + 1 < rows.front().size() ? widths[i] : 3, '-'));
  add_row(rule);
  for (std::size_t i = 1; i < rows.size(); ++i) add_row(rows[i]);
  return text;
}

std::string code(const std::string& text) {
  return text.empty() ? "" : "`" + text + "`";
}

std::string code_block(const std::string& language, const std::string& text) {
  return "```" + language + "\n" + text + (text.ends_with('\n') ? "" : "\n") + "```\n";
}

}  // namespace chainreel
