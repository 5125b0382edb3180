#include "encode/film_chunk.hpp"

#include <gmock/gmock.h>
#include <sched.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <string>

#include "core/error.hpp"
#include "encode/test_pictures.hpp"
#include "support/film_of_frames.hpp"
#include "support/picture_compare.hpp"
#include "support/temporary_folder.hpp"
#include "support/video_probe.hpp"

namespace chainreel {
namespace {

using testing::HasSubstr;
namespace fs = std::filesystem;

constexpr int kFilmWidth = 192, kFilmHeight = 108;

void write_discs(const std::string& path, int frames, FrameRate fps = {60, 1}) {
  FilmOfFrames writer(path, {.width = kFilmWidth, .height = kFilmHeight, .fps = fps});
  for (int k = 0; k < frames; ++k) writer.write(disc_picture(kFilmWidth, kFilmHeight, k));
  writer.finish();
}

template <class Action>
Error error_of(Action action) {
  try {
    action();
  } catch (const Error& error) {
    return error;
  }
  return Error(ExitCode::good, "nothing was thrown");
}

// Everything that the decoded film must be, told as one text of what does not hold; empty for a good film.
std::string film_faults(const std::string& path, int frames, FrameRate fps) {
  VideoFacts film;
  try {
    film = probe_video(path);
  } catch (const Error& error) {
    return error.what();
  }
  std::string faults;
  const auto require = [&](bool holds, const char* what) {
    if (!holds) faults += std::string(what) + "; ";
  };
  require(film.codec == "h264" && film.profile == "High" && film.pixel_format == "yuv420p", "codec");
  require(film.width == kFilmWidth && film.height == kFilmHeight && film.pixel_aspect == Ratio{1, 1}, "size");
  require(film.fps == Ratio{fps.num, fps.den}, "fps");
  require(film.frames == frames && film.declared_frames == frames, "frames");
  require(film.duration == Ratio{std::int64_t(frames) * fps.den, fps.num}, "duration");
  require(
      film.primaries == "bt709" && film.transfer == "bt709" && film.matrix == "bt709" && film.range == "tv",
      "colour");
  require(film.index_first, "index");
  require(film.regular, "times");
  return faults;
}

class FilmAtRate : public ::testing::TestWithParam<FrameRate> {};

TEST_P(FilmAtRate, DecodesToWhatWasAskedFor) {
  const TemporaryFolder folder;
  const FrameRate fps = GetParam();
  for (const int frames : {1, 2, 3, 47}) {
    const std::string path = folder.file(std::to_string(frames) + ".mp4");
    write_discs(path, frames, fps);
    EXPECT_EQ(film_faults(path, frames, fps), "") << frames;
    // The file's own duration is told in microseconds: half of one, rounded.
    const VideoFacts film = probe_video(path);
    EXPECT_NEAR(double(film.movie_duration.num) / double(film.movie_duration.den),
                double(frames) * fps.den / fps.num, 1e-6);
  }
}

INSTANTIATE_TEST_SUITE_P(Rates, FilmAtRate,
                         ::testing::Values(FrameRate{60, 1}, FrameRate{25, 1}, FrameRate{30000, 1001},
                                         FrameRate{1, 1}, FrameRate{24000, 1001}, FrameRate{240, 1}));

TEST(Films, EveryTwoSecondsThereIsAKeyFrameAndNoneBetween) {
  const TemporaryFolder folder;
  const std::string path = folder.file("keys.mp4");
  FilmOfFrames writer(path, {.width = kFilmWidth, .height = kFilmHeight, .fps = {25, 1}});
  // A cut in the middle of a group must not start a new one.
  for (int k = 0; k < 170; ++k)
    writer.write(k < 70 ? disc_picture(kFilmWidth, kFilmHeight, k)
                        : random_picture(kFilmWidth, kFilmHeight, unsigned(k / 90)));
  writer.finish();
  EXPECT_THAT(probe_video(path).key_frames, testing::ElementsAre(0, 50, 100, 150));
}

TEST(Films, FlatColoursComeBackWithinThreeCodes) {
  const TemporaryFolder folder;
  // Link fills, ellipse, vectors, ink, page and the corners of the cube.
  for (const unsigned rgb : {0x5159FDu, 0x56B4E9u, 0xE69F00u, 0x009E73u, 0xCC79A7u, 0x873C56u, 0x193C09u,
                             0x1A1A1Au, 0xFFFFFFu, 0x000000u, 0xFF0000u, 0x00FF00u, 0x0000FFu}) {
    const std::string path = folder.file("flat.mp4");
    const Image image = flat_picture(64, 64, pixel_of(rgb));
    FilmOfFrames writer(path, {.width = 64, .height = 64});
    for (int k = 0; k < 5; ++k) writer.write(image);
    writer.finish();
    // A code of Cb is 1.8556 * 255/224 = 2.1 of blue; with Y rounded too and the quantiser at CRF 18, 3
    // codes.
    EXPECT_TRUE(pictures_agree(probe_video(path).middle, image, {.max = 3, .mean = 2}, "flat_colour"))
        << std::hex << rgb;
  }
}

TEST(Films, FramesStandWhereTheyWereWritten) {
  const TemporaryFolder folder;
  write_discs(folder.file("discs.mp4"), 41);
  const VideoFacts film = probe_video(folder.file("discs.mp4"));
  // Flat areas are exact to 3 codes (above); along the disc's edge 2x2 pixels share their colour and the
  // quantiser rings: up to 122 in one pixel and 0.24 on average. One frame off is four times that, as the last
  // line shows.
  const PictureTolerance tolerance{.max = 140, .mean = 0.5};
  EXPECT_TRUE(pictures_agree(film.first, disc_picture(kFilmWidth, kFilmHeight, 0), tolerance, "disc_first"));
  EXPECT_TRUE(pictures_agree(film.middle, disc_picture(kFilmWidth, kFilmHeight, 20), tolerance, "disc_middle"));
  EXPECT_TRUE(pictures_agree(film.last, disc_picture(kFilmWidth, kFilmHeight, 40), tolerance, "disc_last"));
  EXPECT_FALSE(pictures_agree(film.middle, disc_picture(kFilmWidth, kFilmHeight, 21), tolerance, "disc_control"));
}

TEST(Films, TwoRunsGiveTheSameBytes) {
  const TemporaryFolder folder;
  write_discs(folder.file("a.mp4"), 130);
  write_discs(folder.file("b.mp4"), 130);
  EXPECT_EQ(read_whole_file(folder.file("a.mp4")), read_whole_file(folder.file("b.mp4")));
  // ... which would also hold if the file did not depend on the frames.
  write_discs(folder.file("c.mp4"), 129);
  EXPECT_NE(read_whole_file(folder.file("a.mp4")), read_whole_file(folder.file("c.mp4")));
}

TEST(Films, TheNumberOfCoresDoesNotChangeTheBytes) {
  const TemporaryFolder folder;
  write_discs(folder.file("all.mp4"), 130);
  cpu_set_t all, one;
  ASSERT_EQ(sched_getaffinity(0, sizeof all, &all), 0);
  CPU_ZERO(&one);
  for (int cpu = 0; cpu < CPU_SETSIZE && CPU_COUNT(&one) == 0; ++cpu)
    if (CPU_ISSET(cpu, &all)) CPU_SET(cpu, &one);
  ASSERT_EQ(sched_setaffinity(0, sizeof one, &one), 0);
  write_discs(folder.file("one.mp4"), 130);
  ASSERT_EQ(sched_setaffinity(0, sizeof all, &all), 0);
  EXPECT_EQ(read_whole_file(folder.file("all.mp4")), read_whole_file(folder.file("one.mp4")));
}

TEST(Films, SaysNothingAboutTheTimeOfWriting) {
  const TemporaryFolder folder;
  write_discs(folder.file("a.mp4"), 3);
  const std::string bytes = read_whole_file(folder.file("a.mp4"));
  EXPECT_THAT(bytes, testing::Not(HasSubstr("Lavf")));
  // Box mvhd: four letters, version and flags, then creation and modification time.
  const std::size_t mvhd = bytes.find("mvhd");
  ASSERT_NE(mvhd, std::string::npos);
  EXPECT_EQ(bytes.substr(mvhd + 8, 8), std::string(8, '\0'));
}

TEST(Films, OddSidesNameTheNearestLegalSizes) {
  const Error error = error_of([] { require_even_sides(641, 360); });
  EXPECT_EQ(error.code(), ExitCode::usage);
  EXPECT_THAT(error.what(), HasSubstr("640x360 and 642x360"));
  EXPECT_THAT(error_of([] { require_even_sides(641, 361); }).what(), HasSubstr("640x360 and 642x362"));
  EXPECT_THAT(error_of([] { require_even_sides(1, 0); }).what(), HasSubstr("nearest legal size is 2x2"));
  EXPECT_THAT(error_of([] { require_even_sides(100000, 360); }).what(),
              HasSubstr("nearest legal size is 16384x360"));
  EXPECT_EQ(error_of([] { require_even_sides(640, 360); }).code(), ExitCode::good);

  const TemporaryFolder folder;
  EXPECT_EQ(error_of([&] { FilmOfFrames(folder.file("odd.mp4"), {.width = 641, .height = 360}); }).code(),
            ExitCode::usage);
  EXPECT_FALSE(fs::exists(folder.file("odd.mp4")));
}

TEST(Films, TheSmallestLegalFilmIsWritten) {
  const TemporaryFolder folder;
  FilmOfFrames writer(folder.file("small.mp4"), {.width = 2, .height = 2});
  writer.write(flat_picture(2, 2, pixel_of(0x808080)));
  writer.finish();
  EXPECT_EQ(probe_video(folder.file("small.mp4")).frames, 1);
}

TEST(Films, SettingsThatMakeNoFilmAreUsageErrors) {
  const TemporaryFolder folder;
  for (const FrameRate fps : {FrameRate{0, 1}, FrameRate{60, 0}, FrameRate{-60, 1}})
    EXPECT_EQ(error_of([&] { FilmOfFrames(folder.file("a.mp4"), {.fps = fps}); }).code(), ExitCode::usage);
  for (const double crf : {-1.0, 52.0, std::numeric_limits<double>::quiet_NaN()})
    EXPECT_EQ(error_of([&] { FilmOfFrames(folder.file("a.mp4"), {.crf = crf}); }).code(), ExitCode::usage);
  FilmOfFrames writer(folder.file("a.mp4"), {.width = 64, .height = 64});
  EXPECT_EQ(error_of([&] { writer.write(flat_picture(64, 62, {})); }).code(), ExitCode::usage);
}

TEST(Films, AFullDiskIsAFileError) {
  const auto write_to_full_disk = [](int frames) {
    FilmOfFrames writer("/dev/full", {.width = kFilmWidth, .height = kFilmHeight});
    for (int k = 0; k < frames; ++k) writer.write(random_picture(kFilmWidth, kFilmHeight, unsigned(k)));
    writer.finish();
  };
  EXPECT_EQ(error_of([&] { write_to_full_disk(100); }).code(), ExitCode::file);  // while frames are written
  EXPECT_EQ(error_of([&] { write_to_full_disk(1); }).code(),
            ExitCode::file);  // when the buffer is handed over
  EXPECT_THAT(error_of([&] { write_to_full_disk(1); }).what(), HasSubstr("No space left on device"));
}

TEST(Films, APlaceThatCannotBeWrittenIsAFileErrorAtOnce) {
  for (const char* path : {"/nonexistent/folder/a.mp4", "/proc/a.mp4", "/"}) {
    const Error error = error_of([&] { FilmOfFrames(path, {.width = 64, .height = 64}); });
    EXPECT_EQ(error.code(), ExitCode::file) << path;
    EXPECT_THAT(error.what(), HasSubstr(path));
  }
}

TEST(Films, PathsThatLookLikeProtocolsAreFiles) {
  const TemporaryFolder folder;
  const fs::path before = fs::current_path();
  fs::current_path(folder.path());
  const std::string path = "a:b c%d.mp4";
  write_discs(path, 2);
  fs::current_path(before);
  EXPECT_TRUE(fs::exists(folder.path() / path));
}

TEST(Films, WithoutAFrameThereIsAnErrorAndNoFile) {
  const TemporaryFolder folder;
  {
    FilmOfFrames writer(folder.file("none.mp4"), {.width = 64, .height = 64});
    const Error error = error_of([&] { writer.finish(); });
    EXPECT_EQ(error.code(), ExitCode::bad_input);
    EXPECT_THAT(error.what(), HasSubstr("no frame"));
  }
  EXPECT_FALSE(fs::exists(folder.file("none.mp4")));
}

TEST(Films, AnUnfinishedFilmIsTakenAway) {
  const TemporaryFolder folder;
  {
    FilmOfFrames writer(folder.file("part.mp4"), {.width = 64, .height = 64});
    writer.write(flat_picture(64, 64, {}));
  }
  EXPECT_FALSE(fs::exists(folder.file("part.mp4")));
}

// Chunks.

TEST(FilmChunks, AreEqualSharesOfAtMostTwoSecondsAndNotTooShort) {
  for (const FrameRate fps : {FrameRate{60, 1}, {25, 1}, {30000, 1001}, {1, 1}, {240, 1}})
    for (const int frames : {1, 2, 23, 47, 48, 50, 100, 119, 120, 121, 160, 240, 300, 600, 601, 1800, 100'000}) {
      const std::vector<int> bounds = chunk_bounds(frames, fps, VideoCodec::h264);
      ASSERT_EQ(bounds.front(), 0);
      ASSERT_EQ(bounds.back(), frames);
      int shortest = frames, longest = 0;
      for (std::size_t k = 0; k + 1 < bounds.size(); ++k) {
        shortest = std::min(shortest, bounds[k + 1] - bounds[k]);
        longest = std::max(longest, bounds[k + 1] - bounds[k]);
      }
      EXPECT_LE(longest, std::lround(2 * fps.value()));
      EXPECT_LE(longest - shortest, 1);
      EXPECT_GE(shortest, std::min({24, frames, int(fps.value())})) << frames << " at " << fps.value();
      EXPECT_EQ(bounds, chunk_bounds(frames, fps, VideoCodec::vp9)) << "files of one film share their frames";
    }
  for (const int frames : {160, 240, 300, 600, 1800})
    EXPECT_EQ((chunk_bounds(frames, {60, 1}, VideoCodec::h264).size() - 1) % 4, 0u) << frames;
  EXPECT_EQ(chunk_bounds(20, {25, 1}, VideoCodec::prores), (std::vector<int>{0, 6, 13, 20}));
  EXPECT_EQ(chunk_bounds(20, {25, 1}, {}), (std::vector<int>{0, 6, 13, 20}));
}

TEST(FilmChunks, BeginWithKeyFramesWhereverTheyAreCut) {
  const TemporaryFolder folder;
  const VideoSettings settings{.width = kFilmWidth, .height = kFilmHeight, .fps = {25, 1}};
  FilmWriter writer(folder.file("a.mp4"), settings);
  int next = 0;
  for (const int length : {1, 2, 30, 7}) {
    ChunkEncoder encoder(settings);
    for (int k = 0; k < length; ++k) encoder.write(disc_picture(kFilmWidth, kFilmHeight, next++));
    encoder.finish();
    writer.add(encoder.take());
  }
  writer.finish();
  EXPECT_EQ(film_faults(folder.file("a.mp4"), 40, {25, 1}), "");
  EXPECT_THAT(probe_video(folder.file("a.mp4")).key_frames, testing::ElementsAre(0, 1, 3, 33));
}

TEST(FilmChunks, FromATapeAreThoseOfTheFramesThemselves) {
  const VideoSettings settings{.width = kFilmWidth, .height = kFilmHeight};
  ChunkTape tape;
  ChunkEncoder direct(settings), recorder(settings, &tape);
  for (int k = 0; k < 12; ++k)
    for (ChunkEncoder* encoder : {&direct, &recorder}) encoder->write(disc_picture(kFilmWidth, kFilmHeight, k));
  for (ChunkEncoder* encoder : {&direct, &recorder}) encoder->finish();
  EXPECT_EQ(tape.frames(), 12);
  EXPECT_TRUE(recorder.take().packets.empty());
  ChunkEncoder player(settings);
  player.play(tape);
  player.finish();
  EXPECT_EQ(player.conversion().cpu, 0);
  const FilmChunk expected = direct.take(), played = player.take();
  EXPECT_EQ(played.frames, 12);
  ASSERT_EQ(played.packets.size(), expected.packets.size());
  for (std::size_t i = 0; i < played.packets.size(); ++i) {
    EXPECT_TRUE(played.packets[i].data == expected.packets[i].data) << i;
    EXPECT_EQ(played.packets[i].pts, expected.packets[i].pts);
  }
}

TEST(Films, OfTheBestQualityLoseNothingButChroma) {
  const TemporaryFolder folder;
  Image grey = random_picture(64, 64, 1);  // without colour there is no chroma to lose: only limited range rounds
  for (std::size_t i = 0; i < grey.bgra.size(); i += 4) grey.bgra[i] = grey.bgra[i + 2] = grey.bgra[i + 1], grey.bgra[i + 3] = 255;
  FilmOfFrames writer(folder.file("a.mp4"), {.width = 64, .height = 64, .crf = 0});
  writer.write(grey);
  writer.finish();
  EXPECT_TRUE(pictures_agree(probe_video(folder.file("a.mp4")).first, grey, {.max = 2, .mean = 1}, "lossless"));
}

// What boxes touch is compared: the stream hangs on pixels, not on who told of them and how finely.
TEST(FilmChunks, AreTheSameWhoeverTellsWhatChanged) {
  const VideoSettings settings{.width = kFilmWidth, .height = kFilmHeight};
  const auto packets = [&](auto boxes_of) {
    ChunkEncoder encoder(settings);
    for (int k = 0; k < 12; ++k) encoder.write(disc_picture(kFilmWidth, kFilmHeight, k / 2), boxes_of(k));  // every second one stands
    encoder.finish();
    std::string all;
    for (const FilmPacket& packet : encoder.take().packets) all += packet.data;
    return all;
  };
  using Boxes = std::vector<PixelBox>;
  const std::string whole = packets([](int) { return Boxes{{0, 0, kFilmWidth, kFilmHeight}}; });
  EXPECT_EQ(packets([](int k) { return k % 2 == 0 ? Boxes{{32, 10, 90, 98}, {90, 0, 80, 108}} : Boxes{}; }), whole) << "boxes may overlap";
  EXPECT_NE(packets([](int k) { return k == 0 ? Boxes{{0, 0, kFilmWidth, kFilmHeight}} : Boxes{}; }), whole) << "negative control";
}

// Blocks that are passed over as still are those of the frame before, to the last bit; a film of noise that changes here and there.
TEST(Films, WithoutLossKeepBlocksThatStandAndThoseThatDoNot) {
  constexpr int kWide = 200, kHigh = 120;  // neither a multiple of a block's side
  const TemporaryFolder folder;
  FilmOfFrames writer(folder.file("a.mp4"), {.width = kWide, .height = kHigh, .crf = 0});
  Image grey = random_picture(kWide, kHigh, 1);
  const auto in_grey = [](Image& image) {
    for (std::size_t i = 0; i < image.bgra.size(); i += 4) image.bgra[i] = image.bgra[i + 2] = image.bgra[i + 1], image.bgra[i + 3] = 255;
  };
  in_grey(grey);
  const Image first = grey;
  for (int k = 0; k < 30; ++k) {
    // One pixel, in another block each time, at last in the corner that no whole block holds.
    const int x = k == 29 ? kWide - 1 : 7 * k % kWide, y = k == 29 ? kHigh - 1 : 11 * k % kHigh;
    if (k > 0) set_pixel(grey, x, y, pixel_of(k % 2 == 0 ? 0xFFFFFF : 0));
    writer.write(grey);
  }
  writer.finish();
  const VideoFacts film = probe_video(folder.file("a.mp4"));
  EXPECT_TRUE(pictures_agree(film.last, grey, {.max = 2, .mean = 1}, "lossless"));  // limited range rounds
  EXPECT_FALSE(pictures_agree(film.last, first, {.max = 2, .mean = 1}, "")) << "negative control";
}

// Where something passed over a faint grid the grid is as it was, a quarter of a second later.
TEST(Films, LeaveNothingBehindWhatMoved) {
  const TemporaryFolder folder;
  FilmOfFrames writer(folder.file("a.mp4"), {.width = kFilmWidth, .height = kFilmHeight, .fps = {60, 1}});
  Image grid = flat_picture(kFilmWidth, kFilmHeight, pixel_of(0x14171C));
  for (int y = 0; y < kFilmHeight; ++y)
    for (int x = 0; x < kFilmWidth; ++x)
      if ((x + 2 * y) % 24 == 0) set_pixel(grid, x, y, pixel_of(0x2C3038));
  constexpr int kPasses = 30, kRests = 16;
  for (int k = 0; k < kPasses + kRests; ++k) {
    Image frame = grid;
    for (int y = 0; y < kFilmHeight && k < kPasses; ++y)
      for (int x = 0; x < kFilmWidth; ++x)
        if (std::hypot(x - 6.0 * k, y - 54.0) < 20) set_pixel(frame, x, y, pixel_of(0x9AF5C8));
    writer.write(frame);
  }
  writer.finish();
  const VideoFacts film = probe_video(folder.file("a.mp4"));
  const PictureTolerance nearly{.max = 12, .mean = 1.2};  // chroma of half the resolution and the quantiser of first frames
  EXPECT_TRUE(pictures_agree(film.last, grid, nearly, "behind"));
  EXPECT_FALSE(pictures_agree(film.middle, grid, nearly, "")) << "negative control: it is there";
}

// Negative controls of the probe.

TEST(VideoProbe, AnotherLengthRateOrSizeIsSeen) {
  const TemporaryFolder folder;
  const std::string path = folder.file("a.mp4");
  write_discs(path, 12, {25, 1});
  EXPECT_EQ(film_faults(path, 12, {25, 1}), "");
  EXPECT_THAT(film_faults(path, 13, {25, 1}), HasSubstr("frames"));
  EXPECT_THAT(film_faults(path, 12, {24, 1}), HasSubstr("fps"));
  EXPECT_THAT(film_faults(path, 12, {24, 1}), HasSubstr("duration"));
}

TEST(VideoProbe, ATamperedFilmFails) {
  const TemporaryFolder folder;
  write_discs(folder.file("good.mp4"), 60);
  const std::string good = read_whole_file(folder.file("good.mp4"));

  EXPECT_EQ(film_faults(folder.write("copy.mp4", good), 60, {60, 1}), "");

  EXPECT_NE(film_faults(folder.write("cut.mp4", good.substr(0, good.size() * 2 / 3)), 60, {60, 1}), "");

  // Noise in the middle of the pictures.
  std::string noisy = good;
  for (std::size_t i = good.size() / 2; i < good.size() / 2 + 400; ++i)
    noisy[i] = static_cast<char>(noisy[i] ^ 0x5A);
  EXPECT_NE(film_faults(folder.write("noisy.mp4", noisy), 60, {60, 1}), "");

  // One time step in the index made longer: box stts, version, count, then (samples, ticks) pairs.
  std::string stretched = good;
  const std::size_t stts = stretched.find("stts");
  ASSERT_NE(stts, std::string::npos);
  ++stretched[stts + 4 + 4 + 4 + 4 + 3];
  EXPECT_NE(film_faults(folder.write("stretched.mp4", stretched), 60, {60, 1}), "");
}

TEST(VideoProbe, AnIndexAtTheEndIsSeen) {
  const TemporaryFolder folder;
  write_discs(folder.file("good.mp4"), 10);
  EXPECT_TRUE(has_index_first(folder.file("good.mp4")));
  // A box of data put before everything else.
  const std::string bytes = std::string("\0\0\0\x08mdat", 8) + read_whole_file(folder.file("good.mp4"));
  EXPECT_FALSE(has_index_first(folder.write("late.mp4", bytes)));
}

}  // namespace
}  // namespace chainreel
