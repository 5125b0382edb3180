#include "app/verify/key_difference.hpp"

#include <algorithm>
#include <optional>
#include <string_view>
#include <utility>

#include "core/change_words.hpp"
#include "core/format.hpp"

namespace chainreel {
namespace {

std::string trimmed(std::string_view text) {
  const std::size_t begin = text.find_first_not_of(' ');
  if (begin == std::string_view::npos) return "";
  return std::string(text.substr(begin, text.find_last_not_of(' ') + 1 - begin));
}

// Where a character stands outside of quotes and brackets, from `from` on; npos: nowhere. What an expression says in
// round brackets holds commas of its own.
std::size_t find_outside(std::string_view text, char wanted, std::size_t from) {
  int depth = 0;
  char quote = 0;
  for (std::size_t i = from; i < text.size(); ++i) {
    const char c = text[i];
    if (quote != 0) {
      if (c == '\\' && quote == '"') ++i;
      else if (c == quote) quote = 0;
    } else if (c == '"' || c == '\'') {
      quote = c;
    } else if (depth == 0 && c == wanted) {
      return i;
    } else if (c == '[' || c == '{' || c == '(') {
      ++depth;
    } else if (c == ']' || c == '}' || c == ')') {
      --depth;
    }
  }
  return std::string_view::npos;
}

bool is_in(std::string_view text, char open, char close) {
  return text.size() >= 2 && text.front() == open && text.back() == close;
}

std::vector<std::string> parts_of(std::string_view text) {
  const std::string_view inside = text.substr(1, text.size() - 2);
  std::vector<std::string> parts;
  for (std::size_t from = 0; !trimmed(inside).empty();) {
    const std::size_t end = find_outside(inside, ',', from);
    parts.push_back(trimmed(inside.substr(from, end - from)));
    if (end == std::string_view::npos) break;
    from = end + 1;
  }
  return parts;
}

using Members = std::vector<std::pair<std::string, std::string>>;
Members members_of(std::string_view text) {
  Members members;
  for (const std::string& part : parts_of(text)) {
    const std::size_t colon = find_outside(part, ':', 0);
    if (colon == std::string::npos)
      members.push_back({part, ""});
    else
      members.push_back({trimmed(part.substr(0, colon)), trimmed(part.substr(colon + 1))});
  }
  return members;
}

std::string value_in(const Members& members, const std::string& name) {
  const auto found = std::find_if(members.begin(), members.end(), [&](const auto& one) { return one.first == name; });
  return found == members.end() ? "" : found->second;
}

std::string shown(const std::string& value) {
  return value.empty() ? "left out" : value;
}

// "draw: without trail, with ellipse"; "" where both hold the same in another order.
std::string members_text(const std::vector<std::string>& before, const std::vector<std::string>& after) {
  std::vector<std::string> changes;
  const auto add = [&](const char* word, const std::vector<std::string>& these, const std::vector<std::string>& those) {
    for (const std::string& one : these)
      if (std::find(those.begin(), those.end(), one) == those.end()) changes.push_back(word + one);
  };
  add("without ", before, after);
  add("with ", after, before);
  return joined(changes);
}

bool is_word(const std::string& value) {
  return value.find_first_of(" ,:") == std::string::npos;
}

void add_changes(const std::string& key, const std::string& before, const std::string& after,
                 std::vector<std::string>& changes) {
  if (before == after) return;
  if (is_in(before, '[', ']') && is_in(after, '[', ']')) {
    const std::vector<std::string> old = parts_of(before), now = parts_of(after);
    if (old.size() == now.size()) {
      for (std::size_t i = 0; i < now.size(); ++i) add_changes(key + "." + std::to_string(i + 1), old[i], now[i], changes);
      return;
    }
    const std::string members = members_text(old, now);
    if (!members.empty() && !old.empty() && !now.empty()) {
      changes.push_back(key + ": " + members);
      return;
    }
  } else if (is_in(before, '{', '}') && is_in(after, '{', '}')) {
    const Members old = members_of(before), now = members_of(after);
    for (const auto& [name, value] : old) add_changes(key + "." + name, value, value_in(now, name), changes);
    for (const auto& [name, value] : now)
      if (value_in(old, name).empty()) add_changes(key + "." + name, "", value, changes);
    return;
  }
  const std::optional<double> old = parse_number(before), now = parse_number(after);
  if (old && now && *old != *now) {
    changes.push_back(key + " " + change_text(*old, *now, ""));
    return;
  }
  const bool are_words = is_word(before) && is_word(after) && !before.empty() && !after.empty();
  changes.push_back(key + (are_words ? " " : ": ") + change_text(shown(before), shown(after)));
}

}  // namespace

std::vector<std::string> key_changes(const std::string& key, const std::string& before, const std::string& after) {
  std::vector<std::string> changes;
  add_changes(key, before, after, changes);
  if (changes.empty() && before != after) changes.push_back(key + ": " + change_text(shown(before), shown(after)));
  return changes;
}

}  // namespace chainreel
