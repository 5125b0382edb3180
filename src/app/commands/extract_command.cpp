// chainreel extract CLIP [-o SCENE.yaml]

#include <cstdio>
#include <filesystem>
#include <memory>

#include "app/cli/command.hpp"
#include "app/cli/result.hpp"
#include "app/film/clip_memory.hpp"
#include "app/film/clip_origin.hpp"
#include "core/error.hpp"
#include "core/format.hpp"
#include "core/input_file.hpp"
#include "core/output_file.hpp"
#include "scene/text/scene_paths.hpp"

namespace chainreel {
namespace {

namespace fs = std::filesystem;

struct ExtractOptions {
  std::string clip;
  std::string output;
  std::string from;
  CommonOptions common;
};

// The models must be there, and what they were, for the same frames to come again.
void tell_of_files(const ClipOrigin& origin, const ExtractOptions& options) {
  for (const std::string& path : origin.missing)
    std::fprintf(stderr,
                 "%s: there is no %s here, nor in folders around: name that in which its paths start, where the scene or "
                 "model lay, with --from\n",
                 options.clip.c_str(), path.c_str());
  for (const std::string& path : origin.changed)
    std::fprintf(stderr, "%s: the model %s has changed since: frames may differ\n", options.clip.c_str(), path.c_str());
}

// Which program made it; and under which name its scene lay, which files bear, too.
void tell_of_origin(const Json& audit, const ExtractOptions& options) {
  if (options.common.json || !audit.is_object()) return;
  const std::string version = word_of(audit.value("versions", Json()), "chainreel"), scene = word_of(audit, "scene");
  const std::string name = fs::path(scene).stem().string();
  if (!name.empty() && !options.output.empty() && fs::path(options.output).stem() != name)
    std::fprintf(stderr, "note: chainreel %s made it of a scene called %s: files bear that name and the paths of their models, so that under others their frames are the same, but not their bytes\n",
                 printable(version).c_str(), printable(fs::path(scene).filename().string()).c_str());
}

// A clip has a scene and its audit, a figure its command.
Json report_of(Json scene, Json audit, Json command, Json figure, const ExtractOptions& options) {
  Json json{{"scene", std::move(scene)}, {"audit", std::move(audit)}, {"command", std::move(command)}, {"figure", std::move(figure)}};
  json.update(files_json(options.output.empty() ? std::vector<std::string>{} : std::vector{options.output}));
  return json;
}

// A figure shows no scene, a sheet many: what made it is said instead.
void tell_of_figure(const ExtractOptions& options, const Json& figure) {
  if (!options.output.empty())
    throw Error(ExitCode::bad_input, "is a figure, not a scene; it was made by: " + command_line(figure),
                {options.clip});
  tell_result(options.common, [&] { return report_of(nullptr, nullptr, command_line(figure), figure, options); },
              [&] { std::printf("%s\n", command_line(figure).c_str()); });
}

void run_extract(const ExtractOptions& options) {
  const ClipMemory memory = recall(options.clip);
  note_input(options.clip);
  const ClipOrigin origin = find_origin(options.clip, files_wanted_by(memory), options.from);
  tell_of_files(origin, options);
  if (!memory.figure.is_null()) return tell_of_figure(options, figure_from(memory.figure, origin));
  if (!options.output.empty())
    write_text_file(options.output,
                    moved_scene_text(memory.scene, fs::path(options.output).parent_path().string(), origin.folder),
                    options.common.force);
  tell_of_origin(memory.audit, options);
  const std::string scene = moved_scene_text(memory.scene, "", origin.folder);
  tell_result(options.common, [&] { return report_of(scene, memory.audit, nullptr, nullptr, options); }, [&] {
    if (options.output.empty()) std::fputs(scene.c_str(), stdout);
  });
}

}  // namespace

void add_extract_command(CommandLine& app) {
  auto options = std::make_shared<ExtractOptions>();
  Command* command = app.add_subcommand("extract", "the scene that a clip or picture remembers, or the command that made a figure");
  command->add_option("clip", options->clip, "a .mp4, .mov, .webm, .gif, .png, .apng, .svg or .pdf file")
      .required();
  command->add_option(
      "-o,--output", options->output,
      "a .yaml file, its paths as found from there (default: standard output, paths as found from "
      "the working folder)");
  command->add_option("--from", options->from,
                      "the folder in which the remembered paths start: that of the scene or model (default: it is looked for)");
  add_json_option(*command, options->common);
  add_force_option(*command, options->common);
  command->footer("Example: chainreel extract out/rr_free.mp4 -o out/again.yaml\n"
                  "of what  chainreel render rr_free  writes");
  command->callback([options] { run_extract(*options); });
}

}  // namespace chainreel
