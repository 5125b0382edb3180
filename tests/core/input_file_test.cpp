#include "core/input_file.hpp"

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <functional>

#include "core/error.hpp"
#include "core/hash.hpp"
#include "core/json.hpp"
#include "core/output_file.hpp"
#include "support/temporary_folder.hpp"

namespace chainreel {
namespace {

namespace fs = std::filesystem;

ExitCode code_of(const std::function<void()>& work) {
  try {
    work();
  } catch (const Error& error) {
    return error.code();
  }
  return ExitCode::good;
}

TEST(InputFile, IsAPlainFileOfBearableSize) {
  const TemporaryFolder folder;
  EXPECT_EQ(read_plain_file(folder.write("a", "text")), "text");
  ASSERT_EQ(mkfifo(folder.file("pipe").c_str(), 0600), 0);
  fs::create_symlink("loop", folder.file("loop"));
  const std::string large = folder.write("large", "");
  fs::resize_file(large, std::uintmax_t(200) << 30);  // no block of it is written
  for (const std::string& path : {folder.file("pipe"), folder.file("loop"), folder.file("none"), folder.path().string(),
                                  std::string("/dev/zero"), folder.file(std::string(300, 'n'))}) {
    EXPECT_EQ(code_of([&] { read_plain_file(path); }), ExitCode::bad_input) << path;
    EXPECT_EQ(code_of([&] { sha256_of_file(path); }), ExitCode::bad_input) << path;
  }
  EXPECT_EQ(code_of([&] { sha256_of_file(large); }), ExitCode::limit);
}

// By its own name, through links of both kinds, with everything that would otherwise allow it.
TEST(InputFile, IsNeverReplacedByAnOutput) {
  const TemporaryFolder folder;
  const std::string scene = folder.write("out/scene.yaml", "precious");
  note_input(scene);
  fs::create_symlink("scene.yaml", folder.file("out/soft"));
  fs::create_hard_link(scene, folder.file("out/hard"));
  for (const char* name : {"out/scene.yaml", "out/soft", "out/hard", "out/../out/scene.yaml"}) {
    EXPECT_EQ(code_of([&] { write_text_file(folder.file(name), "new", true); }), ExitCode::file) << name;
    EXPECT_EQ(read_whole_file(scene), "precious");
  }
  // Nor by one that was begun before it was read.
  const std::string table = folder.write("out/table.csv", "precious");
  OutputFile output(table, true);
  note_input(table);
  EXPECT_EQ(code_of([&] { write_whole(output, "new"); }), ExitCode::file);
  EXPECT_EQ(read_whole_file(table), "precious");
}

TEST(Json, OfOthersMayNotBeNestedDeeply) {
  EXPECT_TRUE(parse_json(std::string(100, '[') + std::string(100, ']')).is_array());
  EXPECT_TRUE(parse_json("[\"" + std::string(100000, '[') + "\\\"[\"]").is_array());
  for (const char* open : {"[", "{\"a\":"}) {
    std::string text;
    for (int i = 0; i < 100000; ++i) text += open;
    EXPECT_TRUE(parse_json(text).is_discarded());
  }
}

}  // namespace
}  // namespace chainreel
