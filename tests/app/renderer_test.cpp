// Which library draws, what is pinned of it, and what is said where it is missing.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/format.hpp"
#include "core/json.hpp"
#include "support/run_program.hpp"
#include "support/temporary_folder.hpp"
#include "support/video_probe.hpp"

namespace chainreel {
namespace {

using testing::AllOf;
using testing::AnyOf;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

using Environment = std::map<std::string, std::string>;

Environment without(const std::string& libraries) {
  return {{"LD_PRELOAD", preloaded(CHAINREEL_FAILING_CALLS)}, {"ASAN_OPTIONS", "verify_asan_link_order=0"}, {"FAIL_OPEN", libraries}};
}

ProgramResult doctor(const Words& words, const Environment& environment = {}) {
  return run_program(with({"doctor", "--json"}, words), {.folder = "", .environment = environment});
}

Json renderer(const ProgramResult& result) {
  EXPECT_EQ(result.status, 0) << result.err;
  return Json::parse(result.out)["renderer"];
}

TEST(Renderer, DoctorSaysWhatIsPinnedAndWhatOfTheEnvironmentIsOverruled) {
  const Json plain = renderer(doctor({}));
  EXPECT_THAT(plain["renderer"].get<std::string>(), AllOf(StartsWith("llvmpipe (LLVM"), Not(HasSubstr("bits"))));
  EXPECT_THAT(plain["pinned"]["LP_NATIVE_VECTOR_WIDTH"], AnyOf("128", "256"));  // of processors without AVX, and with it
  EXPECT_TRUE(plain["pinned"].contains("LP_*") && plain["pinned"]["LP_*"].is_null());
  EXPECT_TRUE(plain["overruled"].empty());
  const Json other = renderer(doctor({}, {{"LP_NATIVE_VECTOR_WIDTH", "512"}, {"LP_NO_RAST", "1"}, {"LP_NUM_THREADS", "2"}}));
  EXPECT_EQ(other["renderer"], plain["renderer"]);
  EXPECT_EQ(other["overruled"], (Json{"LP_NATIVE_VECTOR_WIDTH=512", "LP_NO_RAST=1"}));
  EXPECT_THAT(run_program({"doctor"}, {.folder = "", .environment = {{"LP_NO_RAST", "1"}}}).out,
              AllOf(HasSubstr("pinned    LP_NATIVE_VECTOR_WIDTH="), HasSubstr("overruled LP_NO_RAST=1")));
}

// Threads that open libraries read the environment, which moves where it changes: once a film of two parts crashed by it.
TEST(Renderer, ChangesTheEnvironmentBeforeTheFirstThread) {
  const TemporaryFolder folder;
  Environment environment = without("");
  environment["FAIL_LATE_ENVIRONMENT"] = "1";
  environment["HB_SHAPER_LIST"] = "fallback";
  environment["LP_NO_RAST"] = "1";
  for (const Words& words : {Words{"render", "assets/scenes/rr_ellipse.yaml", "--jobs", "2", "--set", "duration=0.3", "-o", folder.file("a.mp4")},
                             {"snapshot", "assets/scenes/rr_ellipse.yaml", "--at", "0,1", "-o", folder.file("a/")},
                             {"chart", "assets/scenes/rr_ellipse.yaml", "--set", "duration=0.1", "-o", folder.file("c.png")}}) {
    const ProgramResult result = run_program(with(words, {"--quiet"}), {.folder = "", .environment = environment});
    EXPECT_EQ(result.status, 0) << joined(words, " ") << ": " << result.err;
  }
}

// Each of these makes other pixels, a crash or no file at all where it is followed.
TEST(Renderer, DrawsTheSameBytesWhateverTheEnvironmentSaysOfLibraries) {
  const TemporaryFolder folder;
  const auto bytes = [&](const std::string& name, const Environment& environment) {
    const std::string file = folder.file(name + ".png");
    const ProgramResult result = run_program({"--gl", "osmesa", "snapshot", "assets/scenes/rr_ellipse.yaml", "--at", "1", "--quiet",
                                              "--set", "video.width=160", "--set", "video.height=90", "-o", file},
                                             {.folder = "", .environment = environment});
    EXPECT_EQ(result.status, 0) << name << ": " << result.err;
    return read_whole_file(file);
  };
  const std::string plain = bytes("plain", {});
  for (const auto& [name, value] : std::map<std::string, std::string>{{"FREETYPE_PROPERTIES", "cff:no-stem-darkening=0 truetype:interpreter-version=35"},
                                                                      {"HB_SHAPER_LIST", "fallback"},
                                                                      {"ST_DEBUG", "wf"},
                                                                      {"DRAW_USE_LLVM", "0"},
                                                                      {"GALLIUM_TESTS", "1"},
                                                                      {"GALLIUM_NOOP", "1"},
                                                                      {"MESA_GL_VERSION_OVERRIDE", "2.1"},
                                                                      {"MESA_EXTENSION_OVERRIDE", "-GL_ARB_framebuffer_object"}})
    EXPECT_TRUE(bytes(name, {{name, value}}) == plain) << name;
  EXPECT_FALSE(bytes("softpipe", {{"GALLIUM_DRIVER", "softpipe"}}).empty()) << "who names a renderer means it";
}

// A picture by itself opens no library unless one is named, a film can do without; with the same bytes.
TEST(Renderer, IsNotNeededForStillsAndNoneIsUsedWhereNoneIsWanted) {
  const TemporaryFolder folder;
  const auto bytes = [&](const std::string& name, Words words, const Environment& environment) {
    const std::string file = folder.file(name);
    words.insert(words.end(), {"--quiet", "--set", "video.width=160", "--set", "video.height=90", "-o", file});
    const ProgramResult result = run_program(words, {.folder = "", .environment = environment});
    EXPECT_EQ(result.status, 0) << name << ": " << result.err;
    return read_whole_file(file);
  };
  const Environment missing = without("libEGL libOSMesa");
  const Words snapshot{"snapshot", "assets/scenes/rr_ellipse.yaml", "--at", "1"}, film{"render", "assets/scenes/rr_ellipse.yaml", "--set", "duration=0.2"};
  const std::string still = bytes("still.png", snapshot, missing);
  EXPECT_TRUE(bytes("osmesa.png", with({"--gl", "osmesa"}, snapshot), {}) == still);
  EXPECT_TRUE(bytes("none.mp4", with({"--gl", "none"}, film), missing) == bytes("film.mp4", film, {}));
  EXPECT_EQ(run_program(with(film, {"-o", folder.file("b.mp4")}), {.folder = "", .environment = missing}).status, 4);
  EXPECT_FALSE(bytes("softpipe.png", snapshot, {{"GALLIUM_DRIVER", "softpipe"}}).empty()) << "who names a renderer means it";
  EXPECT_EQ(renderer(doctor({"--gl", "none"}, missing))["backend"], "none");
}

TEST(Renderer, ComesFromTheLibraryThatIsNamedByFlagOrVariable) {
  EXPECT_EQ(renderer(doctor({"--gl", "egl"}))["backend"], "EGL");
  EXPECT_EQ(renderer(doctor({}, {{"CHAINREEL_GL", "egl"}}))["backend"], "EGL");
  // What is typed goes before what the environment says.
  EXPECT_EQ(renderer(doctor({"--gl", "osmesa"}, {{"CHAINREEL_GL", "egl"}}))["backend"], "OSMesa");
  EXPECT_EQ(renderer(doctor({"--gl", "auto"}))["backend"], "OSMesa");
  const ProgramResult wrong = doctor({"--gl", "glx"});
  EXPECT_EQ(wrong.status, 2);
  EXPECT_THAT(wrong.err, HasSubstr("osmesa,egl,none"));
}

TEST(Renderer, ThatIsMissingIsReplacedByTheOtherOrNamedWithItsPackage) {
  EXPECT_EQ(renderer(doctor({}, without("libOSMesa")))["backend"], "EGL");
  const auto missing = [](const Words& words, const std::string& libraries) {
    const ProgramResult result = doctor(words, without(libraries));
    EXPECT_EQ(result.status, 4) << result.err;
    return result.err;
  };
  EXPECT_THAT(missing({"--gl", "osmesa"}, "libOSMesa"), AllOf(HasSubstr("libosmesa6"), Not(HasSubstr("libegl1"))));
  EXPECT_THAT(missing({"--gl", "egl"}, "libEGL"), AllOf(HasSubstr("libegl1"), Not(HasSubstr("libosmesa6"))));
  EXPECT_THAT(missing({}, "libEGL libOSMesa"), AllOf(HasSubstr("libegl1"), HasSubstr("libosmesa6")));
  // The library is there, but no driver behind it.
  const ProgramResult none = doctor({"--gl", "egl"}, {{"__EGL_VENDOR_LIBRARY_DIRS", "/none"}, {"__EGL_VENDOR_LIBRARY_FILENAMES", "/none"}});
  EXPECT_EQ(none.status, 4);
  EXPECT_THAT(none.err, HasSubstr("libegl-mesa0"));
}

TEST(Renderer, ThatTheEnvironmentNamesToMesaIsTaken) {
  EXPECT_EQ(renderer(doctor({}, {{"GALLIUM_DRIVER", "softpipe"}}))["renderer"], "softpipe");
  EXPECT_EQ(renderer(doctor({"--gl", "egl"}, {{"GALLIUM_DRIVER", "softpipe"}}))["renderer"], "softpipe");
}

}  // namespace
}  // namespace chainreel
