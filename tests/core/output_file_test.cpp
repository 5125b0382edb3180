#include "core/output_file.hpp"

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "core/error.hpp"
#include "support/temporary_folder.hpp"

namespace chainreel {
namespace {

namespace fs = std::filesystem;

void write(const fs::path& path, const std::string& text) {
  std::ofstream(path, std::ios::binary) << text;
}

class OutputFiles : public ::testing::Test {
 protected:
  std::size_t files() const { return std::size_t(std::distance(fs::directory_iterator(folder_.path()), {})); }
  std::string path(const std::string& name) const { return folder_.file(name); }

  TemporaryFolder folder_;
};

// The exit code that opening `path` ends in; good if it can be opened.
ExitCode code_of(const std::string& path, bool overwrite) {
  try {
    OutputFile file(path, overwrite);
  } catch (const Error& error) {
    EXPECT_FALSE(error.problems().front().place.file.empty());
    return error.code();
  }
  return ExitCode::good;
}

TEST_F(OutputFiles, BearTheirNameOnlyOnceCommitted) {
  OutputFile file(path("film.mp4"), false);
  write(file.temporary_path(), "frames");
  EXPECT_FALSE(fs::exists(path("film.mp4")));
  EXPECT_EQ(fs::path(file.temporary_path()).parent_path(), folder_.path());
  EXPECT_EQ(fs::path(file.temporary_path()).extension(), ".mp4");
  file.commit();
  EXPECT_EQ(read_whole_file(path("film.mp4")), "frames");
  EXPECT_EQ(files(), 1u);
}

TEST_F(OutputFiles, LeaveNothingBehindWhenTheyAreNotCommitted) {
  {
    OutputFile file(path("film.mp4"), false);
    write(file.temporary_path(), "half");
    EXPECT_EQ(files(), 1u);
  }
  EXPECT_EQ(files(), 0u);
}

TEST_F(OutputFiles, OfAFailedRunAreKeptAsPartial) {
  {
    OutputFile file(path("film.mp4"), false);
    write(file.temporary_path(), "half");
    file.keep_as_partial();
  }
  EXPECT_FALSE(fs::exists(path("film.mp4")));
  EXPECT_EQ(read_whole_file(path("film.partial.mp4")), "half");
}

TEST_F(OutputFiles, MakeTheFoldersThatAreMissing) {
  write_text_file(path("a/b/c.csv"), "t\n", false);
  EXPECT_EQ(read_whole_file(path("a/b/c.csv")), "t\n");
}

TEST_F(OutputFiles, ReplaceAFileOnlyWhenToldToOrBelowOut) {
  write(path("kept.csv"), "old");
  EXPECT_EQ(code_of(path("kept.csv"), false), ExitCode::file);
  EXPECT_EQ(read_whole_file(path("kept.csv")), "old");
  write_text_file(path("kept.csv"), "new", true);
  EXPECT_EQ(read_whole_file(path("kept.csv")), "new");

  fs::create_directories(path("out/deep"));
  write(path("out/deep/film.csv"), "old");
  write_text_file(path("out/deep/film.csv"), "new", false);
  EXPECT_EQ(read_whole_file(path("out/deep/film.csv")), "new");

  write(path("out.csv"), "old");  // a file called out is no folder called out
  EXPECT_EQ(code_of(path("out.csv"), false), ExitCode::file);
}

TEST_F(OutputFiles, AnExistingFileKeepsItsContentWhileTheNewOneIsWritten) {
  write(path("kept.csv"), "old");
  {
    OutputFile file(path("kept.csv"), true);
    write(file.temporary_path(), "half of the new");
  }
  EXPECT_EQ(read_whole_file(path("kept.csv")), "old");
}

TEST_F(OutputFiles, EndInExitCodeSixWhereNothingCanBeWritten) {
  write(path("file"), "");
  EXPECT_EQ(code_of(path("file/film.mp4"), false), ExitCode::file);    // its folder is a file
  EXPECT_EQ(code_of(path("file/a/film.mp4"), false), ExitCode::file);  // so is a folder above
  EXPECT_EQ(code_of(folder_.path().string(), true), ExitCode::file);   // itself a folder
  EXPECT_EQ(code_of("/proc/chainreel.mp4", false), ExitCode::file);    // not even for root
  EXPECT_EQ(code_of(path("film.mp4"), false), ExitCode::good);
}

TEST_F(OutputFiles, ThatTheDiskDoesNotTakeAreReportedAndRemoved) {
  {
    OutputFile file(path("film.csv"), false);
    fs::remove(file.temporary_path());
    fs::create_symlink("/dev/full", file.temporary_path());
    EXPECT_THROW(write_whole(file, std::string(100000, 'x')), Error);
  }
  EXPECT_EQ(files(), 0u);
}

TEST_F(OutputFiles, ReplaceNoDevicePipeOrSocket) {
  ASSERT_EQ(mkfifo(path("pipe.mp4").c_str(), 0600), 0);
  fs::create_symlink("/dev/full", path("device.csv"));
  fs::create_symlink("loop.csv", path("loop.csv"));
  for (const std::string& name : {path("pipe.mp4"), path("device.csv"), path("loop.csv"), std::string("/dev/null")}) {
    EXPECT_EQ(code_of(name, true), ExitCode::file) << name;
    std::error_code code;
    EXPECT_FALSE(fs::is_regular_file(name, code)) << name;
  }
  // One that comes while the output is written is kept, too.
  OutputFile file(path("late.csv"), true);
  ASSERT_EQ(mkfifo(path("late.csv").c_str(), 0600), 0);
  EXPECT_THROW(write_whole(file, "text"), Error);
  EXPECT_TRUE(fs::is_fifo(path("late.csv")));
}

TEST_F(OutputFiles, GoToWhereALinkLeads) {
  fs::create_directories(path("disk"));
  write(path("disk/film.csv"), "old");
  fs::create_symlink("disk/film.csv", path("film.csv"));
  write_text_file(path("film.csv"), "new", true);
  EXPECT_TRUE(fs::is_symlink(path("film.csv")));
  EXPECT_EQ(read_whole_file(path("disk/film.csv")), "new");
  // Where nothing is yet, too.
  fs::remove(path("disk/film.csv"));
  write_text_file(path("film.csv"), "first", false);
  EXPECT_TRUE(fs::is_symlink(path("film.csv")));
  EXPECT_EQ(read_whole_file(path("disk/film.csv")), "first");
}

TEST_F(OutputFiles, KeepWhatCameToTheirNameMeanwhile) {
  OutputFile file(path("film.csv"), false);
  write(path("film.csv"), "another run's");
  EXPECT_THROW(write_whole(file, "text"), Error);
  EXPECT_EQ(read_whole_file(path("film.csv")), "another run's");
}

TEST_F(OutputFiles, AreNotWrittenThroughWhatTookTheirTemporaryPlace) {
  write(path("victim"), "precious");
  OutputFile file(path("film.csv"), false);
  fs::remove(file.temporary_path());
  fs::create_symlink("victim", file.temporary_path());
  EXPECT_THROW(file.commit(), Error);
  EXPECT_FALSE(fs::exists(path("film.csv")));
}

// A child that dies without tidying up holds no lock any more; this process does.
TEST_F(OutputFiles, OfKilledRunsAreTidiedUpByTheNextAndThoseOfLivingOnesStay) {
  const TemporaryFile mine(TemporaryFile::Kind::coming_file, folder_.path().string(), ".csv", path("a.csv"));
  write(path(".chainreel-notes.txt"), "the user's");
  const pid_t child = fork();
  if (child == 0) {
    const OutputFile dead(path("b.csv"), false);
    new TemporaryFile(TemporaryFile::Kind::coming_folder, folder_.path().string(), "", "c");
    const TemporaryFile former(TemporaryFile::Kind::former_folder, folder_.path().string(), "", "d");
    write(former.path() + "/d_000000.png", "old");
    raise(SIGKILL);
  }
  int status = 0;
  ASSERT_EQ(waitpid(child, &status, 0), child);
  EXPECT_EQ(files(), 5u);
  remove_leftovers(folder_.path().string());
  EXPECT_TRUE(fs::exists(mine.path()));
  EXPECT_EQ(read_whole_file(path("d_000000.png")), "old");
  EXPECT_EQ(files(), 3u);  // mine, the user's, and what came back
}

TEST_F(OutputFiles, AreToldByTheirFinalNames) {
  const OutputFile file(path("film.mp4"), false);
  EXPECT_EQ(with_final_names(file.temporary_path() + ": full"), path("film.mp4") + ": full");
}

}  // namespace
}  // namespace chainreel
