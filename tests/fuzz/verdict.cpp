#include "fuzz/verdict.hpp"

#include <algorithm>

namespace chainreel {
namespace {

constexpr std::ptrdiff_t kMostLines = 60;
constexpr std::size_t kMostBytes = 60000;

bool has_orders(const std::string& text) {
  return std::any_of(text.begin(), text.end(), [](char c) {
    const auto byte = static_cast<unsigned char>(c);
    return (byte < 0x20 && c != '\n' && c != '\t') || byte == 0x7F;
  });
}

}  // namespace

std::string fault_of(const ProgramResult& result, const std::vector<std::string>& new_files) {
  if (result.timed_out) return "does not end";
  if (result.status > 7) return "ends with " + std::to_string(result.status) + (result.status > 128 ? ", a signal" : "");
  if (result.err.find("chainreel: ") == 0 && result.status == 6) return "an exception that nobody expected";
  if (result.status != 0 && result.err.empty()) return "fails without a word";
  if (std::count(result.err.begin(), result.err.end(), '\n') > kMostLines || result.err.size() > kMostBytes)
    return "says more than anybody reads";
  if (has_orders(result.err)) return "orders for a terminal on standard error";
  if (has_orders(result.out)) return "orders for a terminal on standard output";
  for (const std::string& file : new_files) {
    if (file.find("/.") != std::string::npos || file.starts_with('.')) return "leaves the temporary file " + file;
    if (result.status != 0 && file.find(".partial") == std::string::npos) return "fails and leaves " + file;
  }
  return "";
}

}  // namespace chainreel
