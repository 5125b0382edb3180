// The words by which scene files and the command line call the values of an enumeration: one table each. An
// enumeration has such words where `std::span<const Name> names_of(Enum)` is declared beside it; row i of the table is
// that of value i.
#pragma once

#include <concepts>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace chainreel {

struct Name {
  const char* name;
  const char* meaning;  // half a sentence for people
};

template <class Enum>
concept Named = std::is_enum_v<Enum> && requires(Enum value) {
  { names_of(value) } -> std::same_as<std::span<const Name>>;
};

// The index of a name in its table.
std::optional<std::size_t> index_of_name(std::span<const Name> names, std::string_view name);
std::vector<std::string> words_of(std::span<const Name> names);
std::string alternatives(std::span<const Name> names);  // "mass, energy or belt"
// "must be light or dark, not 'drak': did you mean 'dark'?"
std::string misnamed(std::span<const Name> names, std::string_view name);
// Throws Error (bad input): the text above behind `what`.
[[noreturn]] void refuse_name(std::string_view what, std::span<const Name> names, std::string_view name);

template <Named Enum>
std::string to_string(Enum value) {
  return names_of(value)[std::size_t(value)].name;
}

template <Named Enum>
std::optional<Enum> value_named(std::string_view name) {
  const std::optional<std::size_t> index = index_of_name(names_of(Enum{}), name);
  return index ? std::optional(Enum(*index)) : std::nullopt;
}

// Throws Error (bad input): "'outside' must be hold, zero or refuse, not 'keep'".
template <Named Enum>
Enum require_named(std::string_view what, std::string_view name) {
  if (const std::optional<Enum> value = value_named<Enum>(name)) return *value;
  refuse_name(what, names_of(Enum{}), name);
}

}  // namespace chainreel
