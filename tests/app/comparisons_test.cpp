// `chainreel compare`: pictures, folders of pictures and films, what is said of them and with which exit
// code.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

#include "app/compare/comparison.hpp"
#include "core/json.hpp"
#include "encode/png.hpp"
#include "encode/small_frames.hpp"
#include "encode/video_writer.hpp"
#include "support/film_of_frames.hpp"
#include "support/run_program.hpp"
#include "support/temporary_folder.hpp"

namespace chainreel {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::Not;

constexpr int kWide = 96, kHigh = 64;

// A dark square on light paper, its left border at `x` (pixels, borders are anti-aliased).
Image square_at(double x, int width = kWide) {
  Image image(width, kHigh);
  for (int row = 0; row < kHigh; ++row)
    for (int column = 0; column < width; ++column) {
      const double inside =
          std::min(std::clamp(column + 1 - x, 0.0, 1.0), std::clamp(x + 20 - column, 0.0, 1.0));
      const double ink = row >= 20 && row < 40 ? inside : 0;
      std::uint8_t* p = &image.bgra[std::size_t(4 * (row * width + column))];
      p[0] = p[1] = p[2] = std::uint8_t(std::lround(240 - 200 * ink));
      p[3] = 255;
    }
  return image;
}

std::string picture(const TemporaryFolder& folder, const std::string& name, const Image& image,
                    const std::map<std::string, std::string>& text = {}) {
  fs::create_directories(fs::path(folder.file(name)).parent_path());
  write_png(folder.file(name), image, text);
  return folder.file(name);
}

// A film in which the square moves by a pixel a frame, but for one frame, which is off by `off`.
std::string film(const TemporaryFolder& folder, const std::string& name, int frames, int odd_frame = -1,
                 double off = 0, FrameRate fps = {25, 1}) {
  const std::string path = folder.file(name);
  std::unique_ptr<FrameSink> sink;
  const SmallClipSettings small{.width = kWide, .height = kHigh, .fps = fps, .alpha = false, .tags = {}};
  if (name.ends_with(".gif"))
    sink = std::make_unique<GifWriter>(path, small);
  else if (name.ends_with(".apng"))
    sink = std::make_unique<ApngWriter>(path, small);
  else
    sink = std::make_unique<FilmOfFrames>(path,
                                         VideoSettings{.width = kWide,
                                                       .height = kHigh,
                                                       .fps = fps,
                                                       .crf = {},
                                                       .codec = name.ends_with(".mp4")   ? VideoCodec::h264
                                                                : name.ends_with(".mov") ? VideoCodec::prores
                                                                                         : VideoCodec::vp9});
  for (int k = 0; k < frames; ++k) sink->write(square_at(10 + k + (k == odd_frame ? off : 0)));
  sink->finish();
  return path;
}

ProgramResult compared(Words words) {
  words.insert(words.begin(), "compare");
  return run_program(words);
}

Json report(Words words) {
  words.push_back("--json");
  const ProgramResult result = compared(std::move(words));
  EXPECT_EQ(result.err.empty(), result.status == 0) << result.err;
  Json json = Json::parse(result.out);
  json["status"] = result.status;
  return json;
}

TEST(Compare, EqualPicturesAreExitZero) {
  const TemporaryFolder folder;
  const std::string a = picture(folder, "a.png", square_at(10));
  const ProgramResult same = run_program({"compare", a, a});
  EXPECT_EQ(same.status, 0);
  EXPECT_EQ(same.out, "equal\n");
  EXPECT_EQ(run_program({"compare", a, a, "--quiet"}).out, "");
}

TEST(Compare, AMoveByAPixelIsExitOneAndSaysWhere) {
  const TemporaryFolder folder;
  const std::string a = picture(folder, "a.png", square_at(10)), b = picture(folder, "b.png", square_at(11));
  const Json json = report({a, b});
  EXPECT_EQ(json["status"], 1);
  EXPECT_EQ(json["passes"], false);
  EXPECT_EQ(json["unequal"], 40);
  EXPECT_EQ(json["beyond"], 40);
  EXPECT_EQ(json["box"], (Json{10, 20, 21, 20}));
  const ProgramResult told = run_program({"compare", a, b});
  EXPECT_THAT(told.out, HasSubstr("40 pixels are unequal; 40 are beyond the error 0.1"));
  EXPECT_THAT(told.out, HasSubstr("in 21x20 at 10 20"));
  EXPECT_THAT(told.err, HasSubstr("a.png and " + b + " differ"));
  EXPECT_EQ(run_program({"compare", a, b, "--pixels", "40"}).status, 0);
  EXPECT_EQ(run_program({"compare", a, b, "--pixels", "39"}).status, 1);
  EXPECT_EQ(run_program({"compare", a, b, "--tolerance", "1"}).status, 0);
}

// What exit code 0 means is said where something differs all the same.
TEST(Compare, SaysWhyADifferenceIsExitZero) {
  const TemporaryFolder folder;
  const std::string a = picture(folder, "a.png", square_at(10)), b = picture(folder, "b.png", square_at(10.3));
  const ProgramResult near = run_program({"compare", a, b});
  EXPECT_EQ(near.status, 0);
  EXPECT_THAT(near.out, HasSubstr("within the tolerance, which exit code 0 means"));
  const ProgramResult every = run_program({"compare", a, b, "--tolerance", "0", "--count-edges"});
  EXPECT_EQ(every.status, 1) << "the remedy works";
  EXPECT_THAT(every.out, Not(HasSubstr("within")));

  std::string urdf = read_whole_file("models/rr.urdf");
  const std::string light = folder.write("light.urdf", urdf);
  urdf.replace(urdf.find("mass value=\"1\""), 14, "mass value=\"2\"");
  const std::string heavy = folder.write("heavy.urdf", urdf);
  const auto figure = [&](const std::string& model, const char* name) {
    EXPECT_EQ(run_program({"snapshot", model, "--pose", "30deg,40deg", "-o", folder.file(name)}).status, 0);
    return folder.file(name);
  };
  const ProgramResult same = run_program({"compare", figure(light, "light.png"), figure(heavy, "heavy.png")});
  EXPECT_EQ(same.status, 0);
  EXPECT_THAT(same.out, testing::StartsWith("equal\n"));
  EXPECT_THAT(same.out, HasSubstr("the model file is another one"));
  EXPECT_THAT(same.out, HasSubstr("the pixels do not show it, and they alone are judged"));
  EXPECT_EQ(run_program({"compare", light, heavy}).status, 1) << "the remedy works";
}

TEST(Compare, AFractionOfAPixelIsAntiAliasingUnlessEdgesCount) {
  const TemporaryFolder folder;
  const std::string a = picture(folder, "a.png", square_at(10)),
                    b = picture(folder, "b.png", square_at(10.3));
  const Json json = report({a, b});
  EXPECT_EQ(json["status"], 0);
  EXPECT_EQ(json["equal"], false);
  EXPECT_EQ(json["at_edges"], 40);
  EXPECT_EQ(report({a, b, "--count-edges"})["at_edges"], 0);
  EXPECT_EQ(report({a, b, "--count-edges"})["status"], 1);
}

TEST(Compare, SizesThatDifferAreToldBothWays) {
  const TemporaryFolder folder;
  const std::string a = picture(folder, "a.png", square_at(10)),
                    b = picture(folder, "b.png", square_at(10, 80));
  const ProgramResult result = run_program({"compare", a, b, "-o", folder.file("d.png")});
  EXPECT_EQ(result.status, 1);
  EXPECT_THAT(result.out, HasSubstr("sizes differ: 96x64 and 80x64"));
  EXPECT_EQ(read_png(folder.file("d.png")).width, 96 + 8 + 80)
      << "both, since there is no difference to show";
  EXPECT_EQ(report({a, b})["sizes"], (Json{{96, 64}, {80, 64}}));
}

TEST(Compare, WritesTheDifferenceAloneOrBesideBoth) {
  const TemporaryFolder folder;
  const Image before = square_at(10), after = square_at(14);
  const std::string a = picture(folder, "a.png", before), b = picture(folder, "b.png", after);
  EXPECT_EQ(run_program({"compare", a, b, "-o", folder.file("d.png")}).status, 1);
  const Image alone = read_png(folder.file("d.png"));
  EXPECT_EQ(alone.bgra, difference_picture(before, after, {.forgive_edges = true}).bgra);
  EXPECT_EQ(run_program({"compare", a, b, "-o", folder.file("e.png"), "--side-by-side"}).status, 1);
  const Image beside = read_png(folder.file("e.png"));
  ASSERT_EQ(beside.width, 3 * kWide + 16);
  for (int x = 0; x < kWide; ++x) {
    EXPECT_EQ(beside.at(x, 30), before.at(x, 30));
    EXPECT_EQ(beside.at(kWide + 8 + x, 30), after.at(x, 30));
    EXPECT_EQ(beside.at(2 * kWide + 16 + x, 30), alone.at(x, 30));
  }
}

TEST(Compare, SaysWhichKeysOfTheScenesDiffer) {
  const TemporaryFolder folder;
  const auto scene = [](const std::string& method) {
    return std::map<std::string, std::string>{
        {"chainreel_scene", "title: T\nmodel: m.urdf\nmethod: " + method + "\n"},
        {"chainreel_audit", R"({"trajectory_sha256": ")" + method + "\"}"}};
  };
  const std::string a = picture(folder, "a.png", square_at(10), scene("rk4"));
  const std::string b = picture(folder, "b.png", square_at(12), scene("dop853"));
  const std::string silent = picture(folder, "c.png", square_at(12));
  EXPECT_EQ(report({a, b})["explained"],
            (Json{"method rk4 -> dop853", "the motion at the frames is another one, by its hash"}));
  EXPECT_EQ(report({a, a})["explained"], Json::array());
  EXPECT_THAT(report({a, silent})["explained"][0].get<std::string>(), HasSubstr("only " + a + " remembers"));
  EXPECT_EQ(report({silent, silent})["explained"], Json::array());
}

// A camera that is fitted to the motion moves with it.
TEST(Compare, SaysThatTheCameraWasFittedAnew) {
  const TemporaryFolder folder;
  const auto picture_of = [&](const std::string& file, const Words& more) {
    EXPECT_EQ(run_program(with({"snapshot", "assets/scenes/rr_free.yaml", "--set", "duration=1", "--set", "layout=scene", "-o", folder.file(file)}, more)).status, 0);
    return folder.file(file);
  };
  const auto explained = [](const std::string& a, const std::string& b) { return report({a, b})["explained"].dump(); };
  const std::string one = picture_of("a.png", {}), shorter = picture_of("b.png", {"--set", "duration=0.1"});
  EXPECT_THAT(explained(one, shorter), HasSubstr("the camera, which is fitted to the motion, shows "));
  EXPECT_THAT(explained(one, picture_of("c.png", {"--set", "title=another"})), Not(HasSubstr("the camera")));
  // A camera that the scene sets is told as its key alone.
  const Words fit{"--set", "camera.fit=[-2, -2, 2, 2]"};
  EXPECT_THAT(explained(one, picture_of("d.png", fit)), testing::AllOf(HasSubstr("camera.fit"), Not(HasSubstr("fitted to the motion"))));
  EXPECT_THAT(explained(picture_of("e.png", fit), picture_of("f.png", with(fit, {"--set", "duration=0.1"}))), Not(HasSubstr("the camera")));
}

TEST(Compare, SaysWhichCommandsMadeTwoFigures) {
  const TemporaryFolder folder;
  const auto figure = [](const std::string& pose, const std::string& hash) {
    return std::map<std::string, std::string>{
        {"chainreel_figure", R"({"arguments": ["ellipse", "rr.urdf", "--pose", ")" + pose +
                                 R"("], "model_sha256": ")" + hash + "\"}"}};
  };
  const std::string a = picture(folder, "a.png", square_at(10), figure("0,1", "1"));
  const std::string b = picture(folder, "b.png", square_at(12), figure("0,2", "2"));
  EXPECT_EQ(report({a, b})["explained"],
            (Json{"command: chainreel ellipse rr.urdf --pose 0,1 -> chainreel ellipse rr.urdf --pose 0,2",
                  "the model file is another one, by its hash"}));
  const std::string c = picture(folder, "c.png", square_at(10), figure("0,1", R"(3", "model_elements_sha256": "e)"));
  const std::string d = picture(folder, "d.png", square_at(12), figure("0,1", R"(4", "model_elements_sha256": "e)"));
  EXPECT_EQ(report({c, d})["explained"], (Json{"the model file has other comments or line breaks, and says the same, by its hash"}));
  EXPECT_EQ(report({a, d})["explained"], (Json{"the model file is another one, by its hash"})) << "of comments an older file knows nothing";
}

TEST(Compare, SpoiltMemoriesAreNoTrouble) {
  const TemporaryFolder folder;
  const std::string good =
      picture(folder, "a.png", square_at(10), {{"chainreel_scene", "a: 1\n"}, {"chainreel_audit", "{}"}});
  const std::string no_yaml =
      picture(folder, "b.png", square_at(10), {{"chainreel_scene", "a: [1\n"}, {"chainreel_audit", "[3]"}});
  const std::string no_audit =
      picture(folder, "c.png", square_at(10), {{"chainreel_scene", "a: 1\n"}, {"chainreel_audit", "{"}});
  EXPECT_THAT(report({good, no_yaml})["explained"][0].get<std::string>(),
              HasSubstr("cannot be read as a scene"));
  EXPECT_EQ(report({good, no_audit})["explained"], Json::array());
}

TEST(Compare, NoPictureOfAFolderIsPassedOver) {
  const TemporaryFolder folder;
  for (const std::string side : {"old/", "new/"}) picture(folder, side + "same.png", square_at(10));
  picture(folder, "old/deep/er/a.png", square_at(10));
  picture(folder, "new/deep/er/a.png", square_at(15));
  picture(folder, "old/b.PNG", square_at(10));
  picture(folder, "new/b.PNG", square_at(15));
  const Json json = report({folder.file("old"), folder.file("new")});
  EXPECT_EQ(json["status"], 1);
  EXPECT_EQ(json["counts"], (Json{{"differs", 2}, {"equal", 1}}));
}

TEST(Compare, FoldersAreComparedByNames) {
  const TemporaryFolder folder;
  for (const std::string side : {"old/", "new/"}) picture(folder, side + "same.png", square_at(10));
  picture(folder, "old/moved.png", square_at(10));
  picture(folder, "new/moved.png", square_at(15));
  picture(folder, "old/soft.png", square_at(10));
  picture(folder, "new/soft.png", square_at(10.3));
  picture(folder, "old/gone.png", square_at(10));
  picture(folder, "new/added.png", square_at(10));
  folder.write("old/notes.txt", "no picture");
  const std::string before = folder.file("old"), after = folder.file("new");
  const Json json = report({before, after});
  EXPECT_EQ(json["status"], 1);
  EXPECT_EQ(json["counts"],
            (Json{{"added", 1}, {"differs", 1}, {"equal", 1}, {"gone", 1}, {"within tolerance", 1}}));
  EXPECT_EQ(json["pictures"].size(), 5u);
  EXPECT_EQ(json["pictures"][0]["name"], "added.png");
  const ProgramResult told = run_program({"compare", before, after, "-o", folder.file("shown")});
  EXPECT_THAT(told.out, HasSubstr("moved.png: differs: "));
  EXPECT_THAT(told.out, HasSubstr("gone.png: gone\n"));
  EXPECT_THAT(told.out, HasSubstr("1 added, 1 differs, 1 equal, 1 gone, 1 within tolerance\n"));
  EXPECT_TRUE(fs::exists(folder.file("shown/moved.png")));
  EXPECT_TRUE(fs::exists(folder.file("shown/soft.png")));
  EXPECT_FALSE(fs::exists(folder.file("shown/same.png")));
  EXPECT_EQ(run_program({"compare", before, before}).status, 0);
  EXPECT_EQ(run_program({"compare", before, after, "-o", folder.file("shown")}).status, 6)
      << "never over others' files";
  EXPECT_EQ(run_program({"compare", before, after, "-o", before, "--force"}).status, 6)
      << "nor over what is compared";
}

TEST(Compare, OfFoldersNoFormerDifferenceStaysThatIsNoMore) {
  const TemporaryFolder folder;
  for (const char* name : {"equal.png", "gone.png", "mine.png"}) {
    picture(folder, std::string("old/") + name, square_at(10));
    picture(folder, std::string("new/") + name, square_at(15));
  }
  const std::string before = folder.file("old"), after = folder.file("new"), shown = folder.file("shown");
  EXPECT_EQ(run_program({"compare", before, after, "-o", shown}).status, 1);
  picture(folder, "shown/mine.png", square_at(30));  // the user's own, in the place of ours
  for (const char* name : {"equal.png", "mine.png"}) picture(folder, std::string("new/") + name, square_at(10));
  fs::remove(fs::path(after) / "gone.png");
  EXPECT_EQ(run_program({"compare", before, after, "-o", shown}).status, 1);
  EXPECT_FALSE(fs::exists(fs::path(shown) / "equal.png"));
  EXPECT_FALSE(fs::exists(fs::path(shown) / "gone.png"));
  EXPECT_TRUE(fs::exists(fs::path(shown) / "mine.png"));
  // Pictures of differences may be compared themselves, and are inputs then.
  const std::string gone = picture(folder, "a/x.png", square_at(1), {{"chainreel_compared", ""}});
  picture(folder, "b/x.png", square_at(1));
  EXPECT_EQ(run_program({"compare", folder.file("a"), folder.file("b"), "-o", folder.file("a")}).status, 0);
  EXPECT_TRUE(fs::exists(gone));
}

class ComparedFilms : public ::testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Formats, ComparedFilms, ::testing::Values(".mp4", ".mov", ".webm", ".gif", ".apng"),
                         [](const auto& p) { return std::string(p.param).substr(1); });

TEST_P(ComparedFilms, AreEqualOrTellTheFrameThatIsNot) {
  const TemporaryFolder folder;
  const std::string ending = GetParam();
  const std::string a = film(folder, "a" + ending, 8), b = film(folder, "b" + ending, 8, 5, 6.0);
  const std::string shorter = film(folder, "c" + ending, 7);
  const Json same = report({a, a});
  EXPECT_EQ(same["status"], 0);
  EXPECT_EQ(same["frames"], (Json{8, 8}));
  EXPECT_EQ(same["fps"][0], 25);
  EXPECT_EQ(same["unequal_frames"], 0);

  const std::string picture = folder.file("d.png"), strip = folder.file("s.png");
  const Json odd = report({a, b, "-o", picture, "--strip", strip});
  EXPECT_EQ(odd["status"], 1);
  // Codecs of films spread a change to the frames around it; the one that is off is still the worst.
  EXPECT_EQ(odd["worst"]["frame"], 5);
  EXPECT_LE(odd["first"]["frame"], 5);
  EXPECT_GE(odd["frames_beyond"], 1);
  EXPECT_EQ(odd["errors"].size(), 8u);
  EXPECT_EQ(read_png(picture).width, kWide);
  EXPECT_EQ(read_png(strip).width, 8 * 8) << "a bar a frame";
  EXPECT_NE(read_png(strip).at(5 * 8 + 4, 70), read_png(strip).at(0, 70));

  const Json cut = report({a, shorter});
  EXPECT_EQ(cut["status"], 1);
  EXPECT_EQ(cut["frames"], (Json{8, 7}));
}

TEST(Compare, FilmsOfOtherRatesOrSizesDiffer) {
  const TemporaryFolder folder;
  const std::string a = film(folder, "a.apng", 4), fast = film(folder, "b.apng", 4, -1, 0, {20, 1});
  const ProgramResult told = run_program({"compare", a, fast});
  EXPECT_EQ(told.status, 1);
  EXPECT_THAT(told.out, HasSubstr("frames a second: 25 -> 20"));
  const std::string small = folder.file("c.apng");
  ApngWriter writer(small, {.width = 80, .height = kHigh, .fps = {25, 1}, .alpha = false, .tags = {}});
  for (int k = 0; k < 4; ++k) writer.write(square_at(10 + k, 80));
  writer.finish();
  const ProgramResult sizes = run_program({"compare", a, small});
  EXPECT_EQ(sizes.status, 1);
  EXPECT_THAT(sizes.out, HasSubstr("sizes differ: 96x64 and 80x64"));
}

TEST(Compare, ModelsAreComparedInWords) {
  const TemporaryFolder folder;
  std::string text = read_whole_file("models/rr.urdf");
  const std::size_t mass = text.find("mass value=\"");
  ASSERT_NE(mass, std::string::npos);
  text.insert(mass + 12, "1");
  const std::string heavier = folder.write("rr.urdf", text);
  EXPECT_EQ(report({"models/rr.urdf", "models/rr.urdf"})["explained"], Json::array());
  const Json json = report({"models/rr.urdf", heavier});
  EXPECT_EQ(json["status"], 1);
  EXPECT_THAT(json["explained"][0].get<std::string>(), HasSubstr("mass 1 -> 11 kg"));
  // Of collisions, too, which no picture shows.
  text = read_whole_file("models/rr.urdf");
  text.insert(text.find("<link name=\"link1\">") + 19,
              "<collision><geometry><sphere radius='1'/></geometry></collision>");
  EXPECT_THAT(report({"models/rr.urdf", folder.write("b.urdf", text)})["explained"].dump(),
              HasSubstr("link link1: collision 1 (sphere) added"));
  EXPECT_EQ(compared({"models/rr.urdf", heavier, "-o", folder.file("d.png")}).status, 2) << "has no picture";
  EXPECT_EQ(compared({"models/rr.urdf", heavier, "--set", "method=rk4"}).status, 2);
}

TEST(Compare, TrajectoriesAreComparedInWords) {
  const TemporaryFolder folder;
  const std::string a = folder.write("a.csv", "t,q1,q2,qd1,qd2\n0,0,0,0,0\n0.5,1,0,0,0\n1,2,3,0,0\n");
  const std::string b = folder.write("b.csv", "t,q1,q2,qd1,qd2\n0,0,0,0,0\n0.5,1,0,0,0\n1,2,3.5,0,0\n");
  const std::string close =
      folder.write("c.csv", "t,q1,q2,qd1,qd2\n0,0,0,0,0\n0.5,1,0,0,0\n1,2,3.0000000000001,0,0\n");
  EXPECT_EQ(report({a, a})["equal"], true);
  const Json json = report({a, b});
  EXPECT_EQ(json["status"], 1);
  EXPECT_THAT(json["explained"][0].get<std::string>(), HasSubstr("q2 differs by 0.5"));
  EXPECT_THAT(json["explained"][0].get<std::string>(), HasSubstr("t = 1 s"));
  EXPECT_EQ(report({a, close})["equal"], false);
  EXPECT_EQ(report({a, close})["status"], 0);
  // 0.5 of a range of 3.5 is a seventh of it.
  const Json wide = report({a, b, "--tolerance", "0.15"});
  EXPECT_EQ(wide["status"], 0);
  EXPECT_EQ(wide["tolerance"], (Json{{"of_range", 0.15}}));
  EXPECT_EQ(compared({a, b, "--tolerance", "0.15"}).out, "no number differs by more than 0.15 of its range\n");
  EXPECT_EQ(compared({a, b, "--tolerance", "0.14"}).status, 1);
  EXPECT_EQ(compared({a, close, "--tolerance", "0"}).status, 0) << "1e-12 is rounding";
  // What says nothing of tables or models is refused.
  for (const Words& vain : {Words{"--pixels", "3"}, Words{"--count-edges"}}) {
    Words words{a, b};
    words.insert(words.end(), vain.begin(), vain.end());
    EXPECT_EQ(compared(words).status, 2);
  }
  EXPECT_THAT(compared({"models/rr.urdf", "models/rrr.urdf", "--tolerance", "1"}).err, HasSubstr("--tolerance says nothing of models"));
  // Numbers of other units are compared as numbers of one.
  const std::string rad = folder.write("r.csv", "t [s],q1 [rad]\n0,0\n1,1\n"), deg = folder.write("s.csv", "t [s],q1 [deg]\n0,0\n1,57.29577951308232\n");
  EXPECT_EQ(compared({rad, deg}).out, "units q1 rad -> deg, compared in the first\n");
  EXPECT_THAT(compared({rad, folder.write("t.csv", "t [s],q1 [deg]\n0,0\n1,114.59155902616465\n")}).out, HasSubstr("q1 differs by 1 rad from t = 1 s on"));
  // Of several columns each has its line, rates behind positions.
  const std::string several = folder.write("g.csv", "t,q1,q2,qd1,qd2\n0,0,0,0,0\n0.5,1,0,0,0.25\n1,2,3.5,0,0\n");
  EXPECT_THAT(compared({a, several}).out, AllOf(testing::ContainsRegex("q2 +1 +0.5 +1 +3.5"), testing::ContainsRegex("qd2 +0.5 +0.25 +0.5 +0.25")));
  const Json columns = report({a, several})["columns"];
  ASSERT_EQ(columns.size(), 2u);
  EXPECT_EQ(columns[1]["name"], "qd2");
  EXPECT_EQ(columns[1]["largest"], 0.25);
  EXPECT_EQ(report({a, a})["columns"], Json::array());
  EXPECT_EQ(compared({a, folder.write("d.csv", "x,y\n0,0\n")}).status, 3);
  EXPECT_EQ(compared({a, folder.write("e.csv", "t,q1\n0,0\n0,0\n")}).status, 3);
  EXPECT_EQ(compared({a, folder.write("f.csv", "t,mass\n0,0\n")}).status, 3);
}

TEST(Compare, RowsAndColumnsThatOneTableLacksAreADifference) {
  const TemporaryFolder folder;
  const std::string a = folder.write("a.csv", "t,q1,q2,qd1,qd2\n0,0,0,1,2\n0.5,1,0,1,2\n1,2,3,1,2\n");
  const std::string rows = folder.write("b.csv", "t,q1,q2,qd1,qd2\n0,0,0,1,2\n1,2,3,1,2\n");
  for (const Words& pair : {Words{a, rows}, Words{rows, a}}) {
    const Json json = report(pair);
    EXPECT_EQ(json["status"], 1);
    EXPECT_THAT(json["explained"][0].get<std::string>(), HasSubstr("the first that only one has is at t = 0.5 s"));
  }
  const std::string rates = folder.write("c.csv", "t,q1,q2\n0,0,0\n0.5,1,0.25\n1,2,3\n");
  EXPECT_EQ(report({a, rates})["explained"],
            (Json{"q2 differs by 0.25 from t = 0.5 s on", "rates qd1, qd2 -> none"}));
  // By their names, not by their places.
  const std::string order = folder.write("d.csv", "t,qd2,q2,q1,qd1\n0,2,0,0,1\n0.5,2,0,1,1\n1,2,3,2,1\n");
  EXPECT_EQ(report({a, order})["equal"], true);
  EXPECT_THAT(compared({a, order}).out, HasSubstr("their columns stand in another order"));
}

TEST(Compare, MeshesThatNeitherModelHasAreSaidToBeNotCompared) {
  const TemporaryFolder folder;
  const std::string model = folder.write(
      "a.urdf", "<robot name='a'><link name='base'><visual><geometry><mesh filename='no.stl'/></geometry></visual></link>"
                "<link name='l'><inertial><mass value='1'/><inertia ixx='1' iyy='1' izz='1' ixy='0' ixz='0' iyz='0'/></inertial>"
                "</link><joint name='j' type='continuous'><parent link='base'/><child link='l'/><axis xyz='0 0 1'/></joint></robot>");
  EXPECT_EQ(report({model, model})["not_compared"], Json{"mesh no.stl"});
  EXPECT_THAT(compared({model, model}).out, HasSubstr("neither could be read: mesh no.stl"));
  EXPECT_EQ(report({"models/rr.urdf", "models/rr.urdf"})["not_compared"], Json::array());
}

TEST(Compare, TrajectoriesOfFloatingBasesAreComparedByTheirRotation) {
  const TemporaryFolder folder;
  const std::string head = "t,q.b.qx,q.b.qy,q.b.qz,q.b.qw\n0,0,0,0,1\n";
  const std::string a = folder.write("a.csv", head + "1,0,0,0.6,0.8\n"),
                    b = folder.write("b.csv", head + "1,0,0,-0.6,-0.8\n");
  EXPECT_EQ(report({a, b})["explained"], Json::array()) << "either sign means the same";
  const std::string c = folder.write("c.csv", head + "1,0,0,0.8,0.6\n");
  EXPECT_EQ(report({a, c})["explained"][0], "rotation of q.b differs by 0.57 rad from t = 1 s on");
  const std::string named = folder.write("d.csv", "t,q1\n0,0\n1,2\n"),
                    other = folder.write("e.csv", "t,q.a\n0,0\n1,2\n");
  EXPECT_EQ(report({named, other})["explained"], Json::array({"columns q1 -> q.a"}));
}

TEST(Compare, FramesThatAreShownAtOtherTimesDiffer) {
  const TemporaryFolder folder;
  const std::string a = film(folder, "a.gif", 6);
  // Two delays of 4 hundredths, exchanged for 2 and 6: the same frames, the same length.
  std::string bytes = read_whole_file(a);
  const std::string control = "\x21\xF9\x04";
  std::vector<std::size_t> delays;
  for (std::size_t at = bytes.find(control); at != std::string::npos; at = bytes.find(control, at + 1))
    delays.push_back(at + 4);
  ASSERT_EQ(delays.size(), 6u);
  ASSERT_EQ(bytes[delays[2]], 4);
  bytes[delays[2]] = 2;
  bytes[delays[3]] = 6;
  const Json json = report({a, folder.write("b.gif", bytes)});
  EXPECT_EQ(json["status"], 1);
  EXPECT_EQ(json["unequal_frames"], 0);
  EXPECT_EQ(json["other_time"]["frame"], 3);
}

TEST(Compare, AnimatedPicturesAndSixteenBitsAreNotPassedOver) {
  const TemporaryFolder folder;
  const std::string still = picture(folder, "a.png", square_at(10)), clip = film(folder, "b.apng", 3);
  fs::copy_file(clip, folder.file("b.png"));
  const ProgramResult animated = compared({still, folder.file("b.png")});
  EXPECT_EQ(animated.status, 3);
  EXPECT_THAT(animated.err, HasSubstr("named .apng"));
  // One grey pixel of 16 bits, 0x1234.
  std::string deep;
  const std::string hex =
      "89504e470d0a1a0a0000000d49484452000000010000000110000000006aee47160000000b49444154789c6310320100005b00"
      "479"
      "6fb1b650000000049454e44ae426082";
  for (std::size_t i = 0; i < hex.size(); i += 2) deep += char(std::stoi(hex.substr(i, 2), nullptr, 16));
  const std::string grey = folder.write("c.png", deep);
  const ProgramResult told = compared({grey, grey});
  EXPECT_EQ(told.status, 0) << told.err;
  EXPECT_THAT(told.out, HasSubstr("channels of 16 bits are compared as those of 8"));
  EXPECT_THAT(compared({still, still}).out, Not(HasSubstr("16 bits")));
}

TEST(Compare, WhatCannotBeComparedIsUsageAndWhatIsSpoiltBadInput) {
  const TemporaryFolder folder;
  const std::string a = picture(folder, "a.png", square_at(10)), clip = film(folder, "a.gif", 2);
  const std::string text = folder.write("a.txt", "words"), spoilt = folder.write("b.png", "no picture");
  const std::string cut = folder.write("c.gif", read_whole_file(clip).substr(0, 40));
  std::string huge = read_whole_file(clip);
  huge[6] = huge[7] = huge[8] = huge[9] = char(0xEA);  // 60138 by 60138 pixels
  const std::string wide = folder.write("d.gif", huge);
  fs::create_directory(folder.file("empty"));
  const auto status = [](Words words) { return compared(words).status; };
  EXPECT_EQ(status({a, clip}), 2);
  EXPECT_EQ(status({text, text}), 2);
  EXPECT_EQ(status({a, a, "--set", "step=1"}), 2);
  EXPECT_THAT(run_program({"compare", text, text}).err, HasSubstr("cannot be compared: two of a kind are"));
  EXPECT_EQ(status({a, folder.path().string()}), 2);
  EXPECT_EQ(status({a, a, "--strip", folder.file("s.png")}), 2);
  EXPECT_EQ(status({a, a, "--side-by-side"}), 2);
  EXPECT_EQ(status({a, a, "-o", folder.file("s.svg")}), 2);
  EXPECT_EQ(status({clip, clip, "-o", folder.file("s.png"), "--strip", folder.file("s.png")}), 2);
  for (const char* wrong : {"-0.1", "1.5", "nan"})
    EXPECT_EQ(status({a, a, "--tolerance", wrong}), 2) << wrong;
  EXPECT_EQ(status({a, a, "--pixels", "-1"}), 2);
  EXPECT_EQ(status({a, folder.file("none.png")}), 3);
  EXPECT_EQ(status({a, spoilt}), 3);
  EXPECT_EQ(status({clip, cut}), 3);
  EXPECT_EQ(status({wide, clip}), 3) << "no memory is asked for that";
  EXPECT_EQ(status({folder.path().string(), folder.file("empty")}), 3);
  EXPECT_EQ(status({a, a, "-o", a, "--force"}), 6) << "an input is never replaced";
}

}  // namespace
}  // namespace chainreel
