// What holds for every command, by the program's own list of commands and of their options: a new one cannot
// be left out here.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cstdint>
#include <filesystem>
#include <iterator>
#include <map>
#include <sstream>

#include "app/report/motion_table.hpp"
#include "core/csv.hpp"
#include "core/format.hpp"
#include "app/guide/reference.hpp"
#include "core/json.hpp"
#include "model/read_chain.hpp"
#include "support/run_program.hpp"
#include "support/temporary_folder.hpp"

namespace chainreel {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

const std::string kCommandScene = "assets/scenes/pp_free.yaml";
const Words kShort{"--set", "duration=0.05"};
const Words kSmallFigure{"--width", "64", "--height", "36"};

// The words that a column of the help begins with: commands, or options of one.
std::vector<std::string> first_words(const std::string& help, const std::string& head) {
  std::vector<std::string> words;
  std::istringstream lines(help.substr(help.find("\n" + head + "\n") + head.size() + 2));
  for (std::string line; std::getline(lines, line) && !line.empty();)
    if (line[2] != ' ') words.push_back(line.substr(2, line.find(' ', 2) - 2));
  return words;
}

// Every command with what it needs, but for its output, which comes last.
class EveryCommand : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    inputs_ = new TemporaryFolder;
    ASSERT_EQ(run_program(with(with({"render", kCommandScene, "--quiet", "-o", inputs_->file("clip.mp4")}, kShort),
                               {"--set", "video.width=64", "--set", "video.height=36"}))
                  .status,
              0);
    ASSERT_EQ(run_program(with({"render", kCommandScene, "--quiet", "--shard", "1/1", "-o", inputs_->file("clip.mp4"), "--set",
                                "video.width=64", "--set", "video.height=36"},
                               kShort))
                  .status,
              0);
    inputs_->write("q.csv", "t,q1,q2\n0,0,0\n0.3,0.7,1\n1,1,2\n");
    inputs_->write("fall.yaml", "model: " CHAINREEL_SOURCE_FOLDER
                                "/models/pp.urdf\nduration: 1\nmethod: rk4\nstep: 0.01\ntorque: [0, 0]\n"
                                "events: [{when: \"q2 < -1\", kind: fall}]\n");
    inputs_->write("suite.yaml", "model: " CHAINREEL_SOURCE_FOLDER "/models/rr.urdf\nsize: 64x36\nposes: {a: [0, 1]}\n");
    for (const std::string& command : first_words(run_program({"--help"}).out, "Subcommands:"))
      helps_[command] = run_program({command, "--help"}).out;
  }
  static void TearDownTestSuite() {
    delete inputs_;
    helps_.clear();
  }

  struct Use {
    Words words;
    std::string ending;    // of what it writes; "": nothing
    bool to_name = false;  // the output is no option, but the command's own word without an ending
    std::string option = "-o";
  };
  static std::map<std::string, Use> uses() {
    const std::string clip = inputs_->file("clip.mp4");
    return {
        {"render",
         {with(with({kCommandScene, "--set", "video.width=64", "--set", "video.height=36"}, kShort), {"--quiet"}),
          ".png"}},
        {"join", {{inputs_->file("clip.part-1-of-1.mp4")}, ".mp4"}},
        {"bench", {with({kCommandScene, "--set", "video.width=64", "--set", "video.height=36", "--quiet"}, kShort), ""}},
        {"snapshot", {with(with({kCommandScene}, kShort), kSmallFigure), ".svg"}},
        {"ellipse", {with({"models/rr.urdf", "--pose", "0.1,1"}, kSmallFigure), ".csv"}},
        {"simulate", {with({kCommandScene}, kShort), ".csv"}},
        {"extract", {{clip}, ".yaml"}},
        {"compare", {{clip, clip}, ".png"}},
        {"dynamics", {{"models/rr.urdf", "--q", "0.1,1"}, ""}},
        {"equations", {{"models/rr.urdf"}, ".tex"}},
        {"inverse", {{"models/rr.urdf", "--trajectory", inputs_->file("q.csv")}, ".csv"}},
        {"init", {{}, ".yaml", true}},
        {"check", {{kCommandScene}, ""}},
        {"doctor", {{}, ""}},
        {"methods", {{}, ""}},
        {"schema", {{}, ""}},
        {"completion", {{"bash"}, ""}},
        {"help", {{}, ""}},
        {"chart",
         {with({"assets/scenes/rr_free.yaml", "--methods", "rk4", "--runs", "1", "--longest", "0.001"},
               kShort),
          ".csv"}},
        {"energy",
         {{"assets/scenes/rr_free.yaml", "--until", "0.1s", "--step", "0.01", "--methods", "rk4"}, ".csv"}},
        {"stability",
         {with({"assets/scenes/rr_free.yaml", "--x", "step=0.001:0.002:2", "--y", "gravity.2=-9:-8:2"},
               kShort),
          ".csv"}},
        {"sweep", {with({kCommandScene, "--over", "torque.1=0,1"}, kShort), ".csv"}},
        {"fall", {{inputs_->file("fall.yaml"), "--sweep", "torque.2=0,2"}, ".csv"}},
        {"sheet", {with(with({kCommandScene}, kShort), kSmallFigure), ".svg"}},
        {"gallery", {{clip}, ".html"}},
        {"verify", {{inputs_->file("suite.yaml"), "--missing", "write"}, ".xml", false, "--junit"}}};
  }

  static Words command_line(const std::string& command, const Use& use, const std::string& output) {
    Words words = with({command}, use.words);
    if (use.to_name) return with(words, {fs::path(output).replace_extension().string()});
    return use.ending.empty() ? words : with(words, {use.option, output});
  }
  static bool offers(const std::string& command, const std::string& option) {
    for (const std::string& word : first_words(helps_.at(command), "Options:"))
      if (("," + word + ",").find("," + option + ",") != std::string::npos) return true;
    return false;
  }

  static TemporaryFolder* inputs_;
  static std::map<std::string, std::string> helps_;
};
TemporaryFolder* EveryCommand::inputs_ = nullptr;
std::map<std::string, std::string> EveryCommand::helps_;

// The words of "frames, fps".
std::vector<std::string> told_names(const std::string& told) {
  std::vector<std::string> names;
  std::istringstream stream(told);
  for (std::string name; std::getline(stream, name, ',');) names.push_back(name.substr(name.find_first_not_of(' ')));
  return names;
}

std::vector<std::string> top_keys(const Json& json) {
  std::vector<std::string> keys;
  for (const auto& [key, value] : json.items()) keys.push_back(key);
  std::sort(keys.begin(), keys.end());
  return keys;
}

// Commands that print what they are asked about: their keys are those of one of several kinds.
bool has_kinds(const std::string& command) {
  return command == "check" || command == "compare" || command == "help" || command == "stability";
}

TEST_F(EveryCommand, PrintsOneJsonObjectWithTheKeysThatTheGuideTells) {
  const TemporaryFolder folder;
  int looked_at = 0;
  for (const auto& [command, use] : uses()) {
    if (!offers(command, "--json")) continue;
    const auto told = std::find_if(json_reports().begin(), json_reports().end(),
                                   [&, &command = command](const JsonReport& one) { return one.command == command; });
    ASSERT_NE(told, json_reports().end()) << command << ": its keys belong into src/app/guide/reference_json.cpp";
    const ProgramResult made = run_program(with(command_line(command, use, folder.file("out_" + command + use.ending)), {"--json"}));
    const Json json = Json::parse(made.out, nullptr, false);
    ASSERT_TRUE(json.is_object()) << command << ": " << made.out << made.err;
    ++looked_at;
    if (has_kinds(command)) continue;
    std::vector<std::string> wanted;
    for (const JsonKey& key : told->keys)
      for (const std::string& name : told_names(key.names)) wanted.push_back(name);
    std::sort(wanted.begin(), wanted.end());
    EXPECT_EQ(top_keys(json), wanted) << command;
    if (json.contains("file")) EXPECT_EQ(json["file"], json["files"].empty() ? Json(nullptr) : json["files"].front()) << command;
    if (command != "render") continue;
    wanted.clear();
    for (const std::vector<JsonKey>& keys : {run_keys(), film_keys()})
      for (const JsonKey& key : keys)
        for (const std::string& name : told_names(key.names)) wanted.push_back(name);
    std::sort(wanted.begin(), wanted.end());
    EXPECT_EQ(top_keys(json["films"][0]), wanted);
  }
  EXPECT_EQ(looked_at, int(json_reports().size()));
}

TEST_F(EveryCommand, IsKnownHereWithAnExampleInItsHelp) {
  std::vector<std::string> known;
  for (const auto& [command, use] : uses()) known.push_back(command);
  std::vector<std::string> there;
  for (const auto& [command, help] : helps_) {
    there.push_back(command);
    EXPECT_THAT(help, HasSubstr("Example: chainreel " + command));
  }
  EXPECT_EQ(known, there) << "a new command belongs into the list of uses above";
  for (const auto& [command, use] : uses())
    EXPECT_EQ(offers(command, "--force"), !use.ending.empty())
        << command << ": --force is for what writes a file";
}

TEST_F(EveryCommand, ReplacesAFileByForceAlone) {
  int writing = 0;
  for (const auto& [command, use] : uses()) {
    if (use.ending.empty()) continue;
    ++writing;
    const TemporaryFolder folder;
    const std::string mine = folder.write("a" + use.ending, "mine\n");
    const Words words = command_line(command, use, mine);
    const ProgramResult refused = run_program(words);
    EXPECT_EQ(refused.status, 6) << command << refused.err;
    EXPECT_THAT(refused.err, HasSubstr(mine)) << command;
    EXPECT_EQ(read_whole_file(mine), "mine\n") << command;
    const ProgramResult forced = run_program(with(words, {"--force"}));
    EXPECT_EQ(forced.status, 0) << command << forced.err;
    EXPECT_NE(read_whole_file(mine), "mine\n") << command;
    // Negative control: in an empty place nothing is asked for.
    const TemporaryFolder empty;
    EXPECT_EQ(run_program(command_line(command, use, empty.file("a" + use.ending))).status, 0) << command;
    EXPECT_TRUE(fs::exists(empty.file("a" + use.ending))) << command;
  }
  EXPECT_GE(writing, 13);
}

TEST_F(EveryCommand, RefusesAPackageWithoutAFolderAsUsage) {
  int taking = 0;
  for (const auto& [command, use] : uses()) {
    if (!offers(command, "--package")) continue;
    ++taking;
    const TemporaryFolder folder;
    for (const std::string wrong : {"robot", "=folder"}) {
      const ProgramResult result =
          run_program(with(command_line(command, use, folder.file("a" + use.ending)), {"--package", wrong}));
      EXPECT_EQ(result.status, 2) << command << result.err;
      EXPECT_THAT(result.err, HasSubstr("--package takes name=folder, not '" + wrong + "'")) << command;
    }
    EXPECT_TRUE(fs::is_empty(folder.path())) << command;
  }
  EXPECT_GE(taking, 10);
}

// A script for a shell has no JSON, a schema is JSON already.
TEST_F(EveryCommand, PrintsItsResultAsOneJsonTextAndNothingElse) {
  for (const auto& [command, use] : uses()) {
    const bool is_text_of_others = command == "completion" || command == "schema";
    EXPECT_NE(offers(command, "--json"), is_text_of_others) << command;
    if (is_text_of_others) continue;
    const TemporaryFolder folder;
    const ProgramResult told = run_program(with(command_line(command, use, folder.file("a" + use.ending)), {"--json"}));
    EXPECT_EQ(told.status, 0) << command << told.err;
    const Json json = parse_json(told.out);
    EXPECT_TRUE(json.is_object() || json.is_array()) << command << told.out;
    EXPECT_FALSE(json.empty()) << command;
    if (!use.ending.empty() && !use.to_name && use.option == "-o" && command != "extract" && command != "compare") {
      EXPECT_THAT(told.out, HasSubstr("a" + use.ending)) << command << " does not say what it wrote";
    }
    if (!offers(command, "--quiet")) continue;
    const TemporaryFolder quiet;
    const ProgramResult again =
        run_program(with(command_line(command, use, quiet.file("a" + use.ending)), {"--json", "--quiet"}));
    EXPECT_FALSE(parse_json(again.out).is_discarded()) << command << again.out;
  }
  // A name that is no text is no reason to crash.
  const TemporaryFolder odd;
  const ProgramResult told = run_program({"sheet", kCommandScene, "--json", "--width", "64", "--height", "36", "-o", odd.file("\xff.svg")});
  EXPECT_EQ(told.status, 0) << told.err;
  EXPECT_THAT(parse_json(told.out).value("file", ""), HasSubstr("\xEF\xBF\xBD.svg"));
}

// Digits from the first that is not zero to the last.
int significant_digits(const std::string& number) {
  std::string digits;
  for (const char c : number.substr(0, number.find('e')))
    if (std::isdigit(static_cast<unsigned char>(c))) digits += c;
  const std::size_t first = digits.find_first_not_of('0');
  return first == std::string::npos ? 0 : int(digits.size() - first);
}

TEST_F(EveryCommand, WritesTablesWithAllDigitsOfItsNumbers) {
  for (const auto& [command, use] : uses()) {
    if (use.ending != ".csv") continue;
    const TemporaryFolder folder;
    ASSERT_EQ(run_program(command_line(command, use, folder.file("a.csv"))).status, 0) << command;
    int most = 0;
    std::istringstream lines(read_whole_file(folder.file("a.csv")));
    for (std::string line; std::getline(lines, line);) {
      if (line.starts_with("#")) continue;
      std::istringstream fields(line);
      for (std::string field; std::getline(fields, field, ',');)
        if (parse_number(field)) most = std::max(most, significant_digits(field));
    }
    EXPECT_GE(most, 16) << command << ": a double in the middle of nowhere has 16 digits or 17";
  }
}

TEST(MotionTable, ReadsBackEqualToTheLastBit) {
  Simulation simulation;
  simulation.chain = read_chain("models/rr.urdf");
  Trajectory trajectory;
  trajectory.nq = trajectory.nv = 2;
  std::uint64_t state = 1;
  const auto next = [&state] {  // some sign, an exponent of -300 to 299, 52 bits
    state = state * 6364136223846793005u + 1442695040888963407u;
    const std::uint64_t exponent = 1023 - 300 + (state >> 33) % 600;
    return std::bit_cast<double>((state << 63) | (exponent << 52) | (state >> 12));
  };
  for (int k = 0; k < 200; ++k) {
    trajectory.t.push_back(k / 60.0);
    for (int i = 0; i < 2; ++i) trajectory.q.push_back(next()), trajectory.qd.push_back(next());
  }
  const TemporaryFolder folder;
  const DataTable written = motion_table(simulation, trajectory, {MotionColumn::t, MotionColumn::q, MotionColumn::qd});
  const Table table = read_csv(folder.write("a.csv", table_bytes(written, TableFormat::csv)));
  ASSERT_EQ(table.names, (std::vector<std::string>{"t", "q1", "q2", "qd1", "qd2"}));
  for (int k = 0; k < 200; ++k) {
    const std::vector<double> row{trajectory.t[std::size_t(k)], trajectory.q_at(k)[0], trajectory.q_at(k)[1],
                                  trajectory.qd_at(k)[0], trajectory.qd_at(k)[1]};
    for (std::size_t i = 0; i < row.size(); ++i)
      EXPECT_EQ(std::bit_cast<std::uint64_t>(table.columns[i][std::size_t(k)]),
                std::bit_cast<std::uint64_t>(row[i]))
          << k << i;
  }
}

TEST(Simulate, DoesNotMixItsTableWithItsReport) {
  const ProgramResult result = run_program(with({"simulate", kCommandScene, "-o", "-", "--json"}, kShort));
  EXPECT_EQ(result.status, 2);
  EXPECT_EQ(result.out, "");
  EXPECT_THAT(result.err, HasSubstr("-o - and --json both write to standard output"));
}

TEST(Fall, OfARunThatFailsIsExitFiveBehindItsTable) {
  const TemporaryFolder folder;
  const std::string scene =
      folder.write("s.yaml", "model: " CHAINREEL_SOURCE_FOLDER
                             "/models/pp.urdf\nduration: 1\nmethod: rk4\nstep: 0.01\ntorque: [0, 0]\n"
                             "events: [{when: \"q2 < -1\", kind: fall}]\n");
  const ProgramResult result =
      run_program({"fall", scene, "--sweep", "torque.2=0,log(0.2-t)", "-o", folder.file("a.csv")});
  EXPECT_EQ(result.status, 5) << result.err;
  EXPECT_THAT(result.out, HasSubstr("0.4515"));  // sqrt(2/9.81)
  EXPECT_THAT(result.err, HasSubstr("a run failed at torque.2=log(0.2-t)"));
  EXPECT_TRUE(fs::exists(folder.file("a.csv")));
  EXPECT_EQ(run_program({"fall", scene}).status, 0);
}

// Every key with those above it; of a list, those of its first entry.
void add_keys(const Json& json, const std::string& above, std::vector<std::string>& keys) {
  if (json.is_array() && !json.empty()) return add_keys(json.front(), above, keys);
  if (!json.is_object()) return;
  for (const auto& [key, value] : json.items()) {
    keys.push_back(above + key);
    if (key != "versions" && key != "sidecars_sha256" && key != "mechanisms") add_keys(value, above + key + ".", keys);
  }
}

std::vector<std::string> keys_of_audit(const std::string& scene, const Words& more) {
  const TemporaryFolder folder;
  const ProgramResult made =
      run_program(with({"render", "assets/scenes/" + scene + ".yaml", "--quiet", "-o", folder.file("a.gif"),
                        "--set", "video.width=64", "--set", "video.height=36", "--set", "video.fps=25"},
                       more));
  EXPECT_EQ(made.status, 0) << made.err;
  std::vector<std::string> keys;
  add_keys(Json::parse(read_whole_file(folder.file("a.json"))), "", keys);
  std::sort(keys.begin(), keys.end());
  return keys;
}

// What differs from the keys that are wanted; "" where nothing does.
std::string difference(const Words& keys, Words wanted) {
  std::sort(wanted.begin(), wanted.end());
  Words gone, come;
  std::set_difference(wanted.begin(), wanted.end(), keys.begin(), keys.end(), std::back_inserter(gone));
  std::set_difference(keys.begin(), keys.end(), wanted.begin(), wanted.end(), std::back_inserter(come));
  return (gone.empty() ? "" : "gone: " + joined(gone)) + (come.empty() ? "" : " come: " + joined(come));
}

// The audit beside a film is read by others' programs: a key that comes or goes is meant, and stands here.
TEST(Audit, HasTheKeysThatOthersRead) {
  const Words of_run{"auto",
                     "constraint_error",
                     "end_time",
                     "events",
                     "expect",
                     "fall_time",
                     "held_from_start",
                     "left_picture_at",
                     "motion",
                     "order",
                     "tolerance",
                     "torque_function",
                     "trouble",
                     "energy_error",
                     "energy_error_of_frames",
                     "energy_error_of_frames_time",
                     "energy_error_time",
                     "energy_moved",
                     "energy_start",
                     "evaluations",
                     "largest_kinetic_energy",
                     "limits_passed",
                     "method",
                     "model",
                     "model_sha256",
                     "model_elements_sha256",
                     "status",
                     "step",
                     "steps",
                     "title",
                     "trajectory_sha256",
                     "warnings"};
  const Words of_film{"held_frames",     "held_frames.first", "held_frames.last",
                      "layout",          "left_out",         "meshes_sha256",
                      "mechanisms",      "scene_path",       "set",  "tables",
                      "panels",          "pauses",           "slow_motion",
                      "style",           "view",             "view.height", "view.origin",
                      "drawn",           "drawn.film_seconds", "drawn.fps",
                      "drawn.frames",    "drawn.height",     "drawn.width",
                      "outputs.film_seconds",
                      "duration",        "film_seconds",     "fps",
                      "frames",          "height",           "scene",
                      "outputs",         "outputs.bytes",    "outputs.file",
                      "outputs.fps",     "outputs.frames",   "outputs.height",
                      "outputs.sha256",  "outputs.width",
                      "seconds",         "seconds.draw",     "seconds.encode",
                      "seconds.render",  "seconds.simulate", "seconds.total",
                      "sidecars_sha256", "versions",         "width"};
  const Words plain = with(of_run, of_film), brief{"--set", "duration=0.2"};
  EXPECT_EQ(difference(keys_of_audit("rr_free", brief), plain), "");
  EXPECT_EQ(difference(keys_of_audit("humanoid_fall", {"--set", "duration=2"}),
                       with(plain, {"events.kind", "events.name", "events.q", "events.qd", "events.t",
                                    "slow_motion.because", "slow_motion.ease", "slow_motion.film_from", "slow_motion.film_until",
                                    "slow_motion.from", "slow_motion.speed", "slow_motion.until"})),
            "");
  // On a page this small its plots below the scene leave no room for all that it draws.
  const Words crowded{"--set", "duration=0.2", "--set", "layout=scene-below"};
  EXPECT_EQ(difference(keys_of_audit("pen", crowded), with(plain, {"auto.accuracy",
                                                                 "auto.attainable",
                                                                 "auto.cost_to_end_ns",
                                                                 "auto.counted_until",
                                                                 "auto.tried",
                                                                 "auto.trouble",
                                                                 "auto.why_until",
                                                                 "auto.cost_ns",
                                                                 "auto.curve",
                                                                 "auto.curve_error",
                                                                 "auto.error",
                                                                 "auto.error_unit",
                                                                 "auto.evaluations",
                                                                 "auto.holds_until",
                                                                 "auto.is_met",
                                                                 "auto.out_of_budget",
                                                                 "auto.reference",
                                                                 "auto.reference_uncertainty",
                                                                 "auto.remarks",
                                                                 "auto.setting",
                                                                 "auto.spent",
                                                                 "auto.steps",
                                                                 "constraint_error.force_at_end",
                                                                 "constraint_error.force_at_end.constraint",
                                                                 "constraint_error.force_at_end.force",
                                                                 "constraint_error.force_at_start",
                                                                 "constraint_error.force_at_start.constraint",
                                                                 "constraint_error.force_at_start.force",
                                                                 "constraint_error.position_error",
                                                                 "constraint_error.rows",
                                                                 "constraint_error.rows.largest_lambda", "constraint_error.rows.largest_lambda_signed", "constraint_error.rows.largest_lambda_time",
                                                                 "constraint_error.rows.name",
                                                                 "constraint_error.stabilize",
                                                                 "constraint_error.velocity_error"})),
            "");
  Words panels = with(of_film, {"title"});
  for (const std::string& key : of_run) panels.push_back("panels." + key);
  panels.push_back("warnings");
  EXPECT_EQ(difference(keys_of_audit("rr_free", with(brief, {"--vary", "method=rk4,verlet"})), panels), "");
  EXPECT_EQ(
      difference(
          keys_of_audit("rr_free", with(brief, {"--set", "slow_motion=[{from: 0.05, until: 0.1, speed: 0.5}]",
                                                "--hold", "{last: 0.1}"})),
          with(plain, {"slow_motion.because", "slow_motion.ease", "slow_motion.film_from", "slow_motion.film_until",
                       "slow_motion.from", "slow_motion.speed", "slow_motion.until"})),
      "");
}

}  // namespace
}  // namespace chainreel
