// What a message advises can be typed as it stands: each is called forth, its remedy is taken from its words and typed.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <regex>
#include <set>
#include <sstream>

#include "support/run_program.hpp"
#include "support/temporary_folder.hpp"

namespace chainreel {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::Not;

enum class Typed {
  behind,   // the words go behind the command
  line,     // a line of the scene: in the place of what that key said, else behind it
  order,    // a command line of its own, without its first word "chainreel"
  without,  // the flags go, with what they were given
  ending,   // of what -o names
  value,    // in the scene, in the place of `fill`
  csv,      // beside `csv:`
  given,    // to the flag `fill`, in the place of what that was given
};

struct Remedy {
  std::string name;
  Words words;          // with SCENE, MODEL and OUT for files of the folder
  std::string said;     // a regular expression; what it captures is typed, each capture in its turn
  Typed typed;
  std::string scene = "method: rk4\nstep: 0.01\nduration: 0.1\n";  // behind the line of its model
  std::string fill{};   // in the place of NAME, FOLDER, TIME or [..] in the remedy; or behind it where none of these stands there
  Words beside{};       // typed with it: flags that were wrong are left out by their name
  int status = 0;       // then
};

std::string one_link(const std::string& name, const std::string& shape, bool has_mass) {
  return "<link name='" + name + "'>" + (shape.empty() ? "" : "<visual><geometry><mesh filename='" + shape + "'/></geometry></visual>") +
         (has_mass ? "<inertial><origin xyz='1 0 0'/><mass value='1'/><inertia ixx='1' iyy='1' izz='1' ixy='0' ixz='0' iyz='0'/></inertial>" : "") +
         "</link>";
}
std::string one_joint(const std::string& child) {
  return "<joint name='j" + child + "' type='continuous'><parent link='w'/><child link='" + child + "'/><axis xyz='0 0 1'/></joint>";
}
std::string robot(const std::string& parts) {
  return "<robot name='r'><link name='w'/>" + parts + "</robot>";
}

// Words as a shell takes them: blanks part them but in quotes.
Words shell_words(const std::string& text) {
  Words words;
  bool is_open = false;
  char quote = 0;
  for (const char c : text) {
    if (quote == 0 && (c == ' ' || c == '\n')) {
      is_open = false;
    } else {
      if (!is_open) words.emplace_back();
      is_open = true;
      if (quote == 0 && (c == '\'' || c == '"'))
        quote = c;
      else if (c == quote)
        quote = 0;
      else
        words.back() += c;
    }
  }
  return words;
}

std::string every_replaced(std::string text, const std::string& what, const std::string& by) {
  for (std::size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + by.size())) text.replace(at, what.size(), by);
  return text;
}

// The flag with what it was given, if it was given anything.
Words without(Words words, const std::string& flag) {
  const auto at = std::find_if(words.begin(), words.end(), [&](const std::string& word) { return word == flag; });
  if (at == words.end()) return words;
  const bool has_value = at + 1 != words.end() && !(at + 1)->starts_with("--") && *(at + 1) != "-o";
  words.erase(at, at + (has_value ? 2 : 1));
  return words;
}

class Remedies : public testing::TestWithParam<Remedy> {
 protected:
  Remedies() {
    folder_.write("two.urdf", robot(one_link("a", "", true) + one_joint("a") + one_link("b", "", true) + one_joint("b")));
    folder_.write("far.urdf", robot(one_link("a", "package://parts/a.stl", true) + one_joint("a")));
    folder_.write("mesh.urdf", robot(one_link("a", "a.stl", true) + one_joint("a")));
    folder_.write("light.urdf", robot(one_link("a", "", false) + one_joint("a")));
    folder_.write("free.urdf", "<robot name='r'>" + one_link("w", "", true) + one_link("a", "", true) + one_joint("a") + "</robot>");
    folder_.write("move.csv", "t,q1\n0,0\n0.1,0.1\n0.2,0.2\n");
    folder_.write("log.csv", "stamp,q1,q2\n0,0,0\n0.1,0.1,0\n0.2,0.2,0\n");
    folder_.write("push.csv", "t,tau1,tau2\n0,0,0\n0.05,1,0\n");
    fs::create_directory(folder_.file("parts"));
    std::ofstream(folder_.file("parts/a.stl")) << "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\nendsolid a\n";
    for (const char* name : {"rr.urdf", "rrr.urdf"}) fs::copy_file(fs::path("models") / name, folder_.file(name));
  }

  Words filled(Words words) const {
    for (std::string& word : words) {
      word = every_replaced(word, "SCENE", "s.yaml");
      word = every_replaced(word, "MODEL", "rr.urdf");
    }
    return words;
  }
  ProgramResult run(const Words& words) const { return run_program(words, {.folder = folder_.path().string()}); }
  void write_scene(const std::string& text) const {
    folder_.write("s.yaml", (text.find("model:") == std::string::npos ? "model: rr.urdf\n" : "") + text);
  }

  TemporaryFolder folder_;
};

// With the line in the place of the key's own, up to the next key.
std::string with_line(const std::string& scene, const std::string& line) {
  const std::string key = line.substr(0, line.find(':') + 1);
  std::string result;
  bool is_of_key = false;
  std::istringstream lines(scene);
  for (std::string one; std::getline(lines, one);) {
    if (!one.starts_with(' ')) is_of_key = one.starts_with(key);
    if (!is_of_key) result += one + "\n";
  }
  return result + line + "\n";
}

TEST_P(Remedies, AreTypedAsTheyStand) {
  const Remedy& one = GetParam();
  write_scene(one.scene);
  const Words words = filled(one.words);
  const ProgramResult first = run(words);
  const std::string told = first.err + first.out;
  std::smatch found;
  ASSERT_TRUE(std::regex_search(told, found, std::regex(one.said))) << told;
  const std::string complaint = found.str(0);
  ASSERT_GT(found.size(), 1u);
  for (std::size_t i = 1; i < found.size(); ++i) {
    std::string remedy = found.str(i);
    const std::string before = remedy;
    for (const char* blank : {"NAME", "FOLDER", "TIME", "[..]"}) remedy = every_replaced(remedy, blank, one.fill);
    const bool has_blank = remedy != before;
    Words again = words;
    switch (one.typed) {
      case Typed::behind:
        again = with(again, shell_words(remedy));
        if (!has_blank && !one.fill.empty()) again.push_back(one.fill);
        break;
      case Typed::line:
        write_scene(one.scene.starts_with("- ") ? remedy + "\n" : with_line(one.scene, remedy));
        break;
      case Typed::order:
        again = shell_words(remedy);
        ASSERT_EQ(again.front(), "chainreel");
        again.erase(again.begin());
        break;
      case Typed::without:
        for (const std::string& flag : shell_words(remedy)) again = without(again, flag);
        break;
      case Typed::value:
        write_scene(every_replaced(one.scene, one.fill, remedy));
        break;
      case Typed::csv:
        write_scene(every_replaced(one.scene, ".csv", ".csv, " + remedy));
        break;
      case Typed::given:
        *(std::find(again.begin(), again.end(), one.fill) + 1) = remedy;
        break;
      case Typed::ending:
        for (std::string& word : again)
          if (word.starts_with("out")) word = "out" + std::to_string(i) + remedy;  // with sidecars of its own
        break;
    }
    for (const std::string& word : one.beside) again = without(again, word);
    const ProgramResult then = run(again);
    std::string line;
    for (const std::string& word : again) line += " " + word;
    EXPECT_EQ(then.status, one.status) << "chainreel" << line << "\n" << then.err;
    EXPECT_THAT(then.err + then.out, Not(HasSubstr(complaint))) << "chainreel" << line;
  }
}

const std::string kChosen = "duration: 0.1\n";  // method: auto
const std::string kPanels = "duration: 0.1\ncompare:\n  - {method: rk4, step: 0.01}\n  - {method: verlet, step: 0.01}\n";

std::vector<Remedy> remedies() {
  std::vector<Remedy> all{
      {"package_of_a_model", {"check", "far.urdf"}, "say where the package lies with `([^`]*)`", Typed::behind, "", "parts"},
      {"mass_of_a_model", {"dynamics", "light.urdf"}, "a small mass \\(kg\\) with `([^`]*)`", Typed::behind, ""},
      {"mass_of_a_scene", {"check", "SCENE"}, "in a scene `(massless[^`]*)`", Typed::line, "model: light.urdf\n" + kChosen},
      {"end_effector_of_a_model", {"ellipse", "two.urdf", "--pose", "0,0", "-o", "out.svg"}, "`(--set end_effector=NAME)`", Typed::behind, "", "a"},
      {"end_effector_of_a_scene", {"snapshot", "SCENE", "-o", "out.svg", "--force"}, "`(--set end_effector=NAME)`", Typed::behind,
       "model: two.urdf\nmethod: rk4\nduration: 0.1\n", "a"},
      {"end_effector_of_numbers", {"dynamics", "two.urdf"}, "choose one with (--end-effector NAME)", Typed::behind, "", "a"},
      {"end_effector_of_columns", {"simulate", "SCENE", "-o", "out.csv", "--force", "--columns", "x_G"}, "`(--set end_effector=NAME)`",
       Typed::behind, "model: two.urdf\nmethod: rk4\nduration: 0.1\n", "a"},
      {"end_effector_along", {"ellipse", "--along", "SCENE", "--end-effector", "a", "-o", "out.svg"}, "(--set end_effector=a)", Typed::behind,
       "model: two.urdf\nmethod: rk4\nduration: 0.1\n", "", {"--end-effector"}},
      {"method_of_a_map", {"stability", "SCENE", "--x", "start.q.1=0:1:2", "--y", "start.q.2=0:1:2", "-o", "out.csv"},
       "name one, like (--set method=rk4)", Typed::behind, "start: {q: [0, 0]}\n" + kChosen},
      {"auto_of_check", {"check", "SCENE", "--all"}, "take (--set method=auto --set motion=)", Typed::behind},
      {"auto_of_a_motion", {"check", "SCENE", "--all"}, "take (--set method=auto --set motion=)", Typed::behind,
       "motion: {csv: log.csv, columns: {time: stamp}}\n"},
      {"axis_of_a_map", {"stability", "SCENE", "-o", "out.png"}, "written as (\\.csv), (\\.json) or (\\.npz)", Typed::ending},
      {"format_of_a_chart", {"energy", "SCENE", "--methods", "rk4", "-o", "out.xlsx"},
       "written as (\\.png), (\\.svg) or (\\.pdf), their numbers as (\\.csv), (\\.json) or (\\.npz)", Typed::ending},
      {"format_of_a_table", {"simulate", "SCENE", "-o", "out.xlsx"}, "written as (\\.csv), (\\.json), (\\.npz)", Typed::ending},
      {"format_of_joint_space", {"ellipse", "MODEL", "--pose", "0,1", "--joint-space", "-o", "out.npz"},
       "written as (\\.png), (\\.svg) or (\\.pdf), its numbers as (\\.json)", Typed::ending, ""},
      {"format_with_opacity", {"render", "SCENE", "--set", "layout=transparent", "-o", "out.mp4", "--set", "video.width=64", "--set", "video.height=36"},
       "take (\\.webm), (\\.mov), (\\.apng), (\\.png), (\\.svg) or (\\.pdf)", Typed::ending},
      {"poses_of_an_ellipse", {"ellipse", "MODEL", "-o", "out.svg", "--force"}, "Give (--pose [^ ,]*,[^ ]*), (--sweep [^ ,]*), --along SCENE or (--field)",
       Typed::behind, ""},
      {"joints_of_an_ellipse", {"ellipse", "rrr.urdf", "--joint-space", "--pose", "0,0,0", "-o", "out.svg"}, "like (--joints 1,2)", Typed::behind, ""},
      {"layout_of_letters", {"ellipse", "MODEL", "--pose", "0,1", "--letters", "--layout", "superposed", "-o", "out.svg", "--force"},
       "else take (--layout grid)", Typed::behind, "", "", {"--layout"}},
      {"size_on_paper", {"ellipse", "MODEL", "--pose", "0,1", "--width-mm", "84", "--width", "200", "--height", "200", "-o", "out.svg"},
       "leave out (--width and --height)", Typed::without, ""},
      {"field_without_layout", {"ellipse", "MODEL", "--field", "--layout", "grid", "-o", "out.svg"}, "leave out (--layout)", Typed::without, ""},
      {"least_tolerance", {"energy", "SCENE", "--methods", "dop853", "--tolerance", "1e-20", "-o", "out.csv"}, "take ([^ \n]*) or more", Typed::given,
       kChosen, "--tolerance"},
      {"state_of_a_scene", {"dynamics", "SCENE", "--q", "0,0"}, "take (--set 'start.q=\\[\\.\\.\\]') and (--set 'torque=\\[\\.\\.\\]')", Typed::behind,
       "start: {q: [1, 1]}\nmethod: rk4\nduration: 0.1\n", "[0, 0]", {"--q"}},
      {"pose_of_a_model", {"snapshot", "MODEL", "--at", "1", "-o", "out.svg"}, "a model stands still at (--pose)", Typed::behind, "", "0,1", {"--at"}},
      {"instant_of_a_scene", {"snapshot", "SCENE", "--pose", "0,0", "-o", "out.svg"}, "a scene takes (--at)", Typed::behind,
       "method: rk4\nduration: 0.1\n", "0.05", {"--pose"}},
      {"look_of_a_sheet", {"sheet", "SCENE", "-o", "out.png", "--set", "theme=dark"}, "take (--theme)", Typed::behind, "method: rk4\nduration: 0.1\n",
       "dark", {"--set"}},
      {"size_of_a_sheet", {"sheet", "SCENE", "-o", "out.png", "--force", "--set", "video.width=64"}, "take (--width), (--height) and --columns", Typed::behind,
       "method: rk4\nduration: 0.1\n", "640", {"--set"}},
      {"gravity_of_a_model", {"dynamics", "MODEL", "--gravity", "0,-9.81"}, "world x,y,z: (--gravity 0,-9.81,0)", Typed::behind, "", "", {"--gravity"}},
      {"example_of_set", {"check", "SCENE", "--set", "duration"}, "for example (--set duration=2)", Typed::behind, kChosen, "", {"--set"}},
      {"base_of_inverse", {"inverse", "free.urdf", "--base", "floating", "--trajectory", "move.csv", "-o", "out.csv"}, "take (--base fixed)", Typed::behind, "", "",
       {"--base"}},
      {"base_of_equations", {"equations", "free.urdf", "--base", "floating"}, "take (--base fixed)", Typed::behind, "", "", {"--base"}},
      {"chunks_of_a_gif", {"render", "SCENE", "-o", "out.gif", "--resume"}, "render it without (--resume)", Typed::without,
       "method: rk4\nduration: 0.1\nvideo: {width: 64, height: 36}\n"},
      {"frames_or_shard", {"render", "SCENE", "-o", "out.mp4", "--frames", "0:6", "--shard", "1/2"}, "(--frames) and (--shard) both say", Typed::without,
       "method: rk4\nduration: 0.1\nvideo: {width: 64, height: 36}\n"},
      {"outside_a_table", {"check", "SCENE"}, "write `(outside: hold)` beside the table", Typed::csv, "method: rk4\nduration: 0.1\ntorque: {csv: push.csv}\n"},
      {"no_model", {"check", "SCENE"}, "`(model: \\{links[^`]*)`", Typed::line, "model:\nmethod: rk4\nduration: 0.1\n"},
      {"no_scene", {"check", "SCENE"}, "`(chainreel init [^`]*)`", Typed::order, "- model: a list\n"},
      {"no_keys", {"check", "SCENE"}, "write `(model: [^`]*)`", Typed::line, "- model: a list\n"},
      {"constraints_of_a_method", {"check", "SCENE"}, "or `(method: auto)`", Typed::line,
       "method: verlet\nduration: 0.1\nconstraints: [{line: {frame: gripper, point: [0, 0], direction: [1, 0]}}]\n"},
      {"both_of_two_comparisons", {"check", "SCENE"}, "write `([^`]*)` for both", Typed::value,
       "method: rk4\nduration: 0.1\nevents: [{when: \"(q1 > 1) * (t > 2)\"}]\n", "(q1 > 1) * (t > 2)"},
      {"overwrite_a_film", {"simulate", "SCENE", "-o", "log.csv"}, "give (--force) to overwrite", Typed::behind},
      {"panel_of_a_table", {"simulate", "SCENE", "-o", "-"}, "choose one with (--panel)", Typed::behind, kPanels, "1"},
      {"time_of_a_table", {"check", "SCENE"}, "beside `csv:` say `(columns: \\{time: NAME\\})`", Typed::csv, "motion: {csv: log.csv}\n", "stamp"},
      {"layout_of_bench", {"bench", "SCENE"}, "take (--set layout=auto)", Typed::behind,
       "method: rk4\nstep: 0.01\nduration: 0.05\nlayout: transparent\nvideo: {width: 64, height: 36}\n"},
      {"preset_of_bench", {"bench", "SCENE"}, "take (--set video.preset=slides)", Typed::behind,
       "method: rk4\nstep: 0.01\nduration: 0.05\nvideo: {width: 64, height: 36, preset: overlay}\n"},
      {"no_scene_of_fall", {"fall", "SCENE"}, "like (events: .*)", Typed::line, "method: rk4\nstep: 0.01\nduration: 0.1\n"}};
  return all;
}

INSTANTIATE_TEST_SUITE_P(All, Remedies, testing::ValuesIn(remedies()), [](const auto& param) { return param.param.name; });

// Every flag that stands in a message of a command's own file is one that the command has.
TEST(RemediesInSources, NameFlagsThatTheCommandHas) {
  std::size_t flags = 0;
  for (const fs::directory_entry& entry : fs::directory_iterator("src/app/commands")) {
    const std::string file = entry.path().filename().string();
    const std::string ending = "_command.cpp";
    if (!file.ends_with(ending) || file == "help_command.cpp") continue;
    const std::string command = file.substr(0, file.size() - ending.size());
    const ProgramResult help = run_program({command, "--help"});
    ASSERT_EQ(help.status, 0) << command;
    std::istringstream lines(read_whole_file(entry.path().string()));
    int number = 0;
    for (std::string line; std::getline(lines, line);) {
      ++number;
      const std::size_t comment = line.find("//");
      if (comment != std::string::npos && line.find('"') > comment) continue;
      if (line.find("footer") != std::string::npos || line.find("Example") != std::string::npos || line.find("chainreel ") != std::string::npos) continue;
      const std::regex text("\"((?:[^\"\\\\]|\\\\.)*)\""), flag("--[a-z][a-z-]+");
      for (std::sregex_iterator one(line.begin(), line.end(), text), end; one != end; ++one) {
        const std::string words = one->str(1);
        for (std::sregex_iterator word(words.begin(), words.end(), flag); word != end; ++word, ++flags)
          EXPECT_TRUE(std::regex_search(help.out, std::regex(word->str() + "\\b")))
              << file << ":" << number << ": `" << command << "` has no " << word->str();
      }
    }
  }
  EXPECT_GT(flags, 100u) << "a test that finds none";
}

// And every order that one gives is of a command that there is.
TEST(RemediesInSources, NameCommandsThatThereAre) {
  const ProgramResult help = run_program({"--help"});
  std::set<std::string> seen;
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator("src")) {
    if (entry.path().extension() != ".cpp") continue;
    const std::string text = read_whole_file(entry.path().string());
    const std::regex order("`chainreel ([a-z]+)");
    for (std::sregex_iterator one(text.begin(), text.end(), order), end; one != end; ++one)
      if (seen.insert(one->str(1)).second)
        EXPECT_TRUE(std::regex_search(help.out, std::regex("\\b" + one->str(1) + "\\b"))) << entry.path() << ": " << one->str(0);
  }
  EXPECT_GT(seen.size(), 5u);
}

}  // namespace
}  // namespace chainreel
