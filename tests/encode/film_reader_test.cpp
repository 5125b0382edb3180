#include "encode/film_reader.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "core/error.hpp"
#include "encode/test_pictures.hpp"
#include "support/film_of_frames.hpp"
#include "support/temporary_folder.hpp"

namespace chainreel {
namespace {

constexpr int kSearchedWidth = 64, kSearchedHeight = 36, kSearchedFrames = 130;
constexpr FrameRate kSearchedFps{25, 1};  // a key frame every fifty

std::string write_searched_film(const TemporaryFolder& folder, const std::string& name, VideoCodec codec) {
  FilmOfFrames writer(folder.file(name), {.width = kSearchedWidth, .height = kSearchedHeight, .fps = kSearchedFps, .codec = codec});
  for (int k = 0; k < kSearchedFrames; ++k) writer.write(disc_picture(kSearchedWidth, kSearchedHeight, k));
  writer.finish();
  return folder.file(name);
}

// All frames, read one after the other.
std::vector<Image> frames_of(const std::string& path) {
  std::vector<Image> frames;
  FilmReader reader(path);
  for (Image image; reader.next(image);) frames.push_back(image);
  return frames;
}

Image found_at(const std::string& path, double seconds) {
  Image found;
  FilmReader reader(path);
  EXPECT_TRUE(reader.find(seconds, found));
  return found;
}

TEST(FilmReader, FindsWhatReadingOnShows) {
  const TemporaryFolder folder;
  for (const auto& [name, codec] :
       {std::pair{"a.mp4", VideoCodec::h264}, {"b.webm", VideoCodec::vp9}, {"c.mov", VideoCodec::prores}}) {
    const std::string path = write_searched_film(folder, name, codec);
    const std::vector<Image> frames = frames_of(path);
    ASSERT_EQ(frames.size(), std::size_t(kSearchedFrames));
    for (std::size_t k = 1; k < frames.size(); ++k)
      ASSERT_NE(frames[k - 1].bgra, frames[k].bgra) << "or a neighbour would do";
    // In front of, at and behind key frames, before the search begins to pay, and behind the end.
    for (const int k : {0, 1, 24, 26, 49, 50, 51, 52, 61, 62, 63, 99, 100, 113, 128, 129})
      EXPECT_EQ(found_at(path, k / 25.0).bgra, frames[std::size_t(k)].bgra) << name << ", frame " << k;
    EXPECT_EQ(found_at(path, 60.9 / 25).bgra, frames[60].bgra) << name;
    EXPECT_EQ(found_at(path, 1e6).bgra, frames.back().bgra) << name;
  }
}

// Decoded alone is what it is coded from: damage in the first two seconds is not met on the way to the third.
TEST(FilmReader, DecodesNothingItDoesNotNeed) {
  const TemporaryFolder folder;
  const std::string path = write_searched_film(folder, "a.mov", VideoCodec::prores);
  const std::vector<Image> frames = frames_of(path);
  std::string bytes = read_whole_file(path);
  const std::size_t second = bytes.find("icpf", bytes.find("icpf") + 1);
  ASSERT_NE(second, std::string::npos);
  bytes.replace(second, 4, "none");
  const std::string damaged = folder.write("damaged.mov", bytes);
  EXPECT_THROW(frames_of(damaged), Error);
  EXPECT_EQ(found_at(damaged, 4).bgra, frames[100].bgra);
}

}  // namespace
}  // namespace chainreel
