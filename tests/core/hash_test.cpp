// The vectors of NIST FIPS 180-2, appendix B, and its long message.
#include "core/hash.hpp"

#include <gtest/gtest.h>

#include <array>
#include <fstream>
#include <sstream>
#include <string_view>

#include "core/error.hpp"
#include "support/temporary_folder.hpp"

namespace chainreel {
namespace {

std::span<const std::byte> bytes_of(std::string_view text) {
  return std::as_bytes(std::span(text.data(), text.size()));
}

std::string hash_of(std::string_view text) {
  Sha256 hash;
  hash.add(bytes_of(text));
  return hash.finish();
}

TEST(Sha256, GivesThePublishedDigests) {
  EXPECT_EQ(hash_of(""), "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
  EXPECT_EQ(hash_of("abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  EXPECT_EQ(hash_of("abcdbcdecdefdefgefghfghighijhijkijkljklmklmnlmnomnopnopq"),
            "248d6a61d20638b8e5c026930c3e6039a33ce45964ff2167f6ecedd419db06c1");
  EXPECT_EQ(hash_of(std::string(1000000, 'a')),
            "cdc76e5c9914fb9281a1c7e284d73e67f1809a48a497200e046d39ccc7112cd0");
  EXPECT_NE(hash_of("abd"), hash_of("abc"));
}

TEST(Sha256, DoesNotDependOnThePieces) {
  Sha256 hash;
  for (const char* piece : {"a", "", "bc"}) hash.add(bytes_of(piece));
  EXPECT_EQ(hash.finish(), hash_of("abc"));
}

// Longer than what is read of it at once, and by one byte more or less than a whole number of such pieces.
TEST(Sha256, OfAFileIsThatOfAllItsBytes) {
  const TemporaryFolder folder;
  EXPECT_EQ(sha256_of_file(folder.write("million", std::string(1000000, 'a'))),
            "cdc76e5c9914fb9281a1c7e284d73e67f1809a48a497200e046d39ccc7112cd0");
  for (const std::size_t size : {0, 1, 65535, 65536, 65537, 131072, 131073}) {
    std::string text(size, 'x');
    if (size > 0) text.back() = 'y';
    EXPECT_EQ(sha256_of_file(folder.write("file", text)), hash_of(text)) << size;
  }
}

TEST(Sha256, OfAStreamTellsItsBytesAndOfOneThatIsNotOpenNothing) {
  std::istringstream text("abc");
  const HashedBytes hashed = hash_of_stream(text, "text");
  EXPECT_EQ(hashed.sha256, hash_of("abc"));
  EXPECT_EQ(hashed.bytes, 3u);
  std::ifstream none("/no/such/file");
  try {
    hash_of_stream(none, "/no/such/file");
    FAIL() << "a file that cannot be opened has no hash, not that of no bytes";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::bad_input);
    EXPECT_EQ(error.problems().front().place.file, "/no/such/file");
  }
}

TEST(Sha256, TakesDoublesAsLittleEndianBytes) {
  Sha256 hash;
  hash.add(std::array{1.0, -2.0});
  using namespace std::string_view_literals;
  EXPECT_EQ(hash.finish(), hash_of("\0\0\0\0\0\0\xf0\x3f\0\0\0\0\0\0\0\xc0"sv));
}

}  // namespace
}  // namespace chainreel
