#include "core/own_environment.hpp"

#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <mutex>

namespace chainreel {
namespace {

std::mutex overruled_lock;

std::vector<std::string>& overruled() {
  static std::vector<std::string> settings;
  return settings;
}

bool begins_with_one_of(std::string_view name, std::span<const std::string_view> beginnings) {
  return std::any_of(beginnings.begin(), beginnings.end(), [&](std::string_view one) { return name.starts_with(one); });
}

}  // namespace

void set_own_variable(const char* name, const char* value) {
  const char* const before = std::getenv(name);
  if (before != nullptr && (value == nullptr || std::string_view(before) != value)) {
    const std::lock_guard guard(overruled_lock);
    overruled().push_back(std::string(name) + "=" + before);
  }
  if (value != nullptr)
    setenv(name, value, /*overwrite=*/1);
  else
    unsetenv(name);
}

void clear_variables(std::span<const std::string_view> beginnings, std::span<const std::string_view> kept) {
  std::vector<std::string> names;  // first, as taking one away moves the others
  for (char** entry = environ; entry != nullptr && *entry != nullptr; ++entry) {
    const std::string_view text(*entry);
    const std::string_view name = text.substr(0, text.find('='));
    if (begins_with_one_of(name, beginnings) && !begins_with_one_of(name, kept)) names.emplace_back(name);
  }
  for (const std::string& name : names) set_own_variable(name.c_str(), nullptr);
}

std::vector<std::string> overruled_variables() {
  const std::lock_guard guard(overruled_lock);
  return overruled();
}

}  // namespace chainreel
