// Text of others (names, titles, cells of tables) made fit for a terminal, which takes some bytes as orders.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace chainreel {

// Control characters but newline and tabulator, marks that turn the direction of writing, and bytes that are no UTF-8
// as \u001b, in the way of JSON, which stays JSON; all else as it is.
std::string printable(std::string_view text);

// The same of a text that comes in pieces: a character may be cut between two of them.
class PrintableStream {
 public:
  std::string next(std::string_view piece);
  std::string end();  // what was left waiting for its other half

 private:
  std::string waiting_;
};

// At most about `most` bytes, whole characters; what was cut off is said: "abc.. (60000 bytes more)".
std::string shortened(std::string_view text, std::size_t most);

}  // namespace chainreel
