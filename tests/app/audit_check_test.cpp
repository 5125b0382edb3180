// `chainreel check FILM`: whether a film is the one that its audit tells of.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <functional>

#include "core/json.hpp"
#include "support/run_program.hpp"
#include "support/temporary_folder.hpp"

namespace chainreel {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;

class AuditCheckTest : public testing::Test {
 protected:
  void SetUp() override {
    ASSERT_EQ(run_program({"render", "assets/scenes/pp_spring.yaml", "--quiet", "--set", "duration=0.2", "--set", "video.width=160", "--set",
                           "video.height=90", "-o", film_, "-o", folder_.file("a.gif")})
                  .status,
              0);
  }
  ProgramResult check(const std::string& path) { return run_program({"check", path}); }
  // Another byte in the middle of a file, which stays as long as it was.
  void spoil(const std::string& name) {
    std::string bytes = read_whole_file(folder_.file(name));
    bytes[bytes.size() / 2] = char(bytes[bytes.size() / 2] ^ 1);
    folder_.write(name, bytes);
  }

  TemporaryFolder folder_;
  std::string film_ = folder_.file("a.mp4");
};

TEST_F(AuditCheckTest, AFilmAsItWasWrittenPasses) {
  const ProgramResult good = check(film_);
  EXPECT_EQ(good.status, 0) << good.err;
  EXPECT_THAT(good.out, AllOf(HasSubstr("as written  " + film_), HasSubstr("as written  " + folder_.file("a.gif")),
                              HasSubstr("as written  " + folder_.file("a.txt"))));
  EXPECT_EQ(check(folder_.file("a.json")).out, good.out);
  const Json json = Json::parse(run_program({"check", film_, "--json"}).out);
  EXPECT_EQ(json["passes"], true);
  EXPECT_EQ(json["audited"].size(), 3u);
  EXPECT_EQ(json["contradicted"], Json::array());
}

TEST_F(AuditCheckTest, OneByteMoreOrAnotherOneIsSeenInEachFile) {
  for (const char* name : {"a.mp4", "a.gif", "a.txt"}) {
    const std::string before = read_whole_file(folder_.file(name));
    folder_.write(name, before + "x");
    EXPECT_EQ(check(film_).status, 1) << name;
    spoil(name);
    const ProgramResult bad = check(film_);
    EXPECT_EQ(bad.status, 1) << name;
    EXPECT_THAT(bad.out, HasSubstr("CHANGED  " + folder_.file(name) + ": its SHA-256 is "));
    fs::remove(folder_.file(name));
    EXPECT_THAT(check(folder_.file("a.json")).out, HasSubstr("MISSING  " + folder_.file(name)));
    EXPECT_EQ(check(folder_.file("a.json")).status, 1) << name;
    folder_.write(name, before);
    EXPECT_EQ(check(film_).status, 0) << name;
  }
}

TEST_F(AuditCheckTest, AnAuditThatSaysSomethingElseThanTheFilmIsSeen) {
  Json audit = Json::parse(read_whole_file(folder_.file("a.json")));
  audit["duration"] = 9;
  folder_.write("a.json", audit.dump());
  const ProgramResult bad = check(film_);
  EXPECT_EQ(bad.status, 1);
  EXPECT_THAT(bad.out, HasSubstr("duration is not what the film remembers"));
  audit["duration"] = 0.2;
  audit["tolerance"] = 0.5;
  folder_.write("a.json", audit.dump());
  EXPECT_THAT(check(film_).out, HasSubstr("tolerance is not what the film remembers")) << "of a method that has none";
  audit.erase("method");
  folder_.write("a.json", audit.dump());
  EXPECT_THAT(check(film_).out, HasSubstr("method, tolerance are not"));
  audit["outputs"] = 3;
  EXPECT_EQ(check(folder_.write("a.json", audit.dump())).status, 3);
  EXPECT_EQ(check(folder_.write("a.json", "{}")).status, 3);
  EXPECT_EQ(check(folder_.write("a.json", "{\"outputs\": [{\"file\": 1}]}")).status, 3);
  fs::remove(folder_.file("a.json"));
  EXPECT_THAT(check(film_).err, HasSubstr("there is no audit"));
}

// Each of these was an alarm of its own once, or none.
TEST_F(AuditCheckTest, ComparisonsStillsAndHeldFilmsAreAsTheyWereWritten) {
  const std::string png = folder_.file("c.png");
  for (const Words& more : {Words{"--vary", "start.q.2=0,1", "-o", folder_.file("c.mp4"), "-o", png}, Words{"--hold", "{first: 0.1}", "-o", folder_.file("h.gif")},
                            Words{"--set", "plot=energy", "--theme", "dark", "-o", folder_.file("d.svg")}}) {
    ASSERT_EQ(run_program(with({"render", "assets/scenes/pp_spring.yaml", "--quiet", "--set", "duration=0.2", "--set", "video.width=160", "--set",
                                "video.height=90"},
                               more))
                  .status,
              0);
    EXPECT_EQ(check(more.back()).out.find("CHANGED"), std::string::npos) << check(more.back()).out;
    EXPECT_EQ(check(more.back()).status, 0) << more.back();
  }
  EXPECT_EQ(check(folder_.file("c.txt")).status, 0) << "its words";
}

TEST_F(AuditCheckTest, EveryNumberOfTheAuditIsLookedAt) {
  const std::string whole = read_whole_file(folder_.file("a.json"));
  const auto changed = [&](const std::function<void(Json&)>& change) {
    Json audit = Json::parse(whole);
    change(audit);
    folder_.write("a.json", audit.dump());
    return check(film_).status;
  };
  EXPECT_EQ(changed([](Json&) {}), 0);
  EXPECT_EQ(changed([](Json& audit) { audit.erase("energy_error"); }), 1);
  EXPECT_EQ(changed([](Json& audit) { audit["frames"] = 99; }), 1);
  EXPECT_EQ(changed([](Json& audit) { audit["film_seconds"] = 9; }), 1);
  EXPECT_EQ(changed([](Json& audit) { audit["held_frames"]["first"] = 3; }), 1);
  EXPECT_EQ(changed([](Json& audit) { audit["panels"] = Json::array({Json::object()}); }), 1);
  EXPECT_EQ(changed([](Json& audit) { audit["outputs"][0]["bytes"] = 99; }), 1);
  EXPECT_EQ(changed([](Json& audit) { audit["a key of mine"] = 99; }), 1);
  EXPECT_EQ(changed([](Json& audit) { audit["outputs"][0]["file"] = "../a.mp4"; }), 3);
  EXPECT_EQ(changed([](Json& audit) { audit["outputs"][0]["sha256"] = "1"; }), 3);
  EXPECT_EQ(changed([](Json& audit) { audit["outputs"] = Json::array(); }), 3) << "as of a folder of pictures";
}

// Where scene and model lay is of no matter, but which they were is; numbers of a model stand in the audit themselves.
TEST_F(AuditCheckTest, ModelAndSceneAreThoseOfTheFilm) {
  const std::string scene = folder_.write("inline.yaml", "model: {links: [1], masses: [1.5]}\nduration: 0.1\nvideo: {width: 160, height: 90}\n");
  const std::string film = folder_.file("i.mp4");
  ASSERT_EQ(run_program({"render", scene, "-o", film, "--quiet"}).status, 0);
  const std::string whole = read_whole_file(folder_.file("i.json"));
  const auto changed = [&](const char* from, const char* to) {
    std::string text = whole;
    const std::size_t at = text.find(from);
    EXPECT_NE(at, std::string::npos) << from << " in " << whole;
    folder_.write("i.json", text.replace(at, std::string(from).size(), to));
    return check(film);
  };
  EXPECT_EQ(changed("inline.yaml", "moved/inline.yaml").status, 0);
  EXPECT_EQ(changed("inline.yaml", "other.yaml").status, 1);
  const ProgramResult heavier = changed("masses: [1.5]", "masses: [1.6]");
  EXPECT_EQ(heavier.status, 1);
  EXPECT_THAT(heavier.out, HasSubstr("model"));
}

TEST_F(AuditCheckTest, WhatItCannotHonourIsRefused) {
  EXPECT_EQ(run_program({"check", film_, "--all"}).status, 2);
  EXPECT_EQ(run_program({"check", film_, "--set", "duration=1"}).status, 2);
  fs::copy(film_, folder_.file("a.mov"));
  EXPECT_THAT(check(folder_.file("a.mov")).err, HasSubstr("is nothing that"));
  EXPECT_EQ(check(folder_.file("a.mov")).status, 3);
}

}  // namespace
}  // namespace chainreel
