#include "core/base64.hpp"

#include <openssl/evp.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <ostream>

#include "core/error.hpp"

namespace chainreel {
namespace {

constexpr std::size_t kPiece = 3 * 16384;             // of three bytes each group of four letters is made
constexpr std::size_t kLetters = kPiece / 3 * 4 + 1;  // with the zero that OpenSSL sets behind them

// Takes at most kPiece bytes; fewer only at the end.
std::string_view encode(std::string_view bytes, std::array<unsigned char, kLetters>& letters) {
  const int count = EVP_EncodeBlock(letters.data(), reinterpret_cast<const unsigned char*>(bytes.data()),
                                    int(bytes.size()));
  return {reinterpret_cast<const char*>(letters.data()), std::size_t(count)};
}

}  // namespace

std::string base64(std::string_view bytes) {
  std::array<unsigned char, kLetters> letters;
  std::string text;
  for (; !bytes.empty(); bytes.remove_prefix(std::min(bytes.size(), kPiece)))
    text += encode(bytes.substr(0, kPiece), letters);
  return text;
}

void write_base64_of_file(std::ostream& stream, const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  std::array<char, kPiece> bytes;
  std::array<unsigned char, kLetters> letters;
  if (!file) throw Error(ExitCode::bad_input, "cannot be read", {path});
  while (file.read(bytes.data(), bytes.size()), file.gcount() > 0)
    stream << encode({bytes.data(), std::size_t(file.gcount())}, letters);
  if (file.bad()) throw Error(ExitCode::bad_input, "cannot be read to its end", {path});
}

}  // namespace chainreel
