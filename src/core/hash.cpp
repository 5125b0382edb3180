#include "core/hash.hpp"

#include <openssl/evp.h>

#include <algorithm>
#include <array>
#include <bit>
#include <fstream>
#include <ostream>

#include "core/error.hpp"
#include "core/input_file.hpp"

namespace chainreel {

struct Sha256::State {
  std::unique_ptr<EVP_MD_CTX, decltype(&EVP_MD_CTX_free)> context{EVP_MD_CTX_new(), &EVP_MD_CTX_free};
};

namespace {

void require(int openssl_result) {
  if (openssl_result != 1) throw Error(ExitCode::limit, "SHA-256 is not available in this OpenSSL build");
}

}  // namespace

Sha256::Sha256() : state_(std::make_unique<State>()) {
  require(EVP_DigestInit_ex(state_->context.get(), EVP_sha256(), nullptr));
}

Sha256::~Sha256() = default;

void Sha256::add(std::span<const std::byte> bytes) {
  require(EVP_DigestUpdate(state_->context.get(), bytes.data(), bytes.size()));
}

void Sha256::add(std::span<const double> values) {
  static_assert(std::endian::native == std::endian::little);
  add(std::as_bytes(values));
}

std::string Sha256::finish() {
  std::array<unsigned char, EVP_MAX_MD_SIZE> digest;
  unsigned int size = 0;
  require(EVP_DigestFinal_ex(state_->context.get(), digest.data(), &size));
  constexpr char kHex[] = "0123456789abcdef";
  std::string text;
  for (unsigned int i = 0; i < size; ++i) {
    text += kHex[digest[i] >> 4];
    text += kHex[digest[i] & 15];
  }
  return text;
}

std::string sha256_of(std::string_view text) {
  Sha256 hash;
  hash.add(std::as_bytes(std::span(text.data(), text.size())));
  return hash.finish();
}

HashedBytes hash_of_stream(std::istream& stream, const std::string& path) {
  if (!stream) throw Error(ExitCode::bad_input, "cannot be read", {path});
  Sha256 hash;
  HashedBytes hashed;
  std::array<char, 65536> buffer;
  while (stream.read(buffer.data(), buffer.size()), stream.gcount() > 0) {
    hash.add(std::as_bytes(std::span(buffer.data(), std::size_t(stream.gcount()))));
    hashed.bytes += std::uintmax_t(stream.gcount());
  }
  if (stream.bad()) throw Error(ExitCode::bad_input, "cannot be read to its end", {path});
  hashed.sha256 = hash.finish();
  return hashed;
}

std::string sha256_of_file(const std::string& path) {
  require_plain_file(path);
  std::ifstream stream(path, std::ios::binary);
  return hash_of_stream(stream, path).sha256;
}

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
