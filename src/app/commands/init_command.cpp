// chainreel init NAME: a commented scene and its model to start from.

#include <cstdio>
#include <filesystem>
#include <memory>

#include "app/cli/command.hpp"
#include "app/commands/starter_files.hpp"
#include "core/error.hpp"
#include "core/json.hpp"
#include "core/output_file.hpp"
#include "scene/keys/keys.hpp"

namespace chainreel {
namespace {

struct InitOptions {
  std::string name;
  CommonOptions common;
};

std::string with_name(std::string text, const std::string& name) {
  const std::string mark = "@NAME@";
  for (std::size_t at = text.find(mark); at != std::string::npos; at = text.find(mark, at + name.size()))
    text.replace(at, mark.size(), name);
  return text;
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

void run_init(const InitOptions& options) {
  std::filesystem::path base(options.name);
  if (base.extension() == ".yaml" || base.extension() == ".urdf") base.replace_extension();
  const std::string name = base.filename().string();
  if (name.empty() || name.find_first_of("<>&\"'") != std::string::npos)
    throw Error(ExitCode::usage, "'" + options.name + "' cannot name a scene: take letters, digits, - and _");
  // Both are opened before either is written: an existing one keeps both as they are.
  OutputFile scene(base.string() + ".yaml", options.common.force);
  OutputFile model(base.string() + ".urdf", options.common.force);
  write_whole(model, with_name(kStarterModel, name));
  write_whole(scene, with_name(with_comments(kStarterScene), name));
  if (options.common.json)
    std::puts(Json{{"files", {scene.path(), model.path()}}}.dump(2).c_str());
  else if (!options.common.quiet)
    std::printf("%s\n%s\nNext: chainreel render %s\n", scene.path().c_str(), model.path().c_str(),
                scene.path().c_str());
}

}  // namespace

void add_init_command(CommandLine& app) {
  auto options = std::make_shared<InitOptions>();
  Command* command = app.add_subcommand("init", "write a commented scene and model to start from");
  command->add_option("name", options->name, "NAME gives NAME.yaml and NAME.urdf").required();
  add_result_options(*command, options->common);
  command->footer("Example: chainreel init my_arm");
  command->callback([options] { run_init(*options); });
}

}  // namespace chainreel
