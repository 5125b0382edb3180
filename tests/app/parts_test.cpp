// A film made by many: by threads, in parts, again after it was killed. The bytes are those of one that draws all of it.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <set>

#include "core/json.hpp"
#include "support/run_program.hpp"
#include "support/temporary_folder.hpp"
#include "support/video_probe.hpp"

namespace chainreel {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

// 128 frames at 60 frames/s, with those that are held: two chunks of a film, and 16 of what has key frames alone.
const Words kSmall{"--quiet", "--set", "video.width=96", "--set", "video.height=54",
                   "--set",   "duration=2", "--hold", "{first: 0.05, last: 0.084}"};

Words render_of(const std::string& scene, const Words& more) {
  return with(with({"render", "assets/scenes/" + scene + ".yaml"}, kSmall), more);
}

// All files below a folder, by their place in it; of audits what does not depend on the clock.
std::map<std::string, std::string> files_in(const fs::path& folder) {
  std::map<std::string, std::string> files;
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder)) {
    if (!entry.is_regular_file()) continue;
    std::string bytes = read_whole_file(entry.path().string());
    if (entry.path().extension() == ".json") {
      Json audit = Json::parse(bytes);
      audit.erase("seconds");
      bytes = audit.dump();
    }
    files[fs::relative(entry.path(), folder).string()] = bytes;
  }
  return files;
}

void expect_same_files(const fs::path& a, const fs::path& b) {
  const auto first = files_in(a), second = files_in(b);
  for (const auto& [name, bytes] : first) {
    ASSERT_TRUE(second.contains(name)) << name;
    if (bytes == second.at(name)) continue;
    const auto [here, there] = std::ranges::mismatch(bytes, second.at(name));
    ADD_FAILURE() << name << " differs from byte " << here - bytes.begin() << " of " << bytes.size() << " and " << second.at(name).size() << " on"
                  << (name.ends_with(".json") ? ": " + Json::diff(Json::parse(bytes), Json::parse(second.at(name))).dump() : "");
  }
  EXPECT_EQ(first.size(), second.size());
}

TEST(Jobs, HoweverManyGiveTheSameBytes) {
  const TemporaryFolder one, two, eight;
  for (const auto& [folder, jobs] : {std::pair{&one, "1"}, {&two, "2"}, {&eight, "8"}}) {
    Words words{"--jobs", jobs, "--at", "0.5"};
    for (const char* name : {"a.mp4", "b.webm", "c.mov", "d.gif", "e.apng", "f/f_000000.png", "g.png", "h.svg", "i.csv"})
      words = with(words, {"-o", folder->file(name)});
    const ProgramResult result = run_program(render_of("rr_ellipse", words));
    ASSERT_EQ(result.status, 0) << result.err;
  }
  EXPECT_EQ(probe_video(one.file("a.mp4")).frames, 128);
  EXPECT_THAT(probe_video(one.file("a.mp4")).key_frames, testing::ElementsAre(0, 64));
  EXPECT_EQ(probe_video(one.file("b.webm")).frames, 128);
  EXPECT_TRUE(fs::exists(one.file("f/f_000127.png")) && !fs::exists(one.file("f/f_000128.png")));
  expect_same_files(one.path(), two.path());
  expect_same_files(one.path(), eight.path());
}

TEST(Jobs, BodiesInSpaceAndTransparentPagesToo) {
  const TemporaryFolder one, many;
  for (const auto& [folder, jobs] : {std::pair{&one, "1"}, {&many, "4"}}) {
    const ProgramResult result = run_program(render_of("arm_ellipsoid", {"--set", "duration=0.9", "--preset", "overlay", "--jobs", jobs,
                                                                         "-o", folder->file("a.webm"), "-o", folder->file("a.mov")}));
    ASSERT_EQ(result.status, 0) << result.err;
  }
  expect_same_files(one.path(), many.path());
}

TEST(Jobs, AnErrorOfOneEndsAllAndLeavesNothing) {
  const TemporaryFolder folder;
  // No file may grow beyond 20 kB.
  const ProgramResult result = run_command(
      with({"sh", "-c", "ulimit -f 40; exec \"$0\" \"$@\"", program_path()},
           render_of("rr_ellipse", {"--jobs", "4", "-o", folder.file("a.mov"), "-o", folder.file("b.mp4")})));
  EXPECT_EQ(result.status, 6) << result.err;
  EXPECT_TRUE(fs::is_empty(folder.path()));
}

// Parts of a film, each by a run of the program of its own.
class Parts : public ::testing::Test {
 protected:
  // Renders into `folder` and expects it to go well.
  static void render(const std::string& output, const Words& more = {}) {
    const ProgramResult result = run_program(render_of("rr_ellipse", with({"--set", kEvents, "--set", kPlainSpeed, "-o", output}, more)));
    ASSERT_EQ(result.status, 0) << result.err;
  }
  static ProgramResult join(const Words& parts, const std::string& output) {
    return run_program(with(with({"join"}, parts), {"--quiet", "-o", output}));
  }
  static constexpr const char* kEvents = "events=[{when: \"t - 1\", name: half}]";
  static constexpr const char* kPlainSpeed = "slow_motion=none";  // 128 frames, also about the event
};

TEST_F(Parts, JoinedAreTheWholeFilmByteForByte) {
  for (const std::string ending : {"mp4", "webm", "mov"}) {
    const TemporaryFolder whole, parts;
    render(whole.file("film." + ending));
    for (const char* shard : {"2/3", "1/3", "3/3"}) render(parts.file("film." + ending), {"--shard", shard});
    Words names;
    for (const auto& [name, bytes] : files_in(parts.path())) names.push_back(parts.file(name));
    const std::size_t expected = ending == "mov" ? 3 : 2;  // one of three shares of two chunks is empty
    EXPECT_EQ(names.size(), expected);
    EXPECT_EQ(probe_video(names.front()).first.width, 96) << "each can be watched";
    const TemporaryFolder joined;
    const ProgramResult result = join(names, joined.file("film." + ending));
    ASSERT_EQ(result.status, 0) << result.err;
    expect_same_files(whole.path(), joined.path());
    EXPECT_EQ(files_in(joined.path()).size(), 4u) << "film, audit, words and captions";
  }
}

TEST_F(Parts, MadeInOtherFoldersAndWithoutOpenGlAreOfTheSameFilm) {
  const TemporaryFolder folder;
  fs::create_directories(folder.path() / "far/away");
  render(folder.file("film.mp4"));
  render(folder.file("a.mp4"), {"--shard", "1/2"});
  ASSERT_EQ(run_program(render_of("rr_ellipse", {"--set", kEvents, "--set", kPlainSpeed, "-o", folder.file("far/away/a.mp4"), "--shard", "2/2"}),
                        {.environment = {{"CHAINREEL_GL", "none"}}})
                .status,
            0);
  const Words parts{folder.file("far/away/a.part-2-of-2.mp4"), folder.file("a.part-1-of-2.mp4")};
  for (const char* output : {"joined.mp4", "far/joined.mp4"}) {
    const ProgramResult result = join(parts, folder.file(output));
    ASSERT_EQ(result.status, 0) << result.err;
    EXPECT_EQ(read_whole_file(folder.file(output)), read_whole_file(folder.file("film.mp4")));
    EXPECT_EQ(run_program({"check", folder.file(output), "--today"}).status, 0) << "its audit leads to the scene from where it lies";
  }
}

TEST_F(Parts, JoinedBesideOthersOfTheirNameLeaveTheirAuditTrue) {
  const TemporaryFolder folder;
  const Words brief{"--set", "duration=0.3", "--shard", "1/1", "-o", folder.file("p.webm")};
  render(folder.file("p.mp4"), brief);
  Words parts;
  for (const auto& [name, bytes] : files_in(folder.path())) parts.push_back(name);
  const auto part = [&](const std::string& ending) {
    for (const std::string& name : parts)
      if (name.ends_with(ending) && name.find(".part") != std::string::npos) return folder.file(name);
    return std::string();
  };
  for (const char* ending : {".mp4", ".webm"}) {
    const ProgramResult result = run_program({"join", part(ending), "-o", folder.file(std::string("y") + ending), "--force"});
    ASSERT_EQ(result.status, 0) << result.err;
  }
  for (const char* film : {"y.mp4", "y.webm"}) EXPECT_EQ(run_program({"check", folder.file(film)}).status, 0) << "both are told of";
  // Another film of the name keeps its audit, and the joined one has its own.
  render(folder.file("z.mp4"), {"--set", "duration=0.4"});
  const ProgramResult other = run_program({"join", part(".webm"), "-o", folder.file("z.webm"), "--force"});
  EXPECT_THAT(other.err, HasSubstr("z.webm.json tells of this one"));
  for (const char* film : {"z.mp4", "z.webm"}) EXPECT_EQ(run_program({"check", folder.file(film)}).status, 0) << film;
}

TEST_F(Parts, OfOpacityAndOfFramesAsPicturesAreTheWhole) {
  const TemporaryFolder whole, parts, joined;
  const Words look{"--preset", "overlay", "--set", "duration=0.9"};
  render(whole.file("a.webm"), look);
  for (const char* frames : {"0:31", "31:62"}) render(parts.file("a.webm"), with(look, {"--frames", frames}));
  ASSERT_EQ(join({parts.file("a.part-000031-000062.webm"), parts.file("a.part-000000-000031.webm")}, joined.file("a.webm")).status,
            0);
  expect_same_files(whole.path(), joined.path());

  const TemporaryFolder pictures, shares;
  const Words brief{"--set", "duration=0.2"};
  render(pictures.file("f/k_000000.png"), brief);
  for (const char* shard : {"2/2", "1/2"}) render(shares.file("f/k_000000.png"), with(brief, {"--shard", shard}));
  expect_same_files(pictures.path(), shares.path());
  // A share that is rendered again asks, as a film does; the others' pictures are not its own.
  const Words again = render_of("rr_ellipse", {"--set", kEvents, "-o", shares.file("f/k_000000.png"), "--frames", "5:7",
                                                 "--set", "duration=0.2"});
  EXPECT_EQ(run_program(again).status, 6);
  EXPECT_EQ(run_program(with(again, {"--force"})).status, 0);
  expect_same_files(pictures.path(), shares.path());
}

TEST_F(Parts, TellWhichFramesTheyAreAndAShareWithoutFramesLeavesNone) {
  const TemporaryFolder folder;
  const auto report = [&](const char* shard) {
    const ProgramResult result = run_program(
        render_of("rr_ellipse", {"--set", "duration=0.3", "--json", "--shard", shard, "-o", folder.file("a.mp4")}));
    EXPECT_EQ(result.status, 0);
    return Json::parse(result.out)["films"].front();
  };
  EXPECT_EQ(report("1/2")["file"], nullptr);
  EXPECT_TRUE(fs::is_empty(folder.path()));
  EXPECT_EQ(report("2/2")["part"], (Json{{"first", 0}, {"behind", 26}}));
  EXPECT_EQ(files_in(folder.path()).size(), 1u) << "what stands beside the film is in the part";
}

TEST_F(Parts, OfAnotherFilmOrTooFewAreRefused) {
  const TemporaryFolder folder;
  render(folder.file("a.mp4"), {"--frames", "0:64"});
  render(folder.file("a.mp4"), {"--frames", "64:128"});
  render(folder.file("b.mp4"), {"--shard", "2/2", "--set", "torque=[0, 1]"});
  render(folder.file("c.mp4"), {"--shard", "2/2", "--theme", "dark"});
  render(folder.file("d.mp4"), {"--shard", "2/2", "--crf", "30"});
  const std::string first = folder.file("a.part-000000-000064.mp4"), second = folder.file("a.part-000064-000128.mp4");
  const auto trouble = [&](const Words& parts) {
    const ProgramResult result = join(parts, folder.file("x.mp4"));
    EXPECT_NE(result.status, 0);
    EXPECT_FALSE(fs::exists(folder.file("x.mp4")));
    return std::to_string(result.status) + " " + result.err;
  };
  EXPECT_THAT(trouble({first}), HasSubstr("3 "));
  EXPECT_THAT(trouble({first}), HasSubstr("frames 64 to 127 of 128 are missing: render them with --frames 64:128"));
  EXPECT_THAT(trouble({second}), HasSubstr("frames 0 to 63"));
  EXPECT_THAT(trouble({first, second, first}), HasSubstr("too"));
  EXPECT_THAT(trouble({first, folder.file("b.part-2-of-2.mp4")}), HasSubstr("another motion"));
  EXPECT_THAT(trouble({first, folder.file("c.part-2-of-2.mp4")}), HasSubstr("its scene differs"));
  EXPECT_THAT(trouble({first, folder.file("d.part-2-of-2.mp4")}), HasSubstr("quality"));
  EXPECT_THAT(trouble({first, folder.write("e.mp4", "no film")}), HasSubstr("is no film"));
  ASSERT_EQ(run_program(render_of("rr_ellipse", {"--set", kEvents, "--set", kPlainSpeed, "-o", folder.file("h.mp4"), "--shard", "2/2"}),
                        {.environment = {{"GALLIUM_DRIVER", "softpipe"}}})
                .status,
            0);
  EXPECT_THAT(trouble({first, folder.file("h.part-2-of-2.mp4")}), HasSubstr("it was drawn or encoded by softpipe"));
  // A part whose second half is lost, and one that is no part.
  const std::string bytes = read_whole_file(second);
  EXPECT_THAT(trouble({first, folder.write("f.mp4", bytes.substr(0, bytes.size() * 9 / 10))}), HasSubstr("3 "));
  for (const double place : {0.3, 0.6, 0.9}) {
    std::string flipped = bytes;
    flipped[std::size_t(place * double(bytes.size()))] ^= 1;
    EXPECT_THAT(trouble({first, folder.write("g.mp4", flipped)}), HasSubstr("3 ")) << place;
  }
  ASSERT_EQ(join({first, second}, folder.file("whole.mp4")).status, 0);
  EXPECT_THAT(trouble({folder.file("whole.mp4")}), HasSubstr("is no part of a film"));
  EXPECT_EQ(join({first, second}, folder.file("x.webm")).status, 2);
  const ProgramResult renamed = join({folder.write("1.mov", read_whole_file(first)), folder.write("2.mov", bytes)}, folder.file("x.mov"));
  EXPECT_EQ(renamed.status, 3) << "a .mov of H.264 would be none of ours";
  EXPECT_THAT(renamed.err, HasSubstr("is not what its ending says"));
  EXPECT_FALSE(fs::exists(folder.file("x.mov")));
  EXPECT_EQ(join({first, second}, second).status, 6) << "an output never replaces an input";
}

TEST_F(Parts, ThatCannotBeAreToldWithTheNearestThatCan) {
  const TemporaryFolder folder;
  const auto trouble = [&](const Words& more, const RunOptions& options = {}) {
    const ProgramResult result = run_program(render_of("rr_ellipse", with({"-o", folder.file("a.mp4")}, more)), options);
    EXPECT_EQ(result.status, 2) << result.err;
    EXPECT_TRUE(fs::is_empty(folder.path()));
    return result.err;
  };
  EXPECT_THAT(trouble({"--frames", "0:70"}), HasSubstr("nearest to 70 are 64 and 128"));
  EXPECT_THAT(trouble({"--frames", "64:129"}), HasSubstr("has 128 frames"));
  for (const char* text : {"5", "5:5", "7:3", "-1:3", "a:b", ""}) trouble({"--frames=" + std::string(text)});
  for (const char* text : {"0/2", "3/2", "1", "1/0", "x/y"}) trouble({"--shard", text});
  EXPECT_THAT(trouble({"--frames", "0:64", "--shard", "1/2"}), HasSubstr("leave one out"));
  EXPECT_THAT(trouble({"--shard", "1/2", "-o", folder.file("a.gif")}), HasSubstr("cannot be made in parts"));
  EXPECT_THAT(trouble({"--shard", "slurm"}), HasSubstr("SLURM_ARRAY_TASK_ID is not set"));
  const RunOptions task{.environment = {{"SLURM_ARRAY_TASK_ID", "11"}, {"SLURM_ARRAY_TASK_MIN", "10"}, {"SLURM_ARRAY_TASK_COUNT", "2"}}};
  EXPECT_EQ(run_program(render_of("rr_ellipse", {"--shard", "slurm", "-o", folder.file("a.mp4")}), task).status, 0);
  EXPECT_TRUE(fs::exists(folder.file("a.part-2-of-2.mp4")));
}

TEST(Resume, OfAKilledRenderGivesTheSameBytesAndLeavesNothing) {
  const TemporaryFolder whole, folder;
  const auto words = [](const TemporaryFolder& to) {
    return render_of("rr_ellipse", {"--set", "duration=10", "--jobs", "1", "-o", to.file("a.mp4"), "-o", to.file("b.mov")});
  };
  ASSERT_EQ(run_program(words(whole)).status, 0);
  const Words resumed = with(words(folder), {"--resume"});
  // Killed when some chunks are there: by its own watcher, at the first whole one.
  const std::string kill =
      "\"$0\" \"$@\" & p=$!; while kill -0 $p 2>/dev/null; do if ls " + folder.file(".a.mp4.resume") +
      " 2>/dev/null | grep -q '^0-'; then kill -9 $p; fi; done; wait $p";
  const ProgramResult killed = run_command(with({"bash", "-c", kill, program_path()}, resumed));
  EXPECT_EQ(killed.status, 137) << killed.err;
  EXPECT_FALSE(fs::exists(folder.file("a.mp4")));
  // Those that are whole are spoilt since; one of which the kill left but a beginning (a hidden name, at times no byte) stays.
  for (const auto& entry : fs::directory_iterator(folder.file(".b.mov.resume")))
    if (entry.path().extension() == ".chunk" && !entry.path().filename().string().starts_with('.'))
      fs::resize_file(entry.path(), fs::file_size(entry.path()) - 1);
  const ProgramResult result = run_program(resumed);
  ASSERT_EQ(result.status, 0) << result.err;
  expect_same_files(whole.path(), folder.path());
}

TEST(Resume, TakesNoChunksOfAnotherScene) {
  const TemporaryFolder whole, folder;
  const auto words = [](const TemporaryFolder& to, const char* title) {
    return render_of("rr_ellipse", {"--set", std::string("title=") + title, "--set", "duration=10", "--jobs", "1", "-o", to.file("a.mp4")});
  };
  ASSERT_EQ(run_program(words(whole, "B")).status, 0);
  // No disk for the film itself, whose chunks are then kept.
  fs::create_directories(folder.path() / ".a.mp4.resume");
  EXPECT_EQ(run_command(with({"bash", "-c", "\"$0\" \"$@\" & p=$!; while [ -z \"$(ls " + folder.file(".a.mp4.resume") +
                                              ")\" ] && kill -0 $p; do :; done; kill -9 $p; wait $p",
                              program_path()},
                             with(words(folder, "A"), {"--resume"})))
                .status,
            137);
  ASSERT_EQ(run_program(with(words(folder, "B"), {"--resume"})).status, 0);
  expect_same_files(whole.path(), folder.path());
  const ProgramResult clip = run_program(with(words(folder, "B"), {"--resume", "--force", "-o", folder.file("c.gif")}));
  EXPECT_EQ(clip.status, 2);
  EXPECT_THAT(clip.err, testing::AllOf(HasSubstr("each of its frames builds on all before it"), HasSubstr("without --resume")));
}

// Ends the program as soon as a chunk lies in the folder.
ProgramResult killed_behind_a_chunk(const std::string& store, const Words& words) {
  return run_command(with({"bash", "-c", "\"$0\" \"$@\" & p=$!; while kill -0 $p 2>/dev/null; do if ls " + store +
                                              " 2>/dev/null | grep -q '[.]chunk$'; then kill -9 $p; fi; done; wait $p",
                           program_path()},
                          words));
}

TEST(Resume, OfPicturesOfEveryFrameToo) {
  const TemporaryFolder whole, folder, shares;
  const auto words = [](const TemporaryFolder& to) {
    return render_of("rr_ellipse", {"--set", "duration=8", "--jobs", "1", "-o", to.file("f/k_000000.png"), "-o", to.file("a.mp4")});
  };
  ASSERT_EQ(run_program(words(whole)).status, 0);
  const Words resumed = with(words(folder), {"--resume"});
  ASSERT_EQ(killed_behind_a_chunk(folder.file("f/.k_000000.png.resume"), resumed).status, 137);
  ASSERT_EQ(run_program(resumed).status, 0);
  expect_same_files(whole.path(), folder.path());
  for (const char* shard : {"1/2", "2/2"})
    ASSERT_EQ(run_program(render_of("rr_ellipse", {"--set", "duration=8", "-o", shares.file("f/k_000000.png"), "--resume", "--shard", shard}))
                  .status,
              0);
  EXPECT_EQ(files_in(shares.path() / "f").size(), files_in(whole.path() / "f").size());
  EXPECT_EQ(files_in(shares.path() / "f").at("k_000479.png"), files_in(whole.path() / "f").at("k_000479.png"));
}

TEST(Resume, LeavesNothingWhereTheFilmIsThenRenderedWithoutIt) {
  const TemporaryFolder folder;
  const Words words = render_of("rr_ellipse", {"--set", "duration=10", "--jobs", "1", "-o", folder.file("a.mp4")});
  ASSERT_EQ(killed_behind_a_chunk(folder.file(".a.mp4.resume"), with(words, {"--resume"})).status, 137);
  // Somebody's own file stays.
  folder.write(".a.mp4.resume/my.chunk", "mine");
  ASSERT_EQ(run_program(words).status, 0);
  std::vector<std::string> left;
  for (const auto& entry : fs::directory_iterator(folder.path() / ".a.mp4.resume")) left.push_back(entry.path().filename().string());
  EXPECT_THAT(left, testing::ElementsAre("my.chunk"));
  fs::remove_all(folder.path() / ".a.mp4.resume");
  ASSERT_EQ(killed_behind_a_chunk(folder.file(".a.mp4.resume"), with(words, {"--resume", "--force"})).status, 137);
  ASSERT_EQ(run_program(with(words, {"--force"})).status, 0);
  EXPECT_FALSE(fs::exists(folder.path() / ".a.mp4.resume"));
}

// A copy of this machine's libx264 with another build id, as a newer package has; false where none is found.
bool copy_other_x264(const TemporaryFolder& folder) {
  const Json doctor = Json::parse(run_program({"doctor", "--json"}).out);
  for (const Json& build : doctor["builds"]) {
    const std::string text = build.get<std::string>(), name = text.substr(0, text.find(' ')), id = text.substr(text.find(' ') + 1);
    if (!name.starts_with("libx264")) continue;
    std::string bytes;
    for (std::size_t k = 0; k + 1 < id.size(); k += 2) bytes += char(std::stoi(id.substr(k, 2), nullptr, 16));
    for (const auto& place : fs::directory_iterator("/usr/lib")) {
      if (!fs::exists(place.path() / name)) continue;
      std::string library = read_whole_file((place.path() / name).string());
      const std::size_t at = library.find(bytes);
      if (at == std::string::npos) continue;
      library[at] ^= 1;
      folder.write(name, library);
      return true;
    }
  }
  return false;
}

// No version tells of the encoder behind FFmpeg.
TEST(Resume, TakesNoChunksOfAnotherEncoderAndPartsOfItAreNotJoined) {
  const TemporaryFolder library, folder;
  if (!copy_other_x264(library)) GTEST_SKIP() << "no libx264 with a build id lies below /usr/lib";
  const RunOptions other{.folder = "", .environment = {{"LD_LIBRARY_PATH", library.path().string()}}};
  const Words film = render_of("rr_ellipse", {"-o", folder.file("a.mp4")});
  ASSERT_EQ(run_program(with(film, {"--shard", "1/2"})).status, 0);
  ASSERT_EQ(run_program(with(film, {"--shard", "2/2"}), other).status, 0);
  const ProgramResult joined =
      run_program({"join", folder.file("a.part-1-of-2.mp4"), folder.file("a.part-2-of-2.mp4"), "-o", folder.file("a.mp4")});
  EXPECT_EQ(joined.status, 3);
  EXPECT_THAT(joined.err, HasSubstr("it was drawn or encoded by libx264"));
  // Chunks of a killed run are taken away by one with the other encoder, and found by one with the same.
  const Words longer = render_of("rr_ellipse", {"--set", "duration=10", "--jobs", "1", "--resume", "--force", "-o", folder.file("a.mp4")});
  ASSERT_EQ(killed_behind_a_chunk(folder.file(".a.mp4.resume"), longer).status, 137);
  const auto kept = [&] {
    std::set<std::string> names;
    for (const auto& entry : fs::directory_iterator(folder.path() / ".a.mp4.resume"))
      if (entry.path().extension() == ".chunk") names.insert(entry.path().filename().string());
    return names;
  };
  const std::set<std::string> before = kept();
  const std::string first = *before.begin();
  ASSERT_EQ(run_command(with({"bash", "-c", "\"$0\" \"$@\" & p=$!; while kill -0 $p 2>/dev/null && [ -e " +
                                                folder.file(".a.mp4.resume/" + first) + " ]; do :; done; kill -9 $p; wait $p",
                              program_path()},
                             longer),
                        other)
                .status,
            137);
  EXPECT_FALSE(kept().contains(first));
}

}  // namespace
}  // namespace chainreel
