// chainreel init NAME: a commented scene and its model to start from: of a chain in a few numbers, or a copy of what comes
// with the program.

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <memory>

#include "app/cli/command.hpp"
#include "app/cli/result.hpp"
#include "app/cli/shell_word.hpp"
#include "core/data_folder.hpp"
#include "app/commands/dh_table.hpp"
#include "app/commands/starter_files.hpp"
#include "core/error.hpp"
#include "core/format.hpp"
#include "core/input_file.hpp"
#include "core/json.hpp"
#include "core/output_file.hpp"
#include "model/link_chain.hpp"
#include "model/read_chain.hpp"
#include "scene/keys/keys.hpp"
#include "scene/text/read_scene.hpp"
#include "scene/text/scene_paths.hpp"

namespace chainreel {
namespace {

constexpr std::size_t kLargestCopy = std::size_t(16) << 20;  // bytes

struct InitOptions {
  std::string name;
  std::string links, masses, joints, damping, shape, dh, convention;  // of a chain in numbers
  std::string from;
  CommonOptions common;
};

// Short names of scenes to begin with.
struct Beginning {
  const char* name;
  const char* scene;
};
constexpr Beginning kBeginnings[] = {{"rr", "rr_free"},       {"rrr", "rrr_torque"},         {"pp", "pp_spring"},
                                     {"four_bar", "four_bar"}, {"pen", "pen"},               {"humanoid", "humanoid_fall"},
                                     {"compare", "euler_gains_energy"}};

std::vector<std::string> names_of_beginnings() {
  std::vector<std::string> names;
  for (const Beginning& one : kBeginnings) names.push_back(one.name);
  return names;
}

void replace_all(std::string& text, const std::string& mark, const std::string& by) {
  for (std::size_t at = text.find(mark); at != std::string::npos; at = text.find(mark, at + by.size()))
    text.replace(at, mark.size(), by);
}

// Each "#@key" becomes what the table of keys says of it: "# of the motion, s".
std::string with_comments(std::string text) {
  const std::string mark = "#@";
  for (std::size_t at = text.find(mark); at != std::string::npos; at = text.find(mark, at)) {
    const std::size_t end = text.find('\n', at);
    const SceneKey& key = *find_key(text.substr(at + mark.size(), end - at - mark.size()));
    text.replace(at, end - at, "# " + key.help + (key.unit.empty() ? "" : ", " + key.unit));
  }
  return text;
}

// Whether they describe a chain of their own.
bool is_in_numbers(const InitOptions& options) {
  return !(options.links + options.masses + options.joints + options.damping + options.shape + options.dh + options.convention).empty();
}

// The options' numbers, complete.
LinkChain chain_of(const InitOptions& options) {
  LinkChain chain;
  if (!options.links.empty()) chain.links = parse_list(options.links, "--links", "m");
  if (!options.masses.empty()) chain.masses = parse_list(options.masses, "--masses", "kg");
  if (!options.damping.empty()) chain.damping = parse_list(options.damping, "--damping", "N m s/rad or N s/m");
  if (!options.shape.empty()) chain.shape = *value_named<LinkMass>(options.shape);
  if (!options.convention.empty()) chain.convention = *value_named<DhConvention>(options.convention);
  chain.joints = options.joints;
  if (!options.dh.empty()) {
    DhTable table = read_dh_table(options.dh);
    chain.dh = std::move(table.rows);
    if (!table.masses.empty() && !chain.masses.empty())
      throw Error(ExitCode::usage, "--masses and the column mass of " + options.dh + " both say the masses: leave one out");
    if (!table.masses.empty()) chain.masses = std::move(table.masses);
  } else if (!options.convention.empty()) {
    throw Error(ExitCode::usage, "--convention is of --dh, and means nothing without it");
  }
  // As many links as any other list has; two where nothing says how many.
  if (options.links.empty() && options.dh.empty()) {
    const auto letters = std::count_if(options.joints.begin(), options.joints.end(), [](char c) { return c == 'R' || c == 'P'; });
    const std::size_t most = std::max({chain.masses.size(), chain.damping.size(), std::size_t(letters)});
    chain.links.assign(most > 1 || letters == 1 ? std::min(most, kMostLinks + 1) : 2, 1.0);
  }
  std::vector<Problem> problems;
  for (const LinkProblem& problem : complete(chain))
    problems.push_back({"--" + problem.key + " " + problem.message, {}});
  if (!problems.empty()) throw Error(ExitCode::usage, std::move(problems));
  return chain;
}

std::string list_of(const std::vector<std::string>& words) {
  return "[" + joined(words) + "]";
}

// A start out of the stretched pose, and a damper on the last joint, which is only shown in comments where the chain moves freely.
std::string scene_of(const LinkChain& chain, const std::string& name, bool is_in_plane, bool moves_freely) {
  std::vector<std::string> q, qd(chain.size(), "0");
  for (const char letter : chain.joints) {
    if (letter != 'R' && letter != 'P') continue;
    const bool turns = letter == 'R';
    q.push_back(!turns ? "0" : q.empty() ? "-60deg" : q.size() == 1 ? "40deg" : "20deg");
  }
  const std::string last = std::to_string(chain.size());
  std::string torque;
  for (std::size_t i = 1; i < chain.size(); ++i) torque += "  - 0\n";
  torque += "  - -k * qd" + last + "                 # t, q1.., qd1.., x_G y_G z_G, xd_G yd_G zd_G, the parameters";
  std::string text = kStarterScene;
  if (moves_freely) {  // an example for those who want one
    replace_all(text, "parameters: {k: 0.2} ", "# parameters: {k: 0.2} ");
    replace_all(text, "torque:  ", "# torque:  ");
    replace_all(torque, "  - ", "#   - ");
  }
  replace_all(text, "@Q@", list_of(q));
  replace_all(text, "@QD@", list_of(qd));
  replace_all(text, "@TORQUE@", torque);
  replace_all(text, "@GRAVITY@",
              is_in_plane ? "gravity: [0, -9.81, 0]        #@gravity" : "gravity: [0, 0, -9.81]        #@gravity");
  if (chain.size() == 1) replace_all(text, "draw: [+ellipse, +legend]", "draw: [+legend]          ");
  text = with_comments(std::move(text));
  replace_all(text, "@NAME@", name);
  return text;
}

struct StarterFiles {
  std::string scene, model;
};

StarterFiles files_of_chain(const InitOptions& options, const std::string& name) {
  const LinkChain chain = chain_of(options);
  ModelSource source("the chain");
  source.place = {name};
  source.links = chain;
  const Chain read = read_chain(source);  // what moves no mass is told before anything is written
  return {scene_of(chain, name, read.gravity.y() != 0, is_in_numbers(options)), urdf_of(chain, name)};
}

// A scene of the program's and its model, which then lies beside it.
StarterFiles copied_files(const std::string& from, const std::string& name) {
  const auto known = std::find_if(std::begin(kBeginnings), std::end(kBeginnings), [&](const Beginning& one) { return one.name == from; });
  const std::string path = shipped_file(known != std::end(kBeginnings) ? known->scene : from);
  if (!path.ends_with(".yaml")) {
    const std::vector<std::string> scenes = shipped_scenes();
    if (scenes.empty())
      throw Error(ExitCode::bad_input, "the scenes that come with the program are not beside it: install it whole, or take --links");
    const std::vector<std::string> beginnings = names_of_beginnings();
    std::vector<std::string> names = scenes;
    names.insert(names.end(), beginnings.begin(), beginnings.end());
    throw Error(ExitCode::usage, "--from knows no scene '" + from + "':" + did_you_mean(from, names) + " " + joined(beginnings) +
                                     ", or any that lies in " + data_folder() + "/assets/scenes");
  }
  const Scene scene = read_scene(path);
  const ModelSource& model = scene.compare.empty() ? scene.model : scene.compare.front().model;
  return {scene_with_model(read_plain_file(path, kLargestCopy), name + ".urdf"), read_plain_file(model.path, kLargestCopy)};
}

void run_init(const InitOptions& options) {
  std::filesystem::path base(options.name);
  if (base.extension() == ".yaml" || base.extension() == ".urdf") base.replace_extension();
  const std::string name = base.filename().string();
  if (name.empty() || name.find_first_of("<>&\"'\\\n") != std::string::npos || name.front() == '-')
    throw Error(ExitCode::usage, "'" + options.name + "' cannot name a scene: take letters, digits, - and _");
  if (!options.from.empty() && is_in_numbers(options))
    throw Error(ExitCode::usage, "--from copies a scene with its model: --links, --dh and what goes with them describe another one");
  const StarterFiles files = options.from.empty() ? files_of_chain(options, name) : copied_files(options.from, name);
  // Both are opened before either is written: an existing one keeps both as they are.
  OutputFile scene(base.string() + ".yaml", options.common.force);
  OutputFile model(base.string() + ".urdf", options.common.force);
  write_whole(model, files.model);
  write_whole(scene, files.scene);
  tell_result(options.common, [&] { return files_json({scene.path(), model.path()}); }, [&] {
    std::printf("%s\n%s\nNext: chainreel render %s\n", scene.path().c_str(), model.path().c_str(), shell_word(scene.path()).c_str());
  });
}

}  // namespace

void add_init_command(CommandLine& app) {
  auto options = std::make_shared<InitOptions>();
  Command* command = app.add_subcommand("init", "write a commented scene and model to start from");
  command->add_option("name", options->name, "NAME gives NAME.yaml and NAME.urdf").required();
  command->add_option("--links", options->links, "a chain of links of these lengths, m: 0.5,0.4,0.3");
  command->add_option("--masses", options->masses, "of the links, kg: 2,1.5,1, or one for all");
  command->add_option("--joints", options->joints, "a letter a joint: R turns, P slides, maybe with its axis: RRP, RzPx");
  command->add_option("--damping", options->damping, "of the joints, N m s/rad or N s/m: 0.1, or one each");
  command->add_option("--shape", options->shape, "where the mass of a link is: along it, or at its end")
      .one_of(words_of(names_of(LinkMass{})));
  command->add_option("--dh", options->dh, "a table (.csv) of a, alpha, d, theta in the place of --links");
  command->add_option("--convention", options->convention, "of --dh").one_of(words_of(names_of(DhConvention{})));
  command->add_option("--from", options->from,
                      "copy a scene that comes with the program: " + joined(names_of_beginnings()) + ", ..");
  add_result_options(*command, options->common);
  command->footer("Example: chainreel init my_arm --links 0.5,0.4,0.3 --masses 2,1.5,1 --damping 0.1");
  command->callback([options] { run_init(*options); });
}

}  // namespace chainreel
