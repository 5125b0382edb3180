#include <gmock/gmock.h>

#include "encode/library_versions.hpp"

namespace chainreel {
namespace {

TEST(Libraries, NameTheirVersionsOnce) {
  const std::vector<LibraryVersion> versions = encode_library_versions();
  std::vector<std::string> names;
  for (const LibraryVersion& library : versions) {
    names.push_back(library.name);
    EXPECT_THAT(library.version, testing::ContainsRegex("^[0-9]+\\.[0-9]+")) << library.name;
  }
  EXPECT_THAT(names,
              testing::UnorderedElementsAre("FFmpeg", "libavcodec", "libavformat", "libavutil", "libpng"));
}

// A hundred libraries come with FFmpeg's: they took a third of the time of a picture that needs none of them.
TEST(Libraries, OfFilmsAreNotOpenedForPictures) {
  const std::vector<LibraryVersion> versions = encode_library_versions(Writes::pictures);
  ASSERT_EQ(versions.size(), 1u);
  EXPECT_EQ(versions[0].name, "libpng");
}

TEST(Libraries, DebiansFfmpegHasEveryEncoderTheProgramCaresFor) {
  EXPECT_THAT(available_encoders(),
              testing::ElementsAre("libx264", "libvpx-vp9", "prores_ks", "gif", "apng", "png"));
}

}  // namespace
}  // namespace chainreel
