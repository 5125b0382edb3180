// SHA-256, fed piece by piece.
#pragma once

#include <cstddef>
#include <cstdint>
#include <iosfwd>
#include <memory>
#include <span>
#include <string>
#include <string_view>

namespace chainreel {

class Sha256 {
 public:
  Sha256();
  ~Sha256();
  Sha256(const Sha256&) = delete;
  Sha256& operator=(const Sha256&) = delete;

  void add(std::span<const std::byte> bytes);
  void add(std::span<const double> values);  // as little-endian IEEE 754 doubles
  std::string finish();                      // 64 hexadecimal digits; nothing may be added afterwards

 private:
  struct State;
  std::unique_ptr<State> state_;
};

std::string sha256_of(std::string_view text);

// Of all bytes that are left in a stream. Throws Error (exit 3) naming `path` where it cannot be read to its end, as one
// that was not opened.
struct HashedBytes {
  std::string sha256;
  std::uintmax_t bytes = 0;
};
HashedBytes hash_of_stream(std::istream& stream, const std::string& path);

// The hash of a plain file's bytes. Throws Error (exit 3) where it cannot be read, (exit 7) where it is
// larger than any input.
std::string sha256_of_file(const std::string& path);

// Bytes as text that any page may hold: base64 (RFC 4648, section 4), without line breaks.

std::string base64(std::string_view bytes);

// A file's bytes, piece by piece. Throws Error (exit 3) where it cannot be read.
void write_base64_of_file(std::ostream& stream, const std::string& path);

}  // namespace chainreel
