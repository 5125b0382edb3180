#include "core/loaded_libraries.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <fstream>
#include <sstream>
#include <string>

#include "core/hash.hpp"

namespace chainreel {
namespace {

constexpr std::array<std::string_view, 1> kHashes = {"libcrypto"};

// kB of a library's pages that only it may read and run, and that lie in memory for this process.
long resident_code(const std::string& library) {
  std::ifstream maps("/proc/self/smaps");
  long sum = 0;
  bool is_code = false;
  for (std::string line; std::getline(maps, line);) {
    std::istringstream words(line);
    std::string first, second;
    words >> first >> second;
    if (!first.ends_with(':')) is_code = second == "r-xp" && line.find(library) != std::string::npos;
    if (is_code && first == "Rss:") sum += std::stol(second);
  }
  return sum;
}

TEST(LoadedLibraries, HaveBuildIdsOrHashes) {
  sha256_of("");  // so that it is there
  EXPECT_THAT(loaded_libraries(kHashes), testing::ElementsAre(testing::MatchesRegex("libcrypto\\.so\\.[0-9.]+ [0-9a-f]{40,64}")));
  EXPECT_TRUE(loaded_libraries(std::array<std::string_view, 1>{"libnone"}).empty());
}

TEST(LoadedLibraries, RunAsBeforeWhenTheirCodeWasGivenBack) {
  const std::string before = sha256_of("a");
  const long resident = resident_code("libcrypto");
  ASSERT_GT(resident, 100) << "kB: or there is nothing to give back";
  give_code_back(kHashes);
  EXPECT_LT(resident_code("libcrypto"), resident / 4);
  EXPECT_EQ(sha256_of("a"), before);
}

}  // namespace
}  // namespace chainreel
