#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "core/error.hpp"
#include "core/output_file.hpp"
#include "support/temporary_folder.hpp"

namespace chainreel {
namespace {

namespace fs = std::filesystem;

void put(const std::string& folder, const std::string& name) {
  std::ofstream(fs::path(folder) / name) << "new";
}

TEST(OutputFolder, ShowsItsFilesWhenAllAreWholeAndTakesTheOldOnesAway) {
  const TemporaryFolder folder;
  for (const char* name :
       {"x/a_000000.png", "x/a_000009.png", "x/a_00001.png", "x/a_b00000.png", "x/note.txt"})
    folder.write(name, "old");
  const std::string x = folder.file("x");
  {
    OutputFolder output(x, "a_", ".png", true);
    put(output.temporary_folder(), "a_000000.png");
    EXPECT_EQ(read_whole_file(folder.file("x/a_000000.png")), "old");
    output.commit();
  }
  EXPECT_EQ(read_whole_file(folder.file("x/a_000000.png")), "new");
  EXPECT_FALSE(fs::exists(folder.file("x/a_000009.png")));
  for (const char* name : {"x/a_00001.png", "x/a_b00000.png", "x/note.txt"})
    EXPECT_EQ(read_whole_file(folder.file(name)), "old");
  EXPECT_EQ(std::distance(fs::directory_iterator(x), {}), 4);
}

TEST(OutputFolder, LeavesNothingWithoutACommitAndOverwritesNothingUnasked) {
  const TemporaryFolder folder;
  { const OutputFolder output(folder.file("new"), "a_", ".png", false); }
  EXPECT_TRUE(fs::is_empty(folder.file("new")));
  folder.write("x/a_000003.png", "old");
  EXPECT_THROW(OutputFolder(folder.file("x"), "a_", ".png", false), Error);
  EXPECT_NO_THROW(OutputFolder(folder.file("x"), "b_", ".png", false));
  EXPECT_THROW(OutputFolder("/proc/nothing", "a_", ".png", false), Error);
}

// A name that a folder took meanwhile stands in the way of the fifth of twelve.
TEST(OutputFolder, LeavesAllOldFilesWhereOneNewOneCannotCome) {
  const TemporaryFolder folder;
  const auto name = [](int i) { return "a_" + std::string(i < 10 ? "00000" : "0000") + std::to_string(i) + ".png"; };
  for (int i = 0; i < 12; ++i)
    if (i != 4) folder.write("x/" + name(i), "old");
  OutputFolder output(folder.file("x"), "a_", ".png", true);
  for (int i = 0; i < 12; ++i) put(output.temporary_folder(), name(i));
  folder.write("x/" + name(4) + "/file", "in the way");
  EXPECT_THROW(output.commit(), Error);
  for (int i = 0; i < 12; ++i)
    EXPECT_EQ(read_whole_file(folder.file("x/" + name(i) + (i == 4 ? "/file" : ""))), i == 4 ? "in the way" : "old");
}

}  // namespace
}  // namespace chainreel
