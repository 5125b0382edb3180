// `chainreel check --today` where files of one name lie at several places, and what the told commands may not touch.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

#include "core/json.hpp"
#include "support/own_model.hpp"
#include "support/run_program.hpp"
#include "support/temporary_folder.hpp"

namespace chainreel {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

const std::string kKeys = "start: {q: [1, 0]}\nduration: 0.1\nmethod: rk4\nvideo: {width: 160, height: 90}\n";

ProgramResult run_in(const std::string& folder, Words words) {
  RunOptions options;
  options.folder = folder;
  return run_program(words, options);
}

// What came with the program is held against that, whatever lies about under its name.
TEST(FilmElsewhere, OfTheProgramsOwnFilesIsNoStrangers) {
  const TemporaryFolder folder;
  folder.write("sib/rr.urdf", heavier(own_model()));
  folder.write("sib/rr_free.yaml", "model: rr.urdf\n" + kKeys);
  fs::create_directory(folder.file("mine"));
  const std::string mine = folder.file("mine");
  ASSERT_EQ(run_in(mine, {"snapshot", "rr.urdf", "--pose", "0,1", "--quiet", "-o", "out/pose.png"}).status, 0);
  ASSERT_EQ(run_in(mine, {"ellipse", "rr.urdf", "--pose", "0,1", "--quiet", "-o", "out/e.svg"}).status, 0);
  ASSERT_EQ(run_in(mine, {"snapshot", "rr_free", "--at", "0.1", "--quiet", "-o", "out/s.png"}).status, 0);
  const ProgramResult asked = run_in(mine, {"check", "out", "--today"});
  EXPECT_EQ(asked.status, 0) << asked.out << asked.err;
  EXPECT_EQ(std::ranges::count(asked.out, '\n'), 3);
}

// A scene lies beside or above its picture, and its model may be the program's: the answer is the same from everywhere.
TEST(FilmElsewhere, ScenesAreThoseNearestToThePictureFromEveryFolder) {
  const TemporaryFolder folder;
  folder.write("p/own.yaml", "title: mine\nmodel: rr.urdf\n" + kKeys);
  folder.write("other/own.yaml", "title: OTHER\nmodel: rr.urdf\n" + kKeys);
  const std::string p = folder.file("p");
  ASSERT_EQ(run_in(p, {"snapshot", "own.yaml", "--at", "0.1", "--quiet", "-o", "out/snap.png"}).status, 0);
  const std::vector<std::pair<std::string, std::string>> from{{p, "out/snap.png"}, {p + "/out", "snap.png"}, {folder.file("other"), "../p/out/snap.png"}, {folder.file("other"), "../p/out"}, {"/", p + "/out"}};
  for (const auto& [here, asked] : from) {
    const ProgramResult same = run_in(here, {"check", asked, "--today"});
    EXPECT_EQ(same.status, 0) << here << same.out << same.err;
    EXPECT_THAT(same.out, HasSubstr("is what ")) << here;
  }
  folder.write("p/own.yaml", "title: changed\nmodel: rr.urdf\n" + kKeys);
  for (const auto& [here, asked] : from) EXPECT_THAT(run_in(here, {"check", asked, "--today"}).out, HasSubstr("title mine -> changed")) << here;
}

// The audit in each folder says where the scene lies from there.
TEST(FilmElsewhere, OutputsInTwoFoldersHaveEachTheirSceneFromThere) {
  const TemporaryFolder folder;
  folder.write("a/s.yaml", "title: right\nmodel: rr.urdf\n" + kKeys);
  folder.write("s.yaml", "title: WRONG\nmodel: rr.urdf\n" + kKeys);
  const std::string a = folder.file("a");
  ASSERT_EQ(run_in(a, {"render", "s.yaml", "--quiet", "-o", "out/deep/x.mp4", "-o", "out/w.webm", "-o", "z.gif"}).status, 0);
  for (const auto& [audit, path] : {std::pair{"out/deep/x.json", "../../s.yaml"}, {"out/w.json", "../s.yaml"}, {"z.json", "s.yaml"}})
    EXPECT_EQ(Json::parse(read_whole_file(a + "/" + audit))["scene_path"], path);
  const ProgramResult asked = run_in(a, {"check", ".", "--today"});
  EXPECT_EQ(asked.status, 0) << asked.out;
}

// The told commands overwrite: what this program did not write, or not so, is named in place of a command that runs.
TEST(FilmElsewhere, WhatIsNotOursIsReplacedByNoCommand) {
  const TemporaryFolder folder;
  const auto scene = [&](const std::string& more) { folder.write("s.yaml", "model: rr.urdf\n" + kKeys + more); };
  scene("");
  const std::string here = folder.path().string();
  ASSERT_EQ(run_in(here, {"render", "s.yaml", "--quiet", "-o", "films/v.mp4"}).status, 0);
  ASSERT_EQ(run_in(here, {"energy", "s.yaml", "--methods", "rk4,verlet", "--quiet", "-o", "films/en.png"}).status, 0);
  folder.write("films/v.srt", "mine\n");
  folder.write("films/en.csv", "mine\n");
  scene("events: [{when: q1 < 0.99, name: down}]\n");
  const ProgramResult asked = run_in(here, {"check", "films", "--today", "--commands"});
  EXPECT_EQ(asked.status, 1);
  EXPECT_THAT(asked.out, AllOf(HasSubstr("# it would replace films/v.srt, which"), HasSubstr("# it would replace films/en.csv, which")));
  EXPECT_EQ(run_told(asked.out, here).status, 0);
  EXPECT_EQ(read_whole_file(folder.file("films/v.srt")), "mine\n");
  EXPECT_EQ(read_whole_file(folder.file("films/en.csv")), "mine\n");
  EXPECT_THAT(run_in(here, {"check", "films", "--today"}).out, HasSubstr("move it away before"));
  for (const char* own : {"films/v.srt", "films/en.csv"}) fs::remove(folder.file(own));
  EXPECT_EQ(run_told(run_in(here, {"check", "films", "--today", "--commands"}).out, here).status, 0);
  EXPECT_EQ(run_in(here, {"check", "films", "--today"}).status, 0);
}

// A table that another one is made of comes first; scenes whose names begin with - and tables beside maps are made anew, too.
TEST(FilmElsewhere, CommandsCanBeRunInTheirOrder) {
  const TemporaryFolder folder;
  folder.write("rr.urdf", own_model());
  folder.write("-s.yaml", "model: rr.urdf\n" + kKeys);
  const std::string here = folder.path().string();
  ASSERT_EQ(run_in(here, {"simulate", "./-s.yaml", "--quiet", "-o", "out/z.csv"}).status, 0);
  ASSERT_EQ(run_in(here, {"inverse", "rr.urdf", "--trajectory", "out/z.csv", "--quiet", "-o", "out/a.csv"}).status, 0);
  ASSERT_EQ(run_in(here, {"ellipse", "--along", "./-s.yaml", "--quiet", "-o", "out/e.svg"}).status, 0);
  ASSERT_EQ(run_in(here, {"sweep", "./-s.yaml", "--over", "start.q.1=0:1:2", "--over", "start.q.2=0:1:2", "--last", "q1", "--last", "q2", "--map", "q2", "--quiet", "-o", "out/m.svg", "-o", "out/m.json",
                          "-o", "out/m.npz"})
                .status,
            0)
      << "a map is drawn of the .csv, which stands beside it";
  EXPECT_TRUE(fs::exists(folder.file("out/m.csv")));
  folder.write("rr.urdf", heavier(own_model()));
  const std::string commands = run_in(here, {"check", "out", "--today", "--commands"}).out;
  EXPECT_LT(commands.find("-o out/z.csv"), commands.find("-o out/a.csv")) << commands;
  ASSERT_EQ(run_told(commands, here).status, 0) << commands;
  const ProgramResult asked = run_in(here, {"check", "out", "--today"});
  EXPECT_EQ(asked.status, 0) << asked.out;
  // A table beside a map that was changed since is the user's.
  folder.write("out/m.csv", read_whole_file(folder.file("out/m.csv")) + "mine\n");
  folder.write("rr.urdf", own_model());
  EXPECT_THAT(run_in(here, {"check", "out", "--today", "--commands"}).out, HasSubstr("# it would replace out/m.csv, which"));
}

// A still by itself shows meshes, too.
TEST(FilmElsewhere, AChangedMeshIsToldOfStills) {
  const TemporaryFolder folder;
  const std::string corners = "v 0 0 0\nv 0.2 0 0\nv 0 0.2 0\nv 0 0 0.2\n";
  folder.write("m.obj", corners + "f 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n");
  folder.write("m.urdf",
               "<robot name='m'><link name='base'/><joint name='j' type='continuous'><parent link='base'/><child link='l'/><axis xyz='0 0 1'/></joint><link name='l'><inertial><origin xyz='0.1 0 0'/>"
               "<mass value='1'/><inertia ixx='1' iyy='1' izz='1' ixy='0' ixz='0' iyz='0'/></inertial><visual><geometry><mesh filename='m.obj'/></geometry></visual></link></robot>");
  folder.write("s.yaml", "model: m.urdf\nlinks: visual\nduration: 0.1\nmethod: rk4\nvideo: {width: 160, height: 90}\n");
  const std::string here = folder.path().string();
  ASSERT_EQ(run_in(here, {"snapshot", "s.yaml", "--at", "0.1", "--quiet", "-o", "out/s.png"}).status, 0);
  EXPECT_EQ(run_in(here, {"check", "out", "--today"}).status, 0);
  folder.write("m.obj", corners + "f 1 3 2\nf 1 2 4\nf 1 4 3\n");
  EXPECT_EQ(run_in(here, {"check", "out", "--today"}).status, 1);
}

}  // namespace
}  // namespace chainreel
