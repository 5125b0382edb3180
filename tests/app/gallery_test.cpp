// The gallery's page as text, and what it says of films that cannot be shown. tests/browser shows it in a
// browser.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "app/gallery/gallery_clips.hpp"
#include "app/gallery/gallery_page.hpp"
#include "app/report/page_template.hpp"
#include "core/hash.hpp"
#include "core/json.hpp"
#include "encode/film_start.hpp"
#include "encode/png.hpp"
#include "encode/video_writer.hpp"
#include "support/film_of_frames.hpp"
#include "support/picture_compare.hpp"
#include "support/run_program.hpp"
#include "support/temporary_folder.hpp"
#include "support/video_probe.hpp"

namespace chainreel {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::Not;

std::string render(const TemporaryFolder& folder, const std::string& name) {
  const std::string file = folder.file(name);
  const ProgramResult result =
      run_program({"render", "assets/scenes/rr_torque.yaml", "-o", file, "--quiet", "--force", "--set", "duration=0.2",
                   "--set", "video.width=160", "--set", "video.height=90", "--set", "text_scale=1.5"});
  EXPECT_EQ(result.status, 0) << result.err;
  return file;
}

ProgramResult gallery(const TemporaryFolder& folder, const std::vector<std::string>& more = {}) {
  std::vector<std::string> command{"gallery", folder.path().string(), "-o", folder.file("out/index.html")};
  command.insert(command.end(), more.begin(), more.end());
  return run_program(command);
}

std::string page(const TemporaryFolder& folder) {
  return read_whole_file(folder.file("out/index.html"));
}

TEST(Gallery, HoldsFilmsWholeAndIsTheSameEachTime) {
  const TemporaryFolder folder;
  const std::string film = render(folder, "a.mp4");
  ASSERT_EQ(gallery(folder).status, 0);
  const std::string first = page(folder);
  EXPECT_THAT(first, HasSubstr("src=\"data:video/mp4;base64," + base64(read_whole_file(film)) + "\""));
  ASSERT_EQ(gallery(folder).status, 0);
  EXPECT_EQ(page(folder), first);
}

TEST(Gallery, TakesAWebmWhereThereIsNoMp4AndLeavesPartialFilms) {
  const TemporaryFolder folder;
  const std::string film = render(folder, "a.mp4");
  render(folder, "a.webm");
  render(folder, "b.webm");
  fs::copy_file(film, folder.file("c.partial.mp4"));
  const ProgramResult result = gallery(folder, {"--json"});
  ASSERT_EQ(result.status, 0) << result.err;
  EXPECT_EQ(Json::parse(result.out)["clips"], 2);
  EXPECT_THAT(page(folder), HasSubstr("data:video/webm;base64,"));
}

TEST(Gallery, SaysWhatBrowsersDoNotPlay) {
  const TemporaryFolder folder;
  render(folder, "a.mp4");
  render(folder, "a.mov");
  render(folder, "b.mov");
  EXPECT_THAT(gallery(folder, {}).err, AllOf(HasSubstr("left out: " + folder.file("b.mov") + ";"), Not(HasSubstr("a.mov,"))));
  EXPECT_EQ(gallery(folder, {"--quiet"}).err, "");
  render(folder, "a.gif");
  EXPECT_THAT(gallery(folder, {}).err, HasSubstr("shown once, as the film of the same name: " + folder.file("a.gif") + ";"));
}

// What moves by itself needs no controls; who wants less motion sees its poster.
TEST(Gallery, ShowsMovingPicturesWhereThereIsNoFilmOfTheSame) {
  const TemporaryFolder folder;
  render(folder, "a.mp4");
  render(folder, "a.gif");
  const std::string gif = render(folder, "b.gif"), apng = render(folder, "c.apng");
  const ProgramResult result = gallery(folder, {"--json"});
  ASSERT_EQ(result.status, 0) << result.err;
  EXPECT_EQ(Json::parse(result.out)["clips"], 3);
  const std::string text = page(folder);
  EXPECT_THAT(text, HasSubstr("src=\"data:image/gif;base64," + base64(read_whole_file(gif)) + "\""));
  EXPECT_THAT(text, HasSubstr("src=\"data:image/apng;base64," + base64(read_whole_file(apng)) + "\""));
  const std::string card = text.substr(text.find("id=\"clip-2\""));
  EXPECT_THAT(card.substr(0, card.find("</article>")), AllOf(Not(HasSubstr("<video")), HasSubstr("prefers-reduced-motion"), HasSubstr("data-name=\"b.gif\"")));
}

// Two films of one name are two where each has its own audit.
TEST(Gallery, ShowsAWebmBesideAnotherFilmOfItsName) {
  const TemporaryFolder folder;
  render(folder, "a.mp4");
  ASSERT_EQ(run_program({"render", "assets/scenes/rr_torque.yaml", "-o", folder.file("a.webm"), "--quiet", "--force", "--set", "duration=0.3", "--set",
                         "video.width=160", "--set", "video.height=90"})
                .status,
            0);
  EXPECT_TRUE(fs::exists(folder.file("a.webm.json")));
  EXPECT_EQ(Json::parse(gallery(folder, {"--json"}).out)["clips"], 2);
}

// A render that was killed leaves such a file, one that runs writes it.
// Figures and sheets stand below the films; what goes with a film does not stand there once more.
TEST(Gallery, ShowsPicturesBelowItsFilms) {
  const TemporaryFolder folder;
  render(folder, "a.mp4");
  const auto ellipse = [&](const std::string& name, const std::string& title) {
    ASSERT_EQ(run_program({"ellipse", "models/rr.urdf", "--pose", "0,1", "--title", title, "--width", "320", "--height", "180", "--quiet", "-o", folder.file(name)}).status, 0);
  };
  ellipse("figure.png", "Heavy <along> the arm");
  ellipse("figure_2.svg", "A drawing");
  ellipse("figure.svg", "The same in another form");
  ellipse("a_still.png", "Named like the film, of its own");
  ellipse("paper.pdf", "Of paper alone");
  ellipse("a_chart.png", "It goes with the film");
  folder.write("photo.png", std::string(read_whole_file(folder.file("figure.png"))).substr(0, 100));  // remembers nothing
  const ProgramResult result = gallery(folder, {"--json"});
  ASSERT_EQ(result.status, 0) << result.err;
  EXPECT_EQ(Json::parse(result.out)["pictures"], 3);
  EXPECT_THAT(result.err, testing::AllOf(HasSubstr("paper.pdf"), HasSubstr("show .png and .svg")));
  const std::string text = page(folder), section = text.substr(text.find("<section class=\"pictures\""));
  EXPECT_THAT(section, HasSubstr("data:image/png;base64," + base64(read_whole_file(folder.file("figure.png")))));
  EXPECT_THAT(section, HasSubstr("data:image/svg+xml;base64," + base64(read_whole_file(folder.file("figure_2.svg")))));
  EXPECT_THAT(section, HasSubstr("Heavy &lt;along&gt; the arm"));
  EXPECT_THAT(section, Not(HasSubstr("It goes with the film")));
  EXPECT_THAT(section, HasSubstr("of its own"));
  EXPECT_THAT(section, Not(HasSubstr("The same in another form")));
  EXPECT_THAT(text, HasSubstr("One film, 0.2 s long, and 3 pictures."));
  // Pictures alone are a page, too; another program's has its name; what is only named so is none.
  const std::string own = folder.file("own/index.html");
  ASSERT_EQ(run_program({"gallery", folder.file("figure.png"), "-o", own}).status, 0);
  EXPECT_THAT(read_whole_file(own), HasSubstr("<p>one picture.</p>"));
  EXPECT_EQ(run_program({"gallery", folder.write("b.svg", "no drawing"), "-o", own}).status, 3);
  EXPECT_THAT(run_program({"gallery", folder.file("photo.png"), "-o", own}).err, HasSubstr("cannot be read as a picture"));
  EXPECT_THAT(run_program({"gallery", folder.file("paper.pdf"), "-o", own}).err, HasSubstr("pictures as .png and .svg"));
}

// A smaller clip has fewer frames than were drawn: its own are told.
TEST(Gallery, TellsTheFramesOfTheClipItself) {
  const TemporaryFolder folder;
  ASSERT_EQ(run_program({"render", "assets/scenes/pp_free.yaml", "-o", folder.file("a.gif"), "--quiet", "--set", "duration=1", "--set", "video.width=160", "--set",
                         "video.height=90", "--set", "text_scale=1.5"}).status, 0);
  const int frames = probe_video(folder.file("a.gif")).frames;
  ASSERT_EQ(gallery(folder).status, 0);
  EXPECT_LT(frames, 60);
  EXPECT_THAT(page(folder), HasSubstr(std::to_string(frames) + " frames"));
  EXPECT_THAT(page(folder), Not(HasSubstr("60 frames")));
}

TEST(Gallery, LeavesFilmsThatAreBeingWritten) {
  const TemporaryFolder folder;
  const std::string film = render(folder, "a.mp4");
  fs::copy_file(film, folder.file("b.4711.tmp.mp4"));
  const ProgramResult result = gallery(folder, {"--json"});
  ASSERT_EQ(result.status, 0) << result.err;
  EXPECT_EQ(Json::parse(result.out)["clips"], 1);
}

// 20 MB more, in a box that players pass over.
TEST(Gallery, TellsOfFilmsThatAreLongForAPage) {
  const TemporaryFolder folder;
  const std::string film = render(folder, "a.mp4");
  EXPECT_EQ(gallery(folder).err, "");
  const auto size = fs::file_size(film);
  constexpr unsigned kFree = 20'000'000;
  std::ofstream(film, std::ios::binary | std::ios::app)
      << char(kFree >> 24) << char(kFree >> 16 & 255) << char(kFree >> 8 & 255) << char(kFree & 255) << "free";
  fs::resize_file(film, size + kFree);
  const ProgramResult result = gallery(folder);
  EXPECT_EQ(result.status, 0);
  EXPECT_THAT(result.err, HasSubstr("a.mp4: has 20 MB; "));
  EXPECT_THAT(result.err, HasSubstr("a smaller video.width or a higher video.crf"));
  EXPECT_EQ(gallery(folder, {"--quiet"}).err, "");
}

TEST(Gallery, GivesChartsToTheFilmWithTheLongestName) {
  const TemporaryFolder folder;
  fs::copy_file(render(folder, "rr.mp4"), folder.file("rr_long.mp4"));
  for (const char* name : {"rr_long_chart.png", "rr_energy.png", "other_chart.png", "rr_frame.png"})
    write_png(folder.file(name), Image(4, 4));
  ASSERT_EQ(gallery(folder).status, 0);
  const std::string text = page(folder);
  const std::size_t second = text.find("id=\"clip-2\"");
  EXPECT_LT(text.find("rr_energy.png"), second);
  EXPECT_GT(text.find("rr_long_chart.png"), second);
  EXPECT_THAT(text, Not(HasSubstr("other_chart.png")));
  EXPECT_THAT(text, Not(HasSubstr("rr_frame.png")));
}

TEST(Gallery, SaysWhereAFilmRemembersNoScene) {
  const TemporaryFolder folder;
  const std::string file = folder.file("foreign.mp4");
  FilmOfFrames writer(file, {.width = 64, .height = 36, .fps = {25, 1}});
  for (int k = 0; k < 5; ++k) writer.write(Image(64, 36));
  writer.finish();
  ASSERT_EQ(gallery(folder).status, 0);
  EXPECT_THAT(page(folder), HasSubstr("This film remembers no scene"));
  EXPECT_THAT(page(folder), Not(HasSubstr("<summary>Audit")));
}

TEST(Gallery, TellsWhatItCannotShow) {
  const TemporaryFolder folder;
  const ProgramResult empty = gallery(folder);
  EXPECT_EQ(empty.status, 3);
  EXPECT_THAT(empty.err, HasSubstr("there is no film"));
  folder.write("broken.mp4", "not a film");
  const std::string cut = read_whole_file(render(folder, "whole.mp4"));
  folder.write("cut.mp4", cut.substr(0, 400));
  const ProgramResult broken = gallery(folder);
  EXPECT_EQ(broken.status, 3);
  EXPECT_THAT(broken.err, HasSubstr("broken.mp4: is no film that can be read"));
  EXPECT_THAT(broken.err, HasSubstr("cut.mp4: "));
  EXPECT_THAT(broken.err, HasSubstr("render it again"));
  EXPECT_FALSE(fs::exists(folder.file("out/index.html")));
  EXPECT_EQ(run_program({"gallery", folder.file("none")}).status, 3);
  EXPECT_EQ(run_program({"gallery", "README.md"}).status, 3);
  EXPECT_EQ(run_program({"gallery", folder.file("whole.mp4"), "-o", folder.file("page.pdf")}).status, 2);
  // Nothing outside `out` is overwritten unasked.
  const std::string mine = folder.write("mine.html", "mine");
  EXPECT_EQ(run_program({"gallery", folder.file("whole.mp4"), "-o", mine}).status, 6);
  EXPECT_EQ(read_whole_file(mine), "mine");
}

// A browser shows a film of another kind than its name's not at all, half a moving picture without a word.
TEST(Gallery, RefusesFilmsThatAreNotWhatTheirNamesSayAndHalves) {
  const TemporaryFolder folder;
  const std::string gif = read_whole_file(render(folder, "a.gif")), apng = read_whole_file(render(folder, "b.apng"));
  ASSERT_EQ(gallery(folder).status, 0);
  const auto refused = [&](const std::string& name, const std::string& bytes) {
    const std::string file = folder.write(name, bytes);
    const ProgramResult result = run_program({"gallery", file, "-o", folder.file("page.html")});
    EXPECT_EQ(result.status, 3) << name;
    EXPECT_FALSE(fs::exists(folder.file("page.html")));
    fs::remove(file);
    return result.err;
  };
  EXPECT_THAT(refused("c.gif", read_whole_file(render(folder, "a.mp4"))), HasSubstr("is named .gif but holds mov,mp4"));
  EXPECT_THAT(refused("c.apng", gif), HasSubstr("is named .apng but holds gif"));
  EXPECT_THAT(refused("c.webm", apng), HasSubstr("is named .webm but holds apng"));
  EXPECT_THAT(refused("c.gif", gif.substr(0, gif.size() - 1)), HasSubstr("was cut short"));
  EXPECT_THAT(refused("c.apng", apng.substr(0, apng.size() - 400)), HasSubstr("was cut short"));
  const std::string huge = folder.write("d.gif", gif);
  fs::resize_file(huge, 3'000'000'000);  // takes no room on the disk
  const ProgramResult result = gallery(folder);
  EXPECT_EQ(result.status, 3);
  EXPECT_THAT(result.err, HasSubstr("has 3000 MB, of which a page holds 300 at most"));
}

TEST(FilmStart, IsTheFirstFrameAsAnotherReaderSeesIt) {
  const TemporaryFolder folder;
  const std::string file = render(folder, "a.mp4");
  const FilmStart start = read_film_start(file, 4096);
  const VideoFacts facts = probe_video(file);
  EXPECT_EQ(start.width, 160);
  EXPECT_EQ(start.height, 90);
  EXPECT_NEAR(start.seconds, 0.2, 1e-6);
  // Two settings of one scaler: chroma is spread by other weights.
  EXPECT_LT(compare_pictures(start.frame, facts.first).mean, 1);
  EXPECT_GT(compare_pictures(start.frame, facts.last).mean, compare_pictures(start.frame, facts.first).mean);
  const FilmStart small = read_film_start(file, 80);
  EXPECT_EQ(small.frame.width, 80);
  EXPECT_EQ(small.frame.height, 45);
}

TEST(FilmStart, IsTheFrameThatIsShownAtAnInstant) {
  const TemporaryFolder folder;
  const std::string file = render(folder, "a.mp4");  // twelve frames
  const VideoFacts facts = probe_video(file);
  EXPECT_LT(compare_pictures(read_film_start(file, 4096, 11.0 / 60).frame, facts.last).mean, 1);
  EXPECT_LT(compare_pictures(read_film_start(file, 4096, 99).frame, facts.last).mean, 1) << "behind the end: the last";
  EXPECT_EQ(read_film_start(file, 4096, 0.008).frame.bgra, read_film_start(file, 4096).frame.bgra);
}

TEST(GalleryPoster, IsTheLastEventOrTwoFifthsOfTheFilm) {
  EXPECT_DOUBLE_EQ(poster_time(Json(), 10), 4);
  EXPECT_DOUBLE_EQ(poster_time(Json::object(), 10), 4);
  Json audit{{"frames", 600}, {"events", {{{"t", 1.5}}, {{"t", 3}}}}};
  EXPECT_DOUBLE_EQ(poster_time(audit, 10), 3);
  audit["held_frames"] = {{"first", 60}, {"last", 0}};
  EXPECT_DOUBLE_EQ(poster_time(audit, 10), 4) << "the first frame is held for a second";
  // From 2 s on four times slower, until 2.5 s, which the film reaches 3 s + 2 s later.
  audit["slow_motion"] = {{{"from", 2}, {"until", 2.5}, {"speed", 0.25}, {"film_from", 3}, {"film_until", 5}}};
  EXPECT_DOUBLE_EQ(poster_time(audit, 10), 5.5);
  audit["slow_motion"][0]["ease"] = nullptr;  // of the scene's own: as audits have it
  EXPECT_DOUBLE_EQ(poster_time(audit, 10), 5.5);
  audit["events"] = {{{"t", 2.25}}};
  EXPECT_DOUBLE_EQ(poster_time(audit, 10), 4);
  EXPECT_DOUBLE_EQ(poster_time({{"panels", {{{"events", {{{"t", 2}}}}}, Json::object()}}}, 10), 2);
  EXPECT_DOUBLE_EQ(poster_time({{"events", {{{"t", 50}}}}}, 10), 4) << "not in the film";
  EXPECT_DOUBLE_EQ(poster_time({{"events", "none"}}, 10), 4);
}

TEST(GalleryPoster, IsWhereTheFilmFirstStandsStill) {
  Json audit{{"frames", 600}, {"events", Json::array()}, {"pauses", {{{"at", 4}, {"seconds", 2}, {"film_from", 6}}, {{"at", 2}, {"seconds", 1}, {"film_from", 3}}}}};
  EXPECT_DOUBLE_EQ(poster_time(audit, 10), 3.5);
  EXPECT_DOUBLE_EQ(poster_time(audit, 3), 0.4 * 3) << "not in the film";
  audit["events"] = {{{"t", 1.5}}};
  EXPECT_DOUBLE_EQ(poster_time(audit, 10), 1.5) << "an event comes first";
}

// On an empty page the button is in the middle; beside words there it is where they are not.
TEST(GalleryPoster, ItsButtonCoversNoWords) {
  Image poster(320, 180);
  std::fill(poster.bgra.begin(), poster.bgra.end(), std::uint8_t(255));
  const Point middle = button_place(poster);
  EXPECT_DOUBLE_EQ(middle.x, 0.5);
  EXPECT_DOUBLE_EQ(middle.y, 0.5);
  for (int y = 84; y < 96; ++y)
    for (int x = 100; x < 220; ++x)
      for (int k = 0; k < 3; ++k) poster.bgra[std::size_t(4 * (320 * y + x) + k)] = 0;
  const Point beside = button_place(poster);
  const double radius = 1.25 / 25 * 320;  // 1.25 rem of a card of 25
  EXPECT_GT(std::abs(beside.y - 0.5) * 180, 6 + radius);
  EXPECT_LT(std::abs(beside.y - 0.5), 0.16);
}

TEST(GalleryAudit, PutsRunsSideBySideAndEnduresStrangeKinds) {
  const Json audit{
      {"duration", 3},
      {"frames", 180},
      {"panels",
       {{{"title", "A"}, {"method", "rk4"}, {"energy_error", 1.25e-9}, {"largest_kinetic_energy", 20}},
        {{"title", "B"}, {"method", 5}, {"events", "none"}, {"steps", "many"}}}}};
  const std::vector<AuditRow> rows = audit_rows(audit);
  ASSERT_GE(rows.size(), 3u);
  EXPECT_EQ(rows[0].values, (std::vector<std::string>{"A", "B"}));
  EXPECT_EQ(rows[1].name, "Energy error");
  EXPECT_THAT(rows[1].values[0], HasSubstr("e-09 J (kinetic energy up to 20"));
  EXPECT_EQ(rows[1].values[1], "");
  EXPECT_EQ(audit_rows({{"method", "semi_implicit_euler"}})[0].values[0], "semi-implicit Euler") << "as pictures name it";
  EXPECT_EQ(audit_facts(audit, 3), "2 panels \u00B7 3.00 s \u00B7 180 frames \u00B7 energy errors 1.3e-09 J, unknown");
  EXPECT_EQ(audit_facts(Json(), 3), "3.00 s");
}

TEST(PageTemplate, FillsAndEscapes) {
  EXPECT_EQ(
      filled_page("<p title=\"{{a}}\">{{b}}</p>", {{"a", plain("\"x\" < & >\x01")}, {"b", markup("<b>")}}),
      "<p title=\"&quot;x&quot; &lt; &amp; &gt; \"><b></p>");
  EXPECT_THROW(filled_page("{{unknown}}", {}), std::logic_error);
  EXPECT_THROW(embedded_page("unknown.html"), std::logic_error);
}

}  // namespace
}  // namespace chainreel
