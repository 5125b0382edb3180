// Each kind of film and clip, decoded again: frames, size, rate, colours, opacity, and what it says of
// itself.

#include <gmock/gmock.h>

extern "C" {
#include <libavcodec/version.h>
}

#include <algorithm>
#include <filesystem>
#include <set>

#include "core/error.hpp"
#include "encode/bleed.hpp"
#include "encode/film_start.hpp"
#include "encode/gif_writer.hpp"
#include "encode/palette.hpp"
#include "encode/png.hpp"
#include "encode/small_frames.hpp"
#include "encode/test_pictures.hpp"
#include "encode/video_writer.hpp"
#include "support/film_of_frames.hpp"
#include "support/picture_compare.hpp"
#include "support/temporary_folder.hpp"
#include "support/video_probe.hpp"

namespace chainreel {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

constexpr int kWidth = 160, kHeight = 90, kFrames = 5;

// The disc with a soft edge on nothing.
Image floating_disc(int k) {
  Image image(kWidth, kHeight);
  const double cx = 60 + 8 * k, cy = 45;
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x) {
      const double inside = 20.5 - std::hypot(x + 0.5 - cx, y + 0.5 - cy);
      const auto alpha = std::uint8_t(std::lround(255 * std::clamp(inside, 0.0, 1.0)));
      if (alpha > 0) set_pixel(image, x, y, {0x56, 0xB4, 0xE9, alpha});
    }
  return image;
}

struct FilmCase {
  const char* file;
  VideoSettings settings;
  const char* codec;
  const char* pixel_format;
  double largest_mean;  // of the difference to what was drawn, levels
  friend void PrintTo(const FilmCase& film, std::ostream* out) { *out << film.file; }
};

class EveryFilm : public ::testing::TestWithParam<FilmCase> {};

INSTANTIATE_TEST_SUITE_P(
    Formats, EveryFilm,
    ::testing::Values(
        FilmCase{"a.mp4", {}, "h264", "yuv420p", 1.5},
        FilmCase{"b.webm", {.codec = VideoCodec::vp9}, "vp9", "yuv420p", 1.5},
        FilmCase{"c.webm", {.codec = VideoCodec::vp9, .alpha = true}, "vp9", "yuva420p", 1.5},
        FilmCase{"d.mov", {.codec = VideoCodec::prores}, "prores", "yuv444p12le", 0.5},
        FilmCase{"e.mov", {.codec = VideoCodec::prores, .alpha = true}, "prores", "yuva444p12le", 0.5}),
    [](const auto& p) { return std::string(p.param.file).substr(0, 1); });

TEST_P(EveryFilm, DecodesToItsFramesInItsColours) {
  const TemporaryFolder folder;
  FilmCase film = GetParam();
  film.settings.width = kWidth;
  film.settings.height = kHeight;
  film.settings.fps = {25, 1};
  const std::string path = folder.file(film.file);
  const auto picture = [&](int k) {
    return film.settings.alpha ? floating_disc(k) : over(floating_disc(k), 255);
  };
  FilmOfFrames writer(path, film.settings);
  for (int k = 0; k < kFrames; ++k) writer.write(picture(k));
  writer.finish();

  const VideoFacts facts = probe_video(path);
  EXPECT_EQ(facts.codec, film.codec);
  EXPECT_EQ(facts.pixel_format, film.pixel_format);
  EXPECT_EQ(facts.width, kWidth);
  EXPECT_EQ(facts.height, kHeight);
  EXPECT_EQ(facts.frames, kFrames);
  EXPECT_EQ(facts.fps, (Ratio{25, 1}));
  EXPECT_TRUE(facts.regular);
  for (const std::string& tag : {facts.primaries, facts.transfer, facts.matrix}) EXPECT_EQ(tag, "bt709");
  // ProRes has no place for its range, which is always that of television; readers since FFmpeg 7 say no more than is written.
  const bool says_range = facts.codec != "prores" || LIBAVCODEC_VERSION_MAJOR < 61;
  EXPECT_EQ(facts.range, says_range ? "tv" : "unknown");
  EXPECT_EQ(facts.alpha_mode, facts.pixel_format == "yuva420p" ? "1" : "");
  // 4:2:0 blurs the edge of the disc; the mean over the page stays small. Opacity is seen on black and on
  // white.
  for (const int grey : {0, 255}) {
    const PictureTolerance coded{.max = 255, .mean = film.largest_mean};
    EXPECT_TRUE(pictures_agree(over(facts.first, grey), over(picture(0), grey), coded, "format_first"));
    EXPECT_TRUE(
        pictures_agree(over(facts.last, grey), over(picture(kFrames - 1), grey), coded, "format_last"));
    EXPECT_FALSE(pictures_agree(over(facts.last, grey), over(picture(0), grey), coded, "format_control"));
  }
  // In the middle of the disc its colour, within what limited range and the quantiser leave.
  const Pixel middle = facts.first.at(60, 45);
  EXPECT_NEAR(middle.r, 0x56, 4);
  EXPECT_NEAR(middle.g, 0xB4, 4);
  EXPECT_NEAR(middle.b, 0xE9, 4);
  EXPECT_NEAR(facts.first.at(5, 5).a, film.settings.alpha ? 0 : 255, 1);
}

TEST_P(EveryFilm, SaysWhatItIs) {
  const TemporaryFolder folder;
  FilmCase film = GetParam();
  film.settings.width = film.settings.height = 64;
  film.settings.tags = {{"title", "\u03C4 = 0"}, {"chainreel_scene", "a: 1\nb: \"two\" ; = # \\\n"}};
  const std::string path = folder.file(film.file);
  FilmOfFrames writer(path, film.settings);
  writer.write(flat_picture(64, 64, pixel_of(0x808080)));
  writer.finish();
  const Tags tags = read_film_tags(path);
  for (const auto& [key, text] : film.settings.tags) {
    ASSERT_TRUE(tags.contains(key)) << key;
    EXPECT_EQ(tags.at(key), text);
  }
  EXPECT_THROW(read_film_tags(folder.write("noise.mp4", "no film at all")), Error);
}

TEST(Formats, EdgesOnNothingKeepTheirColour) {
  // A compositor sees the disc's own blue at its soft edge, not a mixture with black.
  const TemporaryFolder folder;
  for (const VideoCodec codec : {VideoCodec::prores, VideoCodec::vp9}) {
    const std::string path = folder.file(codec == VideoCodec::vp9 ? "a.webm" : "a.mov");
    FilmOfFrames writer(path, {.width = kWidth, .height = kHeight, .codec = codec, .alpha = true});
    writer.write(floating_disc(0));
    writer.finish();
    const Image image = probe_video(path).first;
    int edge = 0;
    for (int y = 0; y < kHeight; ++y)
      for (int x = 0; x < kWidth; ++x) {
        const Pixel p = image.at(x, y);
        if (p.a < 60 || p.a > 200) continue;
        ++edge;
        EXPECT_NEAR(p.b, 0xE9, 12) << x << " " << y;
        EXPECT_NEAR(p.g, 0xB4, 12) << x << " " << y;
      }
    EXPECT_GT(edge, 30);
  }
}

TEST(Formats, ColoursBleedIntoWhatIsTransparentAlone) {
  Image image = floating_disc(0);
  const Image before = image;
  bleed_colors(image);
  for (std::size_t i = 0; i < image.bgra.size(); i += 4) {
    EXPECT_EQ(image.bgra[i + 3], before.bgra[i + 3]);
    if (before.bgra[i + 3] > 0) {
      EXPECT_EQ(image.bgra[i], before.bgra[i]);
    }
  }
  EXPECT_EQ(image.at(60, 22).b, 0xE9);  // just above the disc
  EXPECT_EQ(image.at(159, 89).b, 0);    // 64 pixels away from everything
  Image nothing(8, 8);
  bleed_colors(nothing);
  EXPECT_EQ(nothing.bgra, Image(8, 8).bgra);
}

TEST(Formats, AGifTakesEveryNthFrameAndKeepsFlatColours) {
  const TemporaryFolder folder;
  GifWriter writer(folder.file("a.gif"), {.width = kWidth, .height = kHeight, .fps = {60, 1}});
  for (int k = 0; k < 13; ++k) writer.write(over(floating_disc(k), 255));
  writer.finish();
  const VideoFacts facts = probe_video(folder.file("a.gif"));
  EXPECT_EQ(facts.codec, "gif");
  EXPECT_EQ(facts.frames, 5);  // 0, 3, 6, 9, 12: 20 a second
  EXPECT_EQ(facts.width, kWidth);
  EXPECT_EQ(facts.height, kHeight);
  EXPECT_EQ(facts.fps, (Ratio{20, 1}));
  EXPECT_EQ(facts.first.at(60, 45), pixel_of(0x56B4E9));
  EXPECT_EQ(facts.first.at(2, 2), pixel_of(0xFFFFFF));
  // Few colours: the clip is exact.
  EXPECT_EQ(facts.last.bgra, over(floating_disc(12), 255).bgra);
  EXPECT_NE(facts.last.bgra, over(floating_disc(11), 255).bgra);
}

TEST(Formats, AGifRemembersTextsOfAnyLengthAndIsTheSameFilmStill) {
  const TemporaryFolder folder;
  const std::string plain = folder.file("a.gif"), told = folder.file("b.gif");
  std::string text = "\u03C4: [0, 0]\n";
  while (text.size() < 2000) text += "# longer than several blocks of 255 bytes\n";
  const Tags tags{{"chainreel_scene", text}, {"title", "a \"disc\""}};
  for (const std::string& path : {plain, told}) {
    GifWriter writer(path, {.width = kWidth, .height = kHeight, .fps = {25, 1}, .tags = path == told ? tags : Tags{}});
    for (int k = 0; k < 3; ++k) writer.write(over(floating_disc(k), 255));
    writer.finish();
  }
  EXPECT_EQ(read_gif_comment(told), tags);
  EXPECT_TRUE(read_gif_comment(plain).empty());  // negative control
  const VideoFacts with = probe_video(told), without = probe_video(plain);
  EXPECT_EQ(with.frames, without.frames);
  EXPECT_EQ(with.last.bgra, without.last.bgra);
}

TEST(Formats, AGifIsAtMost800PixelsWide) {
  const TemporaryFolder folder;
  GifWriter writer(folder.file("a.gif"), {.width = 1600, .height = 900, .fps = {25, 1}});
  writer.write(flat_picture(1600, 900, pixel_of(0x0072B2)));
  writer.finish();
  const VideoFacts facts = probe_video(folder.file("a.gif"));
  EXPECT_EQ(facts.width, 800);
  EXPECT_EQ(facts.height, 450);
  EXPECT_EQ(facts.frames, 1);
  EXPECT_EQ(facts.first.at(400, 225), pixel_of(0x0072B2));
}

TEST(Formats, APaletteOfManyColoursKeepsTheFrequentOnesAndIsNearTheOthers) {
  // Two flat areas and a field of 4096 colours.
  Image image(64, 192);
  for (int y = 0; y < 192; ++y)
    for (int x = 0; x < 64; ++x)
      set_pixel(image, x, y,
                y < 64    ? pixel_of(0xFFFFFF)
                : y < 128 ? pixel_of(0xD55E01)
                          : Pixel{std::uint8_t(4 * x), std::uint8_t(4 * (y - 128)), 128, 255});
  PaletteMaker maker;
  maker.count(image);
  const std::vector<Pixel> palette = maker.choose();
  EXPECT_LE(palette.size(), PaletteMaker::kMostColors);
  EXPECT_GT(palette.size(), 128u);
  EXPECT_THAT(palette, testing::Contains(pixel_of(0xFFFFFF)));
  EXPECT_THAT(palette, testing::Contains(pixel_of(0xD55E01)));
  EXPECT_EQ(palette, maker.choose());
  PaletteMap map(palette);
  std::vector<std::uint8_t> indices(64 * 192);
  map.map(image, indices.data(), 64);
  double sum = 0;
  for (int y = 128; y < 192; ++y)
    for (int x = 0; x < 64; ++x) {
      const Pixel p = image.at(x, y), q = palette[indices[std::size_t(64 * y + x)]];
      sum += std::hypot(p.r - q.r, p.g - q.g);
    }
  // 191 cells of an even grid over 256 x 256 levels are 18.5 wide; the mean distance to a cell's middle is
  // 0.38 of that, 7.1; median cuts are less even.
  EXPECT_LT(sum / 4096, 9);
}

TEST(Formats, AnApngIsExactAndSaysWhatItIs) {
  const TemporaryFolder folder;
  const std::string path = folder.file("a.apng");
  ApngWriter writer(path, {.width = kWidth,
                           .height = kHeight,
                           .fps = {50, 1},
                           .alpha = true,
                           .tags = {{"chainreel_audit", std::string(20'000, 'a')}, {"chainreel_scene", "\u03C4: [0, 0]\n"}}});  // longer than what players look into
  for (int k = 0; k < 2 * kFrames; ++k) writer.write(floating_disc(k));
  writer.finish();
  const VideoFacts facts = probe_video(path);
  EXPECT_EQ(facts.codec, "apng");
  EXPECT_EQ(facts.frames, kFrames);
  EXPECT_EQ(facts.first.bgra, floating_disc(0).bgra);
  EXPECT_EQ(over(facts.last, 128).bgra, over(floating_disc(8), 128).bgra);
  EXPECT_EQ(read_png_text(path).at("chainreel_scene"), "\u03C4: [0, 0]\n");
  EXPECT_EQ(read_png(path).bgra, floating_disc(0).bgra);  // to a reader that knows no APNG
}

// Times that a clip plays, 0 for ever, as its file says: of an APNG the last number of its chunk acTL (PNG, third
// edition, 11.3.6.1), of a GIF that of the extension NETSCAPE2.0.
int plays_of(const std::string& path) {
  const std::string bytes = read_whole_file(path);
  const bool is_gif = bytes.starts_with("GIF");
  const std::size_t at = bytes.find(is_gif ? "NETSCAPE2.0" : "acTL");
  if (at == std::string::npos) return -1;
  const auto byte = [&](std::size_t i) { return int(std::uint8_t(bytes.at(at + i))); };
  return is_gif ? byte(13) + 256 * byte(14) : byte(11) + 256 * byte(10) + 65536 * byte(9);
}

TEST(Formats, SmallClipsPlayForEver) {
  const TemporaryFolder folder;
  const SmallClipSettings settings{.width = 64, .height = 64, .fps = {10, 1}};
  GifWriter gif(folder.file("a.gif"), settings);
  ApngWriter apng(folder.file("a.apng"), settings);
  for (int k = 0; k < 3; ++k) {
    gif.write(flat_picture(64, 64, pixel_of(0x101010u * unsigned(k))));
    apng.write(flat_picture(64, 64, pixel_of(0x101010u * unsigned(k))));
  }
  gif.finish();
  apng.finish();
  EXPECT_EQ(plays_of(folder.file("a.gif")), 0);
  EXPECT_EQ(plays_of(folder.file("a.apng")), 0);
}

// Quality that nobody names: the file is to the last byte that of 18 for H.264, of 28 for VP9.
TEST(Formats, FilmsHaveTheQualityThatTheirDocumentationNames) {
  const TemporaryFolder folder;
  const auto film = [&](VideoCodec codec, std::optional<double> crf) {
    const std::string path = folder.file(codec == VideoCodec::vp9 ? "a.webm" : "a.mp4");
    FilmOfFrames writer(path, {.width = kWidth, .height = kHeight, .crf = crf, .codec = codec});
    for (int k = 0; k < 3; ++k) writer.write(over(floating_disc(k), 255));
    writer.finish();
    return read_whole_file(path);
  };
  for (const auto& [codec, crf] : {std::pair{VideoCodec::h264, 18.0}, {VideoCodec::vp9, 28.0}}) {
    const std::string unsaid = film(codec, {});
    EXPECT_EQ(unsaid, film(codec, crf));
    EXPECT_NE(unsaid, film(codec, crf + 4)) << "negative control";
  }
}

TEST(Formats, ASequenceIsExact) {
  const TemporaryFolder folder;
  PngSequence sequence(folder.path().string(), "disc_", {{"title", "a disc"}});
  for (int k = 0; k < 3; ++k) sequence.write(floating_disc(k));
  sequence.finish();
  for (int k = 0; k < 3; ++k)
    EXPECT_EQ(read_png(folder.file("disc_00000" + std::to_string(k) + ".png")).bgra, floating_disc(k).bgra);
  EXPECT_EQ(read_png_text(folder.file("disc_000000.png")).at("title"), "a disc");
  EXPECT_EQ(PngSequence::file_name("a_", 1234567), "a_1234567.png");
}

TEST(Formats, SettingsThatMakeNoFilmAreUsageErrors) {
  const auto trouble = [](const VideoSettings& settings) {
    try {
      require_settings(settings);
    } catch (const Error& error) {
      return error.code() == ExitCode::usage ? std::string(error.what()) : "another code";
    }
    return std::string();
  };
  EXPECT_EQ(trouble({.crf = 60, .codec = VideoCodec::vp9}), "");
  EXPECT_THAT(trouble({.crf = 60}), HasSubstr("0 to 51"));
  EXPECT_THAT(trouble({.crf = 64, .codec = VideoCodec::vp9}), HasSubstr("0 to 63"));
  EXPECT_THAT(trouble({.alpha = true}), HasSubstr("no opacity"));
}

TEST(Formats, AnUnfinishedClipIsTakenAway) {
  const TemporaryFolder folder;
  {
    GifWriter gif(folder.file("a.gif"), {.width = 64, .height = 64});
    gif.write(flat_picture(64, 64, {}));
    ApngWriter apng(folder.file("a.apng"), {.width = 64, .height = 64});
    apng.write(flat_picture(64, 64, {}));
  }
  EXPECT_TRUE(fs::is_empty(folder.path()));
}

}  // namespace
}  // namespace chainreel
