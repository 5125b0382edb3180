#include "encode/png.hpp"

#include <gmock/gmock.h>

#include <filesystem>
#include <string>
#include <string_view>

#include "core/error.hpp"
#include "encode/test_pictures.hpp"
#include "support/picture_compare.hpp"
#include "support/temporary_folder.hpp"

namespace chainreel {
namespace {

using testing::HasSubstr;
using testing::Not;

// The code of the Error that `action` throws; `good` where it throws none.
template <class Action>
ExitCode code_of(Action action) {
  try {
    action();
  } catch (const Error& error) {
    return error.code();
  }
  return ExitCode::good;
}

// Byte 25 of a PNG, behind signature, IHDR's head, width, height and depth, is the colour type.
int colour_type(const std::string& path) {
  return read_whole_file(path).at(25);
}

// Two pixels of 16 bits a channel, 257 times the 8-bit ones.
TEST(Png, SixteenBitsAreTheSamePictureAsEight) {
  constexpr std::string_view kHex =
      "89504e470d0a1a0a0000000d49484452000000020000000110020000002bd0349e000000154944415408d763686870705050f8ff9f81819111001d"
      "2503c14945a7cb0000000049454e44ae426082";
  std::string bytes;
  for (std::size_t i = 0; i < kHex.size(); i += 2) bytes.push_back(char(std::stoi(std::string(kHex.substr(i, 2)), nullptr, 16)));
  const TemporaryFolder folder;
  const Image image = read_png(folder.write("deep.png", bytes));
  ASSERT_EQ(image.width, 2);
  EXPECT_EQ(image.at(0, 0), (Pixel{128, 64, 32, 255}));
  EXPECT_EQ(image.at(1, 0), (Pixel{255, 0, 1, 255}));
}

TEST(Png, PixelsAndAlphaComeBackAsTheyWere) {
  const TemporaryFolder folder;
  const Image image = random_picture(37, 23, 1);
  write_png(folder.file("random.png"), image);
  EXPECT_EQ(read_png(folder.file("random.png")).bgra, image.bgra);
  EXPECT_EQ(colour_type(folder.file("random.png")), 6);  // RGBA
}

TEST(Png, OpaquePicturesCarryNoAlphaChannel) {
  const TemporaryFolder folder;
  const Image image = disc_picture(64, 48, 3);
  write_png(folder.file("disc.png"), image);
  EXPECT_EQ(colour_type(folder.file("disc.png")), 2);  // RGB
  EXPECT_EQ(read_png(folder.file("disc.png")).bgra, image.bgra);
}

TEST(Png, OneClearPixelKeepsTheAlphaChannel) {
  const TemporaryFolder folder;
  Image image = disc_picture(64, 48, 3);
  set_pixel(image, 63, 47, {1, 2, 3, 254});
  write_png(folder.file("disc.png"), image);
  EXPECT_EQ(colour_type(folder.file("disc.png")), 6);
  EXPECT_EQ(read_png(folder.file("disc.png")).at(63, 47), (Pixel{1, 2, 3, 254}));
}

TEST(Png, TextsComeBackAlsoOutsideAscii) {
  const TemporaryFolder folder;
  const std::map<std::string, std::string> text = {{"scene", "rr_free.yaml"},
                                                   {"title", "τ = (1, 0) N·m, Grüße"}};
  write_png(folder.file("text.png"), flat_picture(4, 4, {}), text);
  std::map<std::string, std::string> all = text;
  all[kPixels] = pixels_checksum(flat_picture(4, 4, {}));
  EXPECT_EQ(read_png_text(folder.file("text.png")), all);
  EXPECT_NE(pixels_checksum(flat_picture(4, 4, {})), pixels_checksum(flat_picture(2, 8, {}))) << "of its size, too";
  const std::string bytes = read_whole_file(folder.file("text.png"));
  EXPECT_THAT(bytes, HasSubstr("tEXtscene"));
  EXPECT_THAT(bytes, HasSubstr("iTXttitle"));
}

TEST(Png, TheSamePictureIsTheSameFileWithoutATime) {
  const TemporaryFolder folder;
  for (const char* name : {"a.png", "b.png"})
    write_png(folder.file(name), disc_picture(64, 48, 1), {{"scene", "x"}});
  EXPECT_EQ(read_whole_file(folder.file("a.png")), read_whole_file(folder.file("b.png")));
  EXPECT_THAT(read_whole_file(folder.file("a.png")), Not(HasSubstr("tIME")));
}

TEST(Png, AFullDiskAndAMissingFolderAreFileErrors) {
  const Image image = random_picture(256, 256, 2);
  EXPECT_EQ(code_of([&] { write_png("/dev/full", image); }), ExitCode::file);
  // Small enough to stay in the buffer until the file is closed.
  EXPECT_EQ(code_of([&] { write_png("/dev/full", flat_picture(2, 2, {})); }), ExitCode::file);
  EXPECT_EQ(code_of([&] { write_png("/nonexistent/folder/a.png", image); }), ExitCode::file);
  EXPECT_EQ(code_of([&] { write_png("/dev/null", image); }), ExitCode::good);
}

TEST(Png, KeywordsThatThePngSpecificationForbidsAreRefused) {
  const TemporaryFolder folder;
  for (const std::string& keyword : {std::string(), std::string(80, 'k'), std::string("Maß")})
    EXPECT_EQ(code_of([&] {
                write_png(folder.file("a.png"), flat_picture(2, 2, {}), {{keyword, "v"}});
              }),
              ExitCode::usage);
}

// Negative controls of the reader: what is broken must not come back as a picture.
TEST(Png, BrokenFilesAreBadInput) {
  const TemporaryFolder folder;
  const std::string path = folder.file("good.png");
  write_png(path, random_picture(32, 32, 5));
  const std::string good = read_whole_file(path);
  std::string flipped = good;
  flipped[good.size() / 2] = static_cast<char>(flipped[good.size() / 2] ^ 0x55);
  const std::vector<std::string> broken = {
      folder.write("short.png", good.substr(0, good.size() / 2)),
      folder.write("flipped.png", flipped),
      folder.write("text.png", "this is not a picture"),
      folder.write("empty.png", ""),
      folder.file("missing.png"),
  };
  for (const std::string& file : broken)
    EXPECT_EQ(code_of([&] { read_png(file); }), ExitCode::bad_input) << file;
  EXPECT_EQ(code_of([&] { read_png_text(broken[2]); }), ExitCode::bad_input);
  EXPECT_EQ(code_of([&] { read_png(path); }), ExitCode::good);
}

}  // namespace
}  // namespace chainreel
