// The vectors of RFC 4648, section 10, and texts longer than one piece.
#include <gtest/gtest.h>

#include <sstream>

#include "core/error.hpp"
#include "core/hash.hpp"
#include "support/temporary_folder.hpp"

namespace chainreel {
namespace {

std::string of_file(const std::string& bytes) {
  const TemporaryFolder folder;
  std::ostringstream stream;
  write_base64_of_file(stream, folder.write("bytes", bytes));
  return stream.str();
}

TEST(Base64, GivesThePublishedTexts) {
  const std::string texts[] = {"", "Zg==", "Zm8=", "Zm9v", "Zm9vYg==", "Zm9vYmE=", "Zm9vYmFy"};
  for (std::size_t n = 0; n < std::size(texts); ++n) {
    const std::string bytes = std::string("foobar").substr(0, n);
    EXPECT_EQ(base64(bytes), texts[n]);
    EXPECT_EQ(of_file(bytes), texts[n]);
  }
  EXPECT_EQ(base64(std::string("\0\xff\xfe", 3)), "AP/+");
}

// Pieces join without a seam: three bytes of value 0 are four letters A, wherever they stand.
TEST(Base64, LongTextsHaveNoSeams) {
  constexpr std::size_t kGroups = 100000;
  EXPECT_EQ(base64(std::string(3 * kGroups, '\0')), std::string(4 * kGroups, 'A'));
  EXPECT_EQ(of_file(std::string(3 * kGroups + 1, '\0')), std::string(4 * kGroups, 'A') + "AA==");
}

TEST(Base64, OfAFileThatIsNotThereIsAnError) {
  std::ostringstream stream;
  const TemporaryFolder folder;  // which can be opened but not read
  for (const std::string& path : {std::string("/no/such/file"), folder.path().string()}) {
    try {
      write_base64_of_file(stream, path);
      FAIL() << path;
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ExitCode::bad_input) << path;
    }
  }
}

}  // namespace
}  // namespace chainreel
