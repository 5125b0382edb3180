// `chainreel check --today`: whether films, pictures and tables are what their scenes show now, and what makes them again.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <map>

#include "app/library/scene_run.hpp"
#include "core/json.hpp"
#include "encode/png.hpp"
#include "model/read_chain.hpp"
#include "support/own_model.hpp"
#include "support/run_program.hpp"
#include "support/temporary_folder.hpp"

namespace chainreel {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

// What a film shows is asked of its scene as it is now.
TEST(FilmOfToday, IsWhatItsSceneShowsUntilSceneOrModelChange) {
  const TemporaryFolder folder;
  const std::string urdf = folder.write("rr.urdf", own_model());
  const std::string scene = folder.write("s.yaml", "model: rr.urdf\nstart: {q: [1, 0]}\nduration: 0.2\nmethod: rk4\nvideo: {width: 160, height: 90}\n");
  const std::string film = folder.file("s.mp4"), still = folder.file("s.png"), drawing = folder.file("s.svg"), snapshot = folder.file("t.png");
  ASSERT_EQ(run_program({"render", scene, "--quiet", "-o", film, "-o", still, "-o", drawing, "--at", "0.1"}).status, 0);
  ASSERT_EQ(run_program({"snapshot", scene, "--quiet", "--at", "0.123", "-o", snapshot}).status, 0);
  const auto asked = [&](const std::string& file, const std::vector<std::string>& more = {}) {
    std::vector<std::string> words{"check", file, "--scene", scene, "--json"};
    words.insert(words.end(), more.begin(), more.end());
    return run_program(words);
  };
  for (const std::string& file : {film, still, drawing, snapshot}) {
    const ProgramResult same = asked(file);
    EXPECT_EQ(same.status, 0) << file << same.out << same.err;
    EXPECT_EQ(Json::parse(same.out)["films"][0]["is_same"], true);
    for (const char* change : {"start.q.2=0.1", "step=0.0005", "theme=dark", "title=T", "end_effector=link1", "video.crf=20"})
      EXPECT_EQ(asked(file, {"--set", change}).status, 1) << file << " " << change;
  }
  EXPECT_THAT(asked(film, {"--set", "gravity.2=-1.62"}).out, HasSubstr("gravity.2 -9.81 -> -1.62"));
  const std::string before = read_whole_file(urdf);
  folder.write("rr.urdf", heavier(before));
  const ProgramResult stale = asked(film);
  EXPECT_EQ(stale.status, 1);
  EXPECT_THAT(stale.out, HasSubstr("link link1: mass "));
  EXPECT_THAT(stale.err, HasSubstr("make it again, `chainreel render "));
  folder.write("rr.urdf", before);
  EXPECT_EQ(asked(film).status, 0);
  EXPECT_EQ(run_program({"check", scene, "--scene", scene}).status, 2);
  ASSERT_EQ(run_program({"chart", scene, "--methods", "rk4,verlet", "-o", folder.file("e.png"), "--quiet"}).status, 0);
  EXPECT_THAT(asked(folder.file("e.png")).err, HasSubstr("is a figure that does not remember")) << "it measures";
}

// Of a sequence the first frame is asked for all: further ones are told where they are gone or were replaced.
TEST(FilmOfToday, OfASequenceEachFrameIsLookedAt) {
  const TemporaryFolder folder;
  folder.write("rr.urdf", own_model());
  const std::string scene = folder.write("s.yaml", "model: rr.urdf\nstart: {q: [1, 0]}\nduration: 0.5\nmethod: rk4\nvideo: {width: 160, height: 90, fps: 10}\n");
  ASSERT_EQ(run_program({"render", scene, "--quiet", "-o", folder.file("out/f_000000.png")}).status, 0);
  const auto asked = [&] { return run_program({"check", folder.file("out"), "--today"}); };
  const ProgramResult same = asked();
  EXPECT_EQ(same.status, 0) << same.out << same.err;
  EXPECT_THAT(same.out + same.err, Not(HasSubstr("not asked about")));
  const std::string third = read_whole_file(folder.file("out/f_000003.png"));
  folder.write("out/f_000003.png", read_whole_file(folder.file("out/f_000001.png")));
  const ProgramResult replaced = asked();
  EXPECT_EQ(replaced.status, 1);
  EXPECT_THAT(replaced.out, HasSubstr("f_000003.png is not as it was written"));
  fs::remove(folder.file("out/f_000003.png"));
  const ProgramResult gone = asked();
  EXPECT_EQ(gone.status, 1);
  EXPECT_THAT(gone.out, HasSubstr("f_000003.png is gone"));
  EXPECT_EQ(run_program({"check", folder.file("out/f.json")}).status, 1);
  folder.write("out/f_000003.png", third);
  EXPECT_EQ(asked().status, 0);
  EXPECT_EQ(run_program({"check", folder.file("out/f.json")}).status, 0);
}

// Two sequences in one folder have an audit each; of one made in parts frames are missed; files that are merely named like frames are nobody's business.
TEST(FilmOfToday, SequencesBesideOthersAndInParts) {
  const TemporaryFolder folder;
  folder.write("rr.urdf", own_model());
  const std::string scene = folder.write("s.yaml", "model: rr.urdf\nstart: {q: [1, 0]}\nduration: 6\nmethod: rk4\nslow_motion: none\nvideo: {width: 160, height: 90, fps: 10}\n");
  folder.write("out/a_000500.png", "a holiday");
  const ProgramResult both = run_program({"render", scene, "--set", "duration=0.5", "-o", folder.file("out/a_000000.png"), "-o", folder.file("out/b_000000.png")});
  ASSERT_EQ(both.status, 0) << both.err;
  EXPECT_THAT(both.err, HasSubstr("a_000500.png is left"));
  EXPECT_EQ(read_whole_file(folder.file("out/a_000500.png")), "a holiday");
  fs::remove(folder.file("out/a_000500.png"));
  const auto asked = [&](const char* where) { return run_program({"check", folder.file(where), "--today"}); };
  EXPECT_EQ(asked("out").status, 0) << asked("out").out;
  fs::remove(folder.file("out/b_000003.png"));
  EXPECT_THAT(asked("out").out, HasSubstr("b_000003.png is gone"));
  // Fewer frames: those that the audit told of go.
  ASSERT_EQ(run_program({"render", scene, "--quiet", "--set", "duration=0.3", "-o", folder.file("out/a_000000.png"), "-o", folder.file("out/b_000000.png")}).status, 0);
  EXPECT_FALSE(fs::exists(folder.file("out/a_000004.png")));
  EXPECT_EQ(asked("out").status, 0) << asked("out").out;
  for (const char* part : {"0:20", "20:60"}) ASSERT_EQ(run_program({"render", scene, "--quiet", "--frames", part, "-o", folder.file("parts/p_000000.png")}).status, 0);
  const ProgramResult whole = asked("parts");
  EXPECT_EQ(whole.status, 0) << whole.out << whole.err;
  EXPECT_THAT(whole.err, Not(HasSubstr("not asked about")));
  fs::remove(folder.file("parts/p_000022.png"));
  EXPECT_THAT(asked("parts").out, HasSubstr("p_000022.png is gone"));
}

// A still or table whose name none of several clips has is told of by the first of their audits; what is empty or cut off is not passed over.
TEST(FilmOfToday, EachFileOfACommandIsToldOf) {
  const TemporaryFolder folder;
  folder.write("rr.urdf", own_model());
  const std::string scene = folder.write("s.yaml", "model: rr.urdf\nstart: {q: [1, 0]}\nduration: 0.5\nmethod: rk4\nvideo: {width: 160, height: 90, fps: 10}\n");
  ASSERT_EQ(run_program({"render", scene, "--quiet", "--set", "duration=0.3", "-o", folder.file("out/swing.mp4"), "-o", folder.file("out/web.gif"), "-o", folder.file("out/slide.svg"),
                         "-o", folder.file("out/rows.csv")}).status, 0);
  const auto asked = [&] { return run_program({"check", folder.file("out"), "--today"}); };
  const ProgramResult same = asked();
  EXPECT_EQ(same.status, 0) << same.out << same.err;
  EXPECT_THAT(same.out, AllOf(HasSubstr("slide.svg"), HasSubstr("rows.csv"), HasSubstr("web.gif"), HasSubstr("swing.mp4")));
  folder.write("rr.urdf", heavier(own_model()));
  EXPECT_THAT(asked().out, AllOf(HasSubstr("slide.svg is NOT"), HasSubstr("rows.csv is NOT")));
  folder.write("rr.urdf", own_model());
  folder.write("out/empty.png", "");
  const ProgramResult broken = asked();
  EXPECT_EQ(broken.status, 3);
  EXPECT_THAT(broken.err, HasSubstr("empty.png: is "));
}

// Pictures without an audit: scenes of the name that they remember are looked for, models of figures, too; and what is not known is said.
TEST(FilmOfToday, FindsWhatPicturesWithoutAuditsShow) {
  const TemporaryFolder folder;
  const std::string before = read_whole_file(std::string(CHAINREEL_SOURCE_FOLDER) + "/models/rr.urdf"), mass = "<mass value=\"";
  for (const char* name : {"docs", "scenes"}) fs::create_directory(folder.file(name));
  const std::string urdf = folder.write("scenes/rr.urdf", before);
  const std::string scene = folder.write("scenes/own.yaml", "model: rr.urdf\nstart: {q: [1, 0]}\nduration: 0.2\nmethod: rk4\nvideo: {width: 160, height: 90}\n");
  ASSERT_EQ(run_program({"snapshot", scene, "--quiet", "--at", "0.1", "--set", "theme=dark", "-o", folder.file("docs/s.png"), "-o", folder.file("docs/s.svg")}).status, 0);
  ASSERT_EQ(run_program({"ellipse", urdf, "--pose", "0,1", "-o", folder.file("docs/e.png"), "--quiet"}).status, 0);
  const auto asked = [&](const std::vector<std::string>& more = {}) {
    std::vector<std::string> words{"check", folder.file("docs"), "--today"};
    words.insert(words.end(), more.begin(), more.end());
    return run_program(words);
  };
  EXPECT_EQ(asked().status, 0) << asked().err;
  EXPECT_THAT(asked().out, AllOf(HasSubstr("s.png is what "), HasSubstr("s.svg is what "), HasSubstr("e.png is what ")));
  std::string commented = before;
  commented.insert(commented.find("<robot"), "<!-- a comment\nof two lines -->\n");
  folder.write("scenes/rr.urdf", commented);
  EXPECT_EQ(asked().status, 0) << asked().out;
  std::string heavier = before;
  heavier.replace(heavier.find(mass), mass.size(), mass + "1");
  folder.write("scenes/rr.urdf", heavier);
  EXPECT_EQ(asked().status, 1);
  EXPECT_THAT(asked().err, AllOf(HasSubstr("3 files of 3 are not what their scenes show today: `chainreel check "), HasSubstr("--today --commands | sh` makes them anew")));
  EXPECT_THAT(asked().out, AllOf(HasSubstr("s.png is NOT what "), HasSubstr("s.svg is NOT what "), HasSubstr("e.png is NOT what ")));
  std::size_t named = 0;  // in each of the three, though no audit lies beside them
  for (std::size_t at = 0; (at = asked().out.find("\n  link link1: mass 1 -> 11 kg", at)) != std::string::npos; ++at) ++named;
  EXPECT_EQ(named, 3u) << asked().out;
  // All come back by the commands that are told, with what --set changed.
  const std::string commands = asked({"--commands"}).out;
  EXPECT_THAT(commands, AllOf(HasSubstr("chainreel snapshot "), HasSubstr("--at 0.1s --set theme=dark -o"), HasSubstr("chainreel ellipse "), Not(HasSubstr("#"))));
  ASSERT_EQ(run_told(commands).status, 0);
  EXPECT_EQ(asked().status, 0) << asked().out;
  // Nothing is run for which nobody knows what --set changed.
  ASSERT_EQ(run_program({"render", scene, "--quiet", "--at", "0.1", "--set", "theme=dark", "-o", folder.file("docs/r.png")}).status, 0);
  fs::remove(folder.file("docs/r.json"));
  EXPECT_THAT(asked({"--commands"}).out, HasSubstr("# what --set changed is not known, as no audit lies beside it: chainreel snapshot"));
  fs::rename(scene, folder.file("scenes/other.yaml"));
  EXPECT_THAT(asked().err, AllOf(HasSubstr("3 files are not asked about"), HasSubstr("s.png"), HasSubstr("s.svg")));
}

// A pose that has its name beside the model, and an instant that is an event's.
TEST(FilmOfToday, AsksWhereNamedPosesAndEventsAreNow) {
  const TemporaryFolder folder;
  for (const char* name : {"docs", "events"}) fs::create_directory(folder.file(name));
  const std::string urdf = folder.write("rr.urdf", own_model());
  const std::string robot = read_chain(urdf).name, joint = read_chain(urdf).coordinate_names.front();
  const auto write_poses = [&](const char* angle) {
    folder.write("rr.srdf", "<robot name=\"" + robot + "\"><group_state name=\"ready\" group=\"a\"><joint name=\"" + joint + "\" value=\"" + angle + "\"/></group_state></robot>");
  };
  write_poses("0.5");
  ASSERT_EQ(run_program({"snapshot", urdf, "--pose", "ready", "-o", folder.file("docs/a.png"), "--quiet"}).status, 0);
  ASSERT_EQ(run_program({"ellipse", urdf, "--pose", "ready", "--pose", "0,1", "-o", folder.file("docs/b.png"), "--quiet"}).status, 0);
  const auto asked = [&](const char* docs, const std::vector<std::string>& more = {}) {
    std::vector<std::string> words{"check", folder.file(docs), "--today"};
    words.insert(words.end(), more.begin(), more.end());
    return run_program(words);
  };
  EXPECT_EQ(asked("docs").status, 0) << asked("docs").out;
  write_poses("0.75");
  EXPECT_EQ(asked("docs").status, 1);
  EXPECT_THAT(asked("docs").out, AllOf(HasSubstr("a.png is NOT what "), HasSubstr("b.png is NOT what "), HasSubstr("pose ready: " + joint + "=0.5 -> " + joint + "=0.75")));

  const std::string page = "model: rr.urdf\nduration: 1\nmethod: rk4\nevents: [{when: \"q1 < -0.3\", name: low}]\nvideo: {width: 160, height: 90}\n";
  const std::string scene = folder.write("a.yaml", page + "start: {q: [0, 0]}\n"), low = folder.file("events/low.png");
  const auto show = [&](const std::string& path) { return run_program({"snapshot", scene, "--at", "event low", "--quiet", "-o", path}).status; };
  ASSERT_EQ(show(low), 0);
  EXPECT_EQ(asked("events").status, 0) << asked("events").out;
  folder.write("a.yaml", page + "start: {q: [0.4, 0]}\n");
  EXPECT_EQ(asked("events").status, 1);
  ASSERT_EQ(run_told(asked("events", {"--commands"}).out).status, 0);
  EXPECT_EQ(asked("events").status, 0) << asked("events").out;
  ASSERT_EQ(show(folder.file("now.png")), 0);
  EXPECT_TRUE(read_png(low).bgra == read_png(folder.file("now.png")).bgra);
}

// Sizes that a command line gives are remembered: of a slide, and of paper.
TEST(FilmOfToday, KnowsTheSizeThatAPictureWasAskedFor) {
  const TemporaryFolder folder;
  const std::string scene = folder.write("a.yaml", "model: " CHAINREEL_SOURCE_FOLDER "/models/rr.urdf\nstart: {q: [1, 0]}\nduration: 0.2\nmethod: rk4\n");
  fs::create_directory(folder.file("docs"));
  ASSERT_EQ(run_program({"snapshot", scene, "--at", "0.1", "--width", "320", "--height", "180", "-o", folder.file("docs/a.png"), "--quiet"}).status, 0);
  ASSERT_EQ(run_program({"snapshot", scene, "--at", "0.1", "--width-mm", "84", "--dpi", "100", "-o", folder.file("docs/b.png"), "-o", folder.file("docs/c.pdf"), "--quiet"}).status, 0);
  const auto asked = [&](const std::vector<std::string>& more = {}) {
    std::vector<std::string> words{"check", folder.file("docs"), "--today"};
    words.insert(words.end(), more.begin(), more.end());
    return run_program(words);
  };
  EXPECT_EQ(asked().status, 0) << asked().out << asked().err;
  EXPECT_THAT(asked().out, AllOf(HasSubstr("a.png is what "), HasSubstr("b.png is what "), HasSubstr("c.pdf is what ")));
  folder.write("a.yaml", read_whole_file(scene) + "title: T\n");
  EXPECT_EQ(asked().status, 1);
  ASSERT_EQ(run_told(asked({"--commands"}).out).status, 0) << asked({"--commands"}).out;
  EXPECT_EQ(asked().status, 0) << asked().out;
  EXPECT_EQ(read_png(folder.file("docs/a.png")).width, 320);
  EXPECT_EQ(read_png(folder.file("docs/b.png")).width, 331) << "84 mm at 100 dpi";
}

// What is gone comes back as it was: a picture with its instant, a film with its words.
TEST(FilmOfToday, BringsBackPicturesOfTheirInstantsAndTexts) {
  const TemporaryFolder folder;
  const std::string scene = folder.write("a.yaml", "model: " CHAINREEL_SOURCE_FOLDER "/models/rr.urdf\nstart: {q: [1, 0]}\nduration: 0.2\nmethod: rk4\nvideo: {width: 160, height: 90}\n");
  ASSERT_EQ(run_program({"render", scene, "--quiet", "--at", "0.1", "-o", folder.file("docs/s.png"), "-o", folder.file("docs/s.gif")}).status, 0);
  const std::string picture = read_whole_file(folder.file("docs/s.png"));
  const auto asked = [&] { return run_program({"check", folder.file("docs"), "--today"}); };
  const auto make_anew = [&] {
    EXPECT_EQ(run_told(run_program({"check", folder.file("docs"), "--today", "--commands"}).out).status, 0);
  };
  fs::remove(folder.file("docs/s.png"));
  EXPECT_THAT(asked().out, HasSubstr("s.png is gone"));
  make_anew();
  EXPECT_EQ(read_whole_file(folder.file("docs/s.png")), picture);
  fs::remove(folder.file("docs/s.txt"));
  EXPECT_EQ(asked().status, 1);
  EXPECT_THAT(asked().out, HasSubstr("s.txt is gone"));
  make_anew();
  EXPECT_EQ(asked().status, 0) << asked().out;
}

// A folder of films is asked as a whole: each finds its own scene and the changes that it was made with.
TEST(FilmOfToday, OfAFolderFindsItsScenesAndNamesWhatChanged) {
  const TemporaryFolder folder;
  for (const char* name : {"docs", "scenes"}) fs::create_directory(folder.file(name));
  const std::string before = read_whole_file(std::string(CHAINREEL_SOURCE_FOLDER) + "/models/rr.urdf");
  folder.write("scenes/rr.urdf", before);
  const std::string page = "model: rr.urdf\nstart: {q: [1, 0]}\nduration: 0.1\nmethod: rk4\nvideo: {width: 160, height: 90}\n";
  const std::string a = folder.write("scenes/a.yaml", page), b = folder.write("scenes/b.yaml", page + "compare: [{step: 0.01}, {step: 0.02}]\n");
  ASSERT_EQ(run_program({"render", a, "--quiet", "-o", folder.file("docs/a.mp4")}).status, 0);
  ASSERT_EQ(run_program({"render", b, "--quiet", "-o", folder.file("docs/b.webm"), "--set", "duration=0.08", "--theme", "dark"}).status, 0);
  const auto asked = [&] { return run_program({"check", folder.file("docs"), "--today"}); };
  const ProgramResult same = asked();
  EXPECT_EQ(same.status, 0) << same.out << same.err;
  EXPECT_THAT(same.out, AllOf(HasSubstr("a.mp4 is what "), HasSubstr("b.webm is what ")));
  // A comment changes nothing; a mass is named where the audit beside the film knows it; one film may change alone.
  std::string text = before;
  text.insert(text.find("<robot"), "<!-- a line more -->\n");
  folder.write("scenes/rr.urdf", text);
  EXPECT_EQ(asked().status, 0) << asked().out;
  const std::string mass = "<mass value=\"";
  text.replace(text.find(mass), mass.size(), mass + "1");
  folder.write("scenes/rr.urdf", text);
  const ProgramResult stale = asked();
  EXPECT_EQ(stale.status, 1);
  EXPECT_THAT(stale.out, HasSubstr("link link1: mass "));
  folder.write("scenes/rr.urdf", before);
  folder.write("scenes/a.yaml", page + "title: T\n");
  const ProgramResult one = asked();
  EXPECT_EQ(one.status, 1);
  EXPECT_THAT(one.out, AllOf(HasSubstr("a.mp4 is NOT what "), HasSubstr("b.webm is what ")));
  // A film that is broken is none, whatever it remembers.
  folder.write("scenes/a.yaml", page);
  ASSERT_EQ(asked().status, 0);
  const std::string bytes = read_whole_file(folder.file("docs/a.mp4"));
  folder.write("docs/a.mp4", bytes.substr(0, bytes.size() / 2));
  EXPECT_EQ(asked().status, 1);
  EXPECT_THAT(asked().out, HasSubstr("is not as it was written"));
  folder.write("docs/a.mp4", bytes);
  // What its audit tells of and is gone is asked about, too, and the command that is told brings it back.
  fs::remove(folder.file("docs/b.webm"));
  const ProgramResult gone = asked();
  EXPECT_EQ(gone.status, 1);
  EXPECT_THAT(gone.out, HasSubstr("b.webm is gone: the audit beside it tells of it"));
  EXPECT_THAT(gone.err, AllOf(HasSubstr("1 file of 2 is not what its scene shows today"), Not(HasSubstr("b.srt"))));
  EXPECT_TRUE(Json::parse(run_program({"check", folder.file("docs"), "--today", "--json"}).out)["films"][1]["is_gone"]);
  ASSERT_EQ(run_told(run_program({"check", folder.file("docs"), "--today", "--commands"}).out).status, 0);
  EXPECT_EQ(asked().status, 0) << asked().out;
  // What cannot be told is no yes: another scene of that name is another one, and without an audit nothing tells where the scene lies.
  fs::rename(folder.file("scenes/a.yaml"), folder.file("a.yaml"));
  EXPECT_EQ(asked().status, 3);
  EXPECT_THAT(asked().err, HasSubstr("is not there any more: name it, --scene"));
  fs::rename(folder.file("a.yaml"), folder.file("scenes/a.yaml"));
  fs::remove(folder.file("docs/a.json"));
  EXPECT_THAT(asked().out, HasSubstr("a.mp4 is what ")) << "found by the name that it remembers";
  fs::rename(folder.file("scenes/a.yaml"), folder.file("scenes/c.yaml"));
  EXPECT_THAT(asked().err, AllOf(HasSubstr("1 file is not asked about"), HasSubstr("a.mp4")));
  EXPECT_EQ(run_program({"check", folder.file("docs/a.mp4"), "--today"}).status, 3);
  fs::rename(folder.file("scenes/c.yaml"), folder.file("scenes/a.yaml"));
  EXPECT_EQ(run_program({"check", folder.file("docs/a.mp4"), "--scene", a}).status, 0);
  EXPECT_EQ(run_program({"check", folder.file("docs")}).status, 2);
  EXPECT_EQ(run_program({"check", folder.file("scenes"), "--today"}).status, 3);
}

// What is stale is made anew as it was made, and nothing else is: with the --set of its own, in the same words as before.
TEST(FilmOfToday, TellsTheCommandsThatMakeItAnew) {
  const TemporaryFolder folder;
  const std::string page = "model: " CHAINREEL_SOURCE_FOLDER "/models/rr.urdf\nduration: 0.3\nmethod: rk4\nvideo: {width: 160, height: 90}\n";
  const std::string scene = folder.write("it's a scene.yaml", page), film = folder.file("docs/a film.mp4"), still = folder.file("docs/still.png");
  const auto make = [&](const std::string& at) {
    EXPECT_EQ(run_program({"render", scene, "--quiet", "--force", "-o", at, "--set", "duration=0.1", "--theme", "dark"}).status, 0);
  };
  make(film);
  ASSERT_EQ(run_program({"render", scene, "--quiet", "-o", folder.file("docs/b.mp4")}).status, 0);
  ASSERT_EQ(run_program({"render", scene, "--at", "0.15", "--quiet", "-o", still}).status, 0);
  const auto commands = [&] { return run_program({"check", folder.file("docs"), "--today", "--commands"}); };
  EXPECT_EQ(commands().status, 0);
  EXPECT_EQ(commands().out, "");
  folder.write("it's a scene.yaml", page + "title: Another\n");
  const ProgramResult stale = commands();
  EXPECT_EQ(stale.status, 1);
  EXPECT_EQ(std::count(stale.out.begin(), stale.out.end(), '\n'), 3);
  const Json json = Json::parse(run_program({"check", film, "--today", "--json"}).out);
  ASSERT_EQ(json["films"].size(), 1u) << "of one film as of several";
  EXPECT_THAT(json["films"][0]["set"].dump(), HasSubstr("duration=0.1"));
  EXPECT_EQ(json["films"][0]["command"][0], "chainreel");
  ASSERT_EQ(run_told(stale.out).status, 0) << stale.out;
  EXPECT_EQ(commands().status, 0) << commands().err;
  make(folder.file("wanted.mp4"));
  EXPECT_TRUE(read_whole_file(film) == read_whole_file(folder.file("wanted.mp4")));
  // What was written beside a film of another name is told of by that one's audit.
  ASSERT_EQ(run_program({"render", scene, "--quiet", "-o", folder.file("two/c.gif"), "-o", folder.file("two/poster.png")}).status, 0);
  EXPECT_EQ(run_program({"check", folder.file("two/poster.png"), "--today"}).status, 0);
  folder.write("it's a scene.yaml", page + "title: A third\n");
  const std::string both = run_program({"check", folder.file("two"), "--today", "--commands"}).out;
  EXPECT_EQ(std::ranges::count(both, '\n'), 1) << "one command made both";
  EXPECT_THAT(both, AllOf(HasSubstr("-o " + folder.file("two/c.gif")), HasSubstr("-o " + folder.file("two/poster.png"))));
  ASSERT_EQ(run_told(both).status, 0) << both;
  EXPECT_EQ(run_program({"check", folder.file("two"), "--today", "--commands"}).status, 0);
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(folder.file("two"))) names.push_back(entry.path().filename().string());
  EXPECT_THAT(names, testing::UnorderedElementsAre("c.gif", "c.json", "c.txt", "poster.png"));
  EXPECT_EQ(run_program({"check", film, "--commands"}).status, 2);
  EXPECT_EQ(run_program({"check", film, "--today", "--commands", "--json"}).status, 2);
}

// A film in a folder of the folder, whose torques stand in a table; and a scene that cannot be read any more.
TEST(FilmOfToday, NamesTheTableAndTheFilmsOfABrokenScene) {
  const TemporaryFolder folder;
  const std::string page = "model: " CHAINREEL_SOURCE_FOLDER "/models/rr.urdf\nduration: 0.1\nmethod: rk4\nvideo: {width: 160, height: 90}\n";
  const auto write_table = [&](const char* last) { folder.write("tau.csv", std::string("t,tau1,tau2\n0,1,0\n0.1,") + last + ",0\n"); };
  write_table("2");
  const std::string a = folder.write("a.yaml", page + "torque: {csv: tau.csv}\n"), b = folder.write("b.yaml", page);
  ASSERT_EQ(run_program({"render", a, "--quiet", "-o", folder.file("docs/deep/a.mp4")}).status, 0);
  ASSERT_EQ(run_program({"render", b, "--quiet", "-o", folder.file("docs/b.mp4")}).status, 0);
  const auto asked = [&] { return run_program({"check", folder.file("docs"), "--today"}); };
  EXPECT_EQ(asked().status, 0) << asked().out << asked().err;
  EXPECT_THAT(asked().out, AllOf(HasSubstr("deep/a.mp4 is what "), HasSubstr("b.mp4 is what ")));
  write_table("2.5");
  EXPECT_EQ(asked().status, 1);
  EXPECT_THAT(asked().out, AllOf(HasSubstr("torque: the numbers in table tau.csv differ"), HasSubstr("b.mp4 is what ")));
  folder.write("b.yaml", page + "foo: 1\n");
  const ProgramResult broken = asked();
  EXPECT_EQ(broken.status, 3);
  EXPECT_THAT(broken.out, HasSubstr("b.mp4: it cannot be told"));
  EXPECT_THAT(broken.err, AllOf(HasSubstr("unknown key 'foo'"), HasSubstr("docs/b.mp4 shows it"), HasSubstr("1 file of 2 is not what ")));
}

// Tables of `render`, which remember nothing, are made again; those that nothing tells of are named.
TEST(FilmOfToday, AsksTablesToo) {
  const TemporaryFolder folder;
  const std::string model = read_whole_file(std::string(CHAINREEL_SOURCE_FOLDER) + "/models/rr.urdf");
  folder.write("rr.urdf", model);
  const std::string scene = folder.write("a.yaml", "model: rr.urdf\nstart: {q: [1, 0]}\nduration: 0.1\nmethod: rk4\n");
  for (const char* table : {"a.csv", "b.npz"})
    ASSERT_EQ(run_program({"render", scene, "--quiet", "-o", folder.file("docs/" + std::string(table)), "--set", "duration=0.2"}).status, 0);
  folder.write("docs/c.csv", "t [s],q1 [rad]\n0,0\n");
  const auto asked = [&] { return run_program({"check", folder.file("docs"), "--today"}); };
  const ProgramResult same = asked();
  EXPECT_EQ(same.status, 0) << same.err;
  EXPECT_THAT(same.out, AllOf(HasSubstr("a.csv is what "), HasSubstr("b.npz is what ")));
  EXPECT_THAT(same.err, HasSubstr("1 file is not asked about, as no audit beside it tells the scene: " + folder.file("docs/c.csv")));
  std::string heavier = model;
  const std::string mass = "<mass value=\"";
  // Which command made it nobody knows.
  EXPECT_EQ(run_program({"check", folder.file("docs/c.csv"), "--today", "--scene", scene}).status, 3);
  heavier.replace(heavier.find(mass), mass.size(), mass + "1");
  folder.write("rr.urdf", heavier);
  const ProgramResult stale = asked();
  EXPECT_EQ(stale.status, 1);
  EXPECT_THAT(stale.out, AllOf(HasSubstr("a.csv is NOT what "), HasSubstr("link link1: mass "), HasSubstr("its numbers are others")));
  EXPECT_THAT(run_program({"check", folder.file("docs"), "--today", "--commands"}).out,
              HasSubstr("--set duration=0.2 -o " + folder.file("docs/a.csv") + " --force"));
  folder.write("rr.urdf", model);
  EXPECT_EQ(run_program({"check", folder.file("docs/a.csv"), "--today"}).status, 0);
  // Those of a page's panels are made anew by one command, into the same files.
  ASSERT_EQ(run_program({"render", scene, "--quiet", "-o", folder.file("v/f.csv"), "--vary", "start.q.1=0,1"}).status, 0);
  EXPECT_EQ(run_program({"check", folder.file("v"), "--today"}).status, 0);
  folder.write("rr.urdf", heavier);
  const std::string command = run_program({"check", folder.file("v"), "--today", "--commands"}).out;
  EXPECT_EQ(std::ranges::count(command, '\n'), 1);
  EXPECT_THAT(command, HasSubstr("-o " + folder.file("v/f.csv") + " --force"));
  ASSERT_EQ(run_told(command).status, 0);
  EXPECT_EQ(run_program({"check", folder.file("v"), "--today"}).status, 0);
  EXPECT_FALSE(fs::exists(folder.file("v/f.1.1.csv")));
  fs::remove(folder.file("v/f.2.csv"));
  EXPECT_THAT(run_program({"check", folder.file("v"), "--today", "--commands"}).out, HasSubstr("-o " + folder.file("v/f.csv") + " --force"));
  folder.write("rr.urdf", model);
  folder.write("docs/a.csv", read_whole_file(folder.file("docs/a.csv")) + "0\n");
  EXPECT_EQ(run_program({"check", folder.file("docs/a.csv"), "--today"}).status, 1);
}

// Tables of a command by itself have a record beside them; figures remember what the files of their commands said.
TEST(FilmOfToday, AsksTablesOfSimulateAndFiguresOfScenes) {
  const TemporaryFolder folder;
  const std::string model = read_whole_file(std::string(CHAINREEL_SOURCE_FOLDER) + "/models/rr.urdf"), mass = "<mass value=\"";
  folder.write("rr.urdf", model);
  const std::string page = "model: rr.urdf\nstart: {q: [1, 0]}\nmethod: rk4\n";
  const std::string scene = folder.write("own.yaml", page + "duration: 0.1\n");
  const auto made = [&](Words words, const std::string& output) {
    words.insert(words.end(), {"--quiet", "-o", folder.file("docs/" + output)});
    EXPECT_EQ(run_program(words).status, 0) << output;
  };
  made({"simulate", scene, "--set", "duration=0.2", "--columns", "t,q", "--every", "10ms"}, "t.csv");
  made({"simulate", scene}, "u.npz");  folder.write("q.csv", "t,q1,q2\n0,0,0\n0.1,0.1,0\n0.2,0.3,0\n");
  made({"inverse", folder.file("rr.urdf"), "--trajectory", folder.file("q.csv")}, "tau.csv");
  made({"ellipse", "--along", scene}, "e.svg");
  made({"sheet", scene, "--at", "0.1"}, "s.png");
  made({"energy", scene, "--methods", "rk4,verlet"}, "n.png");
  made({"sweep", scene, "--over", "start.q.1=0:1:3", "--over", "start.q.2=0:1:2", "--peaks", "qd"}, "g.csv");
  made({"simulate", scene, "--set", "compare=[{start: {q: [0, 0]}}, {start: {q: [1, 0]}}]"}, "v.csv");
  const auto asked = [&](const Words& more = {}) {
    Words words{"check", folder.file("docs"), "--today"};
    words.insert(words.end(), more.begin(), more.end());
    return run_program(words);
  };
  const std::vector<std::string> all{"e.svg", "g.csv", "n.png", "s.png", "t.csv", "tau.csv", "u.npz", "v.1.csv", "v.2.csv"};
  const ProgramResult same = asked();
  EXPECT_EQ(same.status, 0) << same.out << same.err;
  for (const std::string& file : all) EXPECT_THAT(same.out, HasSubstr("docs/" + file + " is what "));
  EXPECT_EQ(run_program({"check", folder.file("docs/t.csv")}).status, 0) << "as it was written";
  std::map<std::string, std::string> before;
  for (const std::string& file : all) before[file] = read_whole_file(folder.file("docs/" + file));

  std::string heavier = model;
  heavier.replace(heavier.find(mass), mass.size(), mass + "1");
  folder.write("rr.urdf", heavier);
  const ProgramResult stale = asked();
  EXPECT_EQ(stale.status, 1);
  for (const std::string& file : all) EXPECT_THAT(stale.out, HasSubstr("docs/" + file + " is NOT what "));
  EXPECT_EQ(std::ranges::count(asked({"--commands"}).out, '\n'), 8) << "one for both panels";
  EXPECT_THAT(stale.out, HasSubstr("link link1: mass 1 -> 11 kg"));
  std::string commented = model;
  folder.write("rr.urdf", commented.insert(commented.find("<robot"), "<!-- a comment\nof two lines -->\n"));
  EXPECT_EQ(asked().status, 0) << asked().out;
  // What a command line changed is kept: a duration of the scene's is none of t.csv's.
  folder.write("own.yaml", page + "duration: 0.15\n");
  EXPECT_THAT(asked().out, AllOf(HasSubstr("t.csv is what "), HasSubstr("tau.csv is what "), HasSubstr("e.svg is NOT what "), HasSubstr("duration 0.1 -> 0.15")));
  folder.write("q.csv", "t,q1,q2\n0,0,0\n0.1,0.1,0\n0.2,0.4,0\n");
  EXPECT_THAT(asked().out, AllOf(HasSubstr("tau.csv is NOT what "), HasSubstr("q.csv: is another one, by its hash")));
  fs::remove(folder.file("docs/u.npz"));
  EXPECT_THAT(asked().out, HasSubstr("u.npz is gone"));
  const std::string commands = asked({"--commands"}).out;
  ASSERT_EQ(run_told(commands).status, 0) << commands;
  EXPECT_EQ(asked().status, 0) << asked().out << asked().err;
  EXPECT_TRUE(before["t.csv"] == read_whole_file(folder.file("docs/t.csv")));
  EXPECT_FALSE(before["u.npz"] == read_whole_file(folder.file("docs/u.npz")));
  folder.write("docs/t.csv", read_whole_file(folder.file("docs/t.csv")) + "9,9,9\n");
  EXPECT_THAT(asked().out, AllOf(HasSubstr("t.csv is NOT what "), HasSubstr("is not as it was written")));
  // A file of somebody else's is no record.
  folder.write("docs/w.csv.json", "{\"made_by\": \"me\"}");
  EXPECT_EQ(run_program({"simulate", scene, "--quiet", "-o", folder.file("docs/w.csv")}).status, 6);
  EXPECT_EQ(read_whole_file(folder.file("docs/w.csv.json")), "{\"made_by\": \"me\"}");
  EXPECT_FALSE(fs::exists(folder.file("docs/w.csv")));
  folder.write("docs/w.csv.json", R"({"made_by": {"arguments": ["simulate", 3], "files": [7]}, "outputs": [{"file": "w.csv", "sha256": "0"}]})");
  folder.write("docs/w.csv", "t\n");
  EXPECT_EQ(run_program({"check", folder.file("docs/w.csv"), "--today"}).status, 3);
  // .. nor may one that came from elsewhere name a file to be written.
  Json forged = Json::parse(read_whole_file(folder.file("docs/t.csv.json")));
  for (const char* word : {"-o", "--output=x.csv", "--force"}) {
    forged["made_by"]["arguments"].push_back(word);
    folder.write("docs/t.csv.json", forged.dump());
    const ProgramResult refused = run_program({"check", folder.file("docs/t.csv"), "--today", "--commands"});
    EXPECT_EQ(refused.status, 3) << word;
    EXPECT_EQ(refused.out, "");
    forged["made_by"]["arguments"].erase(forged["made_by"]["arguments"].size() - 1);
  }
}

// A torque that was the caller's function is in no file: without it the film would be replaced by one of another motion.
TEST(FilmOfToday, OfATorqueThatIsAFunctionIsRefused) {
  const TemporaryFolder folder;
  const std::string scene = folder.write("s.yaml", "model: " CHAINREEL_SOURCE_FOLDER "/models/rr.urdf\nduration: 0.1\nmethod: rk4\nvideo: {width: 160, height: 90}\n");
  SceneRequest request{.path = scene};
  request.torque = OwnTorque{.function = [](double, auto, auto, auto tau) { tau[0] = tau[1] = 3; }, .words = "the function f"};
  const SceneRun run(std::move(request));
  fs::create_directory(folder.file("docs"));
  run.film({.files = {folder.file("docs/a.mp4"), folder.file("docs/a.csv")}});
  run.picture(0.05, folder.file("docs/b.svg"));
  fs::remove(folder.file("docs/a.csv"));
  const std::string before = read_whole_file(folder.file("docs/a.mp4"));
  for (const std::vector<std::string>& asked : std::vector<std::vector<std::string>>{
           {folder.file("docs"), "--today"}, {folder.file("docs/a.mp4"), "--today"}, {folder.file("docs/a.mp4"), "--scene", scene}, {folder.file("docs/b.svg"), "--scene", scene}}) {
    std::vector<std::string> words{"check"};
    words.insert(words.end(), asked.begin(), asked.end());
    words.emplace_back("--commands");
    const ProgramResult refused = run_program(words);
    EXPECT_EQ(refused.status, 3) << asked.front();
    EXPECT_EQ(refused.out, "") << "no command that makes another film of it";
    EXPECT_THAT(refused.err, AllOf(HasSubstr("was driven by the function f, which no file holds"), HasSubstr("the program that made it")));
  }
}

}  // namespace
}  // namespace chainreel
