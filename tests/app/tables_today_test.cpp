// `chainreel check --today` of tables that commands write beside figures, of JSON, and of pictures whose pixels were changed.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "core/image.hpp"
#include "encode/png.hpp"
#include "support/own_model.hpp"
#include "support/run_program.hpp"
#include "support/temporary_folder.hpp"

namespace chainreel {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::Not;

const std::string kRoot = CHAINREEL_SOURCE_FOLDER;

// A title is in no number, nor is the value that a sweep replaces: tables stay as they are. What changes numbers is told.
TEST(TablesOfToday, AreNotStaleForWhatNoNumberTells) {
  const TemporaryFolder folder;
  const std::string body = "model: {links: [0.5, 0.5], masses: [1, 1]}\nduration: 0.3\nmethod: rk4\nevents: [{when: y_G < -0.1, kind: fall}]\n";
  folder.write("f.yaml", body + "title: A\nparameters: {k: 1}\ntorque: [k, 0]\n");
  const RunOptions there{.folder = folder.path().string()};
  const auto run = [&](const Words& words) { return run_program(words, there); };
  ASSERT_EQ(run({"simulate", "f.yaml", "-o", "out/s.csv", "--quiet"}).status, 0);
  ASSERT_EQ(run({"sweep", "f.yaml", "--over", "parameters.k=1,2", "-o", "out/w.csv", "--quiet"}).status, 0);
  ASSERT_EQ(run({"fall", "f.yaml", "--sweep", "parameters.k=1,2", "-o", "out/f.csv", "--quiet"}).status, 0);
  folder.write("f.yaml", body + "title: B\ntheme: dark\ndraw: [chain]\nparameters: {k: 1}\ntorque: [k, 0]\n");
  const ProgramResult same = run({"check", "out", "--today"});
  EXPECT_EQ(same.status, 0) << same.out;
  folder.write("f.yaml", body + "title: B\nparameters: {k: 3}\ntorque: [k, 0]\n");
  const ProgramResult other = run({"check", "out", "--today"});
  EXPECT_EQ(other.status, 1);
  EXPECT_THAT(other.out, testing::AllOf(HasSubstr("out/s.csv is NOT"), Not(HasSubstr("out/w.csv is NOT")), Not(HasSubstr("out/f.csv is NOT"))));
  folder.write("f.yaml", body + "title: B\nparameters: {k: 1}\ntorque: [k, 0.1]\n");
  const ProgramResult all = run({"check", "out", "--today"});
  EXPECT_THAT(all.out, testing::AllOf(HasSubstr("out/s.csv is NOT"), HasSubstr("out/w.csv is NOT"), HasSubstr("out/f.csv is NOT")));
}

TEST(TablesOfToday, BesideFiguresAreAskedAndMadeAgain) {
  const TemporaryFolder folder;
  const std::string own = own_model();
  folder.write("a.urdf", own);
  folder.write("f.yaml", "model: a.urdf\nduration: 0.3\nmethod: rk4\nevents: [{when: y_G < -0.1, kind: fall}]\n");
  const RunOptions there{.folder = folder.path().string()};
  const auto run = [&](const Words& words) { return run_program(words, there); };
  ASSERT_EQ(run({"ellipse", "a.urdf", "--pose", "0,90deg", "-o", "out/e.pdf", "-o", "out/e.csv", "-o", "out/e.json", "--quiet"}).status, 0);
  ASSERT_EQ(run({"fall", "f.yaml", "-o", "out/f.csv", "-o", "out/f.json", "--quiet"}).status, 0);
  ASSERT_EQ(run({"simulate", "f.yaml", "-o", "out/s.json", "-o", "out/s.csv", "--quiet"}).status, 0);
  ASSERT_EQ(run({"energy", "f.yaml", "--methods", "rk4", "-o", "out/n.json", "--quiet"}).status, 0);
  ASSERT_EQ(run({"stability", "f.yaml", "--methods", "rk4", "-o", "out/m.json", "--quiet"}).status, 0);
  const ProgramResult same = run({"check", "out", "--today"});
  EXPECT_EQ(same.status, 0) << same.out << same.err;
  for (const char* table : {"out/e.csv", "out/e.json", "out/f.csv", "out/f.json", "out/s.json", "out/n.json", "out/m.json"})
    EXPECT_THAT(same.out, HasSubstr(std::string(table) + " is what")) << table;
  EXPECT_THAT(same.err, Not(HasSubstr("not asked about"))) << same.err;

  folder.write("a.urdf", heavier(own));
  EXPECT_EQ(run({"check", "out/e.json", "--today"}).status, 1);
  const std::string before = read_whole_file(folder.file("out/e.csv")), of_json = read_whole_file(folder.file("out/e.json"));
  const ProgramResult told = run({"check", "out", "--today", "--commands"});
  EXPECT_EQ(told.status, 1);
  const ProgramResult made = run_told(told.out, folder.path().string());
  EXPECT_EQ(made.status, 0) << told.out << made.err;
  EXPECT_NE(read_whole_file(folder.file("out/e.csv")), before);
  EXPECT_NE(read_whole_file(folder.file("out/e.json")), of_json);
  const ProgramResult again = run({"check", "out", "--today"});
  EXPECT_EQ(again.status, 0) << again.out;

  // What was edited or is gone is told.
  folder.write("out/f.json", "{}\n");
  fs::remove(folder.file("out/s.json"));
  const ProgramResult changed = run({"check", "out", "--today"});
  EXPECT_EQ(changed.status, 1);
  EXPECT_THAT(changed.out, HasSubstr("out/f.json is NOT"));
  EXPECT_THAT(changed.out, HasSubstr("out/s.json is gone"));
  // A chart measures: no record lies beside its numbers.
  ASSERT_EQ(run({"chart", "f.yaml", "--methods", "rk4,verlet", "-o", "out/c.json", "--quiet"}).status, 0);
  EXPECT_FALSE(fs::exists(folder.file("out/c.json.json")));
  // No record is left of another command.
  ASSERT_EQ(run({"energy", "f.yaml", "--methods", "rk4", "-o", "out/k.csv", "--quiet"}).status, 0);
  EXPECT_TRUE(fs::exists(folder.file("out/k.csv.json")));
  ASSERT_EQ(run({"energy", "f.yaml", "--methods", "verlet", "-o", "out/k.png", "--quiet", "--force"}).status, 0);
  EXPECT_THAT(read_whole_file(folder.file("out/k.csv.json")), testing::AllOf(HasSubstr("\"verlet\""), Not(HasSubstr("\"rk4\"")))) << "of the picture's, beside which it lies";
  EXPECT_THAT(run({"check", "out/k.csv", "--today"}).out, HasSubstr("out/k.csv is what"));
}

// What was edited by hand is not replaced by a command that one pipes into a shell: a table beside a figure, or the text of an SVG.
TEST(TablesOfToday, EditedOnesBesideFiguresAndEditedDrawingsAreKept) {
  const TemporaryFolder folder;
  const std::string body = "model: {links: [0.5, 0.5], masses: [1, 1]}\nduration: 0.3\nmethod: rk4\nstep: 10ms\nparameters: {k: 4}\ntorque: [-k * q1, 0]\nstart: {q: [1, 0]}\n";
  folder.write("o.yaml", body);
  const RunOptions there{.folder = folder.path().string()};
  const auto run = [&](const Words& words) { return run_program(words, there); };
  ASSERT_EQ(run({"energy", "o.yaml", "--methods", "rk4,dop853", "-o", "out/en.png", "--quiet"}).status, 0);
  ASSERT_EQ(run({"energy", "o.yaml", "--methods", "rk4", "-o", "out/dr.svg", "--quiet"}).status, 0);
  ASSERT_EQ(run({"stability", "o.yaml", "--methods", "rk4", "--x", "step=0.02:0.4:3", "--y", "parameters.k=25:400:3", "-o", "out/st.png", "--quiet"}).status, 0);
  EXPECT_EQ(run({"check", "out", "--today"}).status, 0);
  const std::string table = read_whole_file(folder.file("out/en.csv")) + "9,9,9,my own note\n";
  std::string drawing = read_whole_file(folder.file("out/dr.svg"));
  drawing.insert(drawing.rfind("</svg>"), "<text>my label</text>");
  folder.write("out/en.csv", table);
  folder.write("out/dr.svg", drawing);
  EXPECT_THAT(run({"check", "out/dr.svg", "--today"}).out, HasSubstr("the file is not as it was written"));
  std::string other = body;
  other.replace(other.find("k: 4"), 4, "k: 5");
  folder.write("o.yaml", other);
  const ProgramResult told = run({"check", "out", "--today", "--commands"});
  EXPECT_THAT(told.out, Not(HasSubstr("st.png"))) << "k is what its map goes over";
  run_told(told.out, folder.path().string());
  EXPECT_EQ(read_whole_file(folder.file("out/en.csv")), table) << told.out;
  EXPECT_EQ(read_whole_file(folder.file("out/dr.svg")), drawing) << told.out;
}

// Another course's scene of the same name makes nobody's still: that of a folder beside the pictures' does.
TEST(PicturesOfToday, AreNotMadeAgainOfAScenesNameInAnotherCourse) {
  const TemporaryFolder folder;
  const std::string body = "model: {links: [0.5, 0.5], masses: [1, 1]}\nduration: 0.3\nmethod: rk4\nvideo: {width: 320, height: 180}\n";
  for (const char* name : {"a", "b", "c/scenes"}) fs::create_directories(folder.path() / name);
  folder.write("a/s.yaml", body);
  folder.write("c/scenes/u.yaml", body);
  const RunOptions there{.folder = folder.path().string()};
  const auto run = [&](const Words& words) { return run_program(words, there); };
  ASSERT_EQ(run({"snapshot", "a/s.yaml", "--at", "0.2", "-o", "a/out/still.png", "--quiet"}).status, 0);
  ASSERT_EQ(run({"snapshot", "c/scenes/u.yaml", "--at", "0.2", "-o", "c/out/still.png", "--quiet"}).status, 0);
  fs::remove(folder.file("a/s.yaml"));
  folder.write("b/s.yaml", body + "title: Course B\n");
  folder.write("c/scenes/u.yaml", body + "title: Of today\n");
  const ProgramResult told = run({"check", "a/out", "--today"});
  EXPECT_EQ(told.status, 1);
  EXPECT_THAT(told.out, HasSubstr("its scene was found in another folder, by the name alone"));
  EXPECT_THAT(run({"check", "a/out", "--today", "--commands"}).out, testing::StartsWith("# its scene was found in another folder"));
  EXPECT_THAT(run({"check", "c/out", "--today", "--commands"}).out, testing::StartsWith("chainreel snapshot")) << "negative control";
}

// A panel that did not become whole has no record, and takes none from the others.
TEST(TablesOfToday, OfPanelsBesideOneThatFailsAreRecordedAlone) {
  const TemporaryFolder folder;
  folder.write("f.yaml", "model: pp.urdf\nduration: 2\nmethod: rk4\nstep: 1ms\ncompare:\n"
                         "  - {title: fails, torque: [0, \"-1e6 * (1 + t^8 * 1e6) * y_G\"]}\n  - {title: ends}\n");
  const RunOptions there{.folder = folder.path().string()};
  const auto run = [&](const Words& words) { return run_program(words, there); };
  ASSERT_EQ(run({"simulate", "f.yaml", "--panel", "2", "-o", "out/t.1.csv", "--quiet"}).status, 0);
  const std::string earlier = read_whole_file(folder.file("out/t.1.csv")), record = read_whole_file(folder.file("out/t.1.csv.json"));
  const ProgramResult result = run({"simulate", "f.yaml", "-o", "out/t.csv", "--json", "--force"});
  EXPECT_EQ(result.status, 5) << result.err;
  EXPECT_EQ(Json::parse(result.out).at("panels").size(), 2u);
  EXPECT_TRUE(std::filesystem::exists(folder.file("out/t.1.partial.csv")));
  EXPECT_EQ(read_whole_file(folder.file("out/t.1.csv")), earlier);
  EXPECT_EQ(read_whole_file(folder.file("out/t.1.csv.json")), record) << "it is still that of the earlier run";
  EXPECT_THAT(run({"check", "out/t.2.csv", "--today"}).out, HasSubstr("out/t.2.csv is what"));
}

// Equations for a handout are as stale as a film.
TEST(EquationsOfToday, HaveARecordAndAreMadeAgain) {
  const TemporaryFolder folder;
  const std::string own = own_model();
  folder.write("a.urdf", own);
  folder.write("s.yaml", "title: A\nmodel: a.urdf\nduration: 0.3\n");
  const RunOptions there{.folder = folder.path().string()};
  const auto run = [&](const Words& words) { return run_program(words, there); };
  ASSERT_EQ(run({"equations", "a.urdf", "--document", "-o", "out/a.tex", "-o", "out/a.txt"}).status, 0);
  ASSERT_EQ(run({"equations", "s.yaml", "-o", "out/s.py", "-o", "out/s.json"}).status, 0);
  folder.write("s.yaml", "title: B\nmodel: a.urdf\nduration: 0.5\nmethod: rk4\ntorque: [1, 0]\n");
  const ProgramResult same = run({"check", "out", "--today"});
  EXPECT_EQ(same.status, 0) << same.out << same.err;
  for (const char* file : {"out/a.tex", "out/a.txt", "out/s.py", "out/s.json"}) EXPECT_THAT(same.out, HasSubstr(std::string(file) + " is what")) << file;
  const std::string before = read_whole_file(folder.file("out/a.tex"));
  folder.write("a.urdf", heavier(own));
  EXPECT_EQ(run({"check", "out/a.tex", "--today"}).status, 1);
  const ProgramResult told = run({"check", "out", "--today", "--commands", "--junit", "today.xml"});
  EXPECT_EQ(told.status, 1);
  const std::string junit = read_whole_file(folder.file("today.xml"));
  EXPECT_THAT(junit, testing::AllOf(HasSubstr("tests=\"4\" failures=\"4\" errors=\"0\""), HasSubstr("name=\"out/a.tex\""), HasSubstr("type=\"changed\""), HasSubstr("made again by: chainreel equations")));
  EXPECT_EQ(run_told(told.out, folder.path().string()).status, 0) << told.out;
  EXPECT_NE(read_whole_file(folder.file("out/a.tex")), before);
  EXPECT_EQ(run({"check", "out", "--today", "--junit", "today.xml"}).status, 0) << "its own is replaced";
  EXPECT_THAT(read_whole_file(folder.file("today.xml")), HasSubstr("failures=\"0\""));
  folder.write("own.xml", "<mine/>");
  EXPECT_EQ(run({"check", "out", "--today", "--junit", "own.xml"}).status, 6);
  EXPECT_EQ(run({"check", "out/a.tex", "--junit", "today.xml"}).status, 2);
  EXPECT_EQ(run({"check", "out", "--today"}).status, 0);
}

// A still has no audit beside it: it tells of its own pixels.
TEST(PicturesOfToday, WithOtherPixelsAreNotAsTheyWereWritten) {
  const TemporaryFolder folder;
  const std::string scene = folder.write("s.yaml", "model: " + kRoot + "/models/rr.urdf\nduration: 0.2\nmethod: rk4\nvideo: {width: 320, height: 180}\n");
  const std::string still = folder.file("s.png"), figure = folder.file("e.png");
  ASSERT_EQ(run_program({"snapshot", scene, "--at", "0.1", "-o", still, "--quiet"}).status, 0);
  ASSERT_EQ(run_program({"ellipse", kRoot + "/models/rr.urdf", "--pose", "0,90deg", "-o", figure, "--quiet"}).status, 0);
  for (const std::string& file : {still, figure}) {
    const ProgramResult same = run_program({"check", file, "--today", "--json"});
    EXPECT_EQ(same.status, 0) << same.out << same.err;
    const auto text = read_png_text(file);
    Image image = read_png(file);
    folder.write(fs::path(file).filename().string(), with_png_text(png_bytes(image), text));
    EXPECT_EQ(run_program({"check", file, "--today"}).status, 0) << "negative control: compressed anew " << file;
    image.bgra[4000] ^= 1;
    folder.write(fs::path(file).filename().string(), with_png_text(png_bytes(image), text));
    const ProgramResult edited = run_program({"check", file, "--today"});
    EXPECT_EQ(edited.status, 1) << file;
    EXPECT_THAT(edited.out, HasSubstr("its pixels are others")) << file;
  }
}

// Half a film is none, and is told; and no told command replaces what somebody wrote into an output.
TEST(FilesOfToday, ThatAreBrokenAreToldAndThoseThatWereEditedAreKept) {
  const TemporaryFolder folder;
  folder.write("s.yaml", "model: " + kRoot + "/models/rr.urdf\nduration: 0.3\nmethod: rk4\nvideo: {width: 160, height: 90, fps: 10}\n");
  const RunOptions there{.folder = folder.path().string()};
  const auto run = [&](const Words& words) { return run_program(words, there); };
  ASSERT_EQ(run({"render", "s.yaml", "-o", "t/f.mp4", "-o", "t/f.gif", "-o", "t/f.svg", "--quiet"}).status, 0);
  ASSERT_EQ(run({"simulate", "s.yaml", "-o", "t/a.csv", "--quiet"}).status, 0);
  ASSERT_EQ(run({"check", "t", "--today"}).status, 0);
  for (const char* name : {"t/f.mp4", "t/f.gif", "t/f.svg"}) {
    const std::string whole = read_whole_file(folder.file(name));
    for (const std::string& broken : {whole.substr(0, whole.size() / 3), std::string(), std::string("words")}) {
      folder.write(name, broken);
      const ProgramResult told = run({"check", "t", "--today"});
      EXPECT_EQ(told.status, 1) << name << told.out << told.err;
      EXPECT_THAT(told.out, HasSubstr(std::string(name) + " is NOT what")) << name;
    }
    folder.write(name, whole);
  }
  folder.write("t/a.csv", "my data\n");
  const ProgramResult commands = run({"check", "t", "--today", "--commands"});
  EXPECT_THAT(commands.out, HasSubstr("# it would replace t/a.csv, which this program did not write so: chainreel simulate"));
  run_told(commands.out, folder.path().string());
  EXPECT_EQ(read_whole_file(folder.file("t/a.csv")), "my data\n");
}

// A picture at the very end is like a frame of the film, which needs more libraries.
TEST(PicturesOfToday, OfTheEndAreOfThisVersion) {
  const TemporaryFolder folder;
  const std::string scene = folder.write("s.yaml", "model: " + kRoot + "/models/rr.urdf\nduration: 0.2\nmethod: rk4\nvideo: {width: 320, height: 180}\n");
  ASSERT_EQ(run_program({"snapshot", scene, "--at", "0.2", "-o", folder.file("s.png"), "--quiet"}).status, 0);
  const ProgramResult same = run_program({"check", folder.file("s.png"), "--today"});
  EXPECT_EQ(same.status, 0);
  EXPECT_THAT(same.out, Not(HasSubstr("other versions")));
}

}  // namespace
}  // namespace chainreel
