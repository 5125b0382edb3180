// chainreel extract CLIP [-o SCENE.yaml]

#include <cstdio>
#include <filesystem>
#include <memory>

#include "app/cli/command.hpp"
#include "app/film/clip_memory.hpp"
#include "core/error.hpp"
#include "core/hash.hpp"
#include "core/input_file.hpp"
#include "core/output_file.hpp"
#include "model/xml_text.hpp"
#include "scene/text/write_scene.hpp"

namespace chainreel {
namespace {

namespace fs = std::filesystem;

struct ExtractOptions {
  std::string clip;
  std::string output;
  bool json = false;
  bool force = false;
};

// The models must be where they were, and what they were, for the same frames to come again.
void tell_of_models(const Json& audit, const std::string& clip) {
  // What a clip says was maybe not written by this program: everything is looked at before it is taken.
  const auto word = [&](const char* key) {
    return audit.is_object() && audit.contains(key) && audit[key].is_string() ? audit[key].get<std::string>() : "";
  };
  const std::string model = word("model"), before = word("model_sha256");
  if (model.empty() || before.empty()) return;
  std::error_code ignored;
  if (!fs::is_regular_file(model, ignored)) {
    std::fprintf(
        stderr,
        "%s: there is no model %s here: stand in the folder where the clip was rendered, or correct the "
        "scene's `model:`\n",
        clip.c_str(), model.c_str());
    return;
  }
  try {
    if (fs::file_size(model, ignored) > kLargestXmlFile || sha256_of_file(model) != before)
      std::fprintf(stderr, "%s: the model %s has changed since: frames may differ\n", clip.c_str(), model.c_str());
  } catch (const Error& error) {
    std::fprintf(stderr, "%s: whether the model has changed since cannot be said: %s\n", clip.c_str(), error.what());
  }
}

// A figure shows no scene, a sheet many: what made it is said instead.
void tell_of_figure(const ExtractOptions& options, const Json& figure) {
  if (!options.output.empty())
    throw Error(ExitCode::bad_input, "is a figure, not a scene; it was made by: " + command_line(figure),
                {options.clip});
  tell_of_models(figure, options.clip);
  if (options.json)
    std::puts(Json{{"command", command_line(figure)}, {"figure", figure}}.dump(2).c_str());
  else
    std::printf("%s\n", command_line(figure).c_str());
}

void run_extract(const ExtractOptions& options) {
  const ClipMemory memory = recall(options.clip);
  note_input(options.clip);
  if (!memory.figure.is_null()) return tell_of_figure(options, memory.figure);
  tell_of_models(memory.audit, options.clip);
  if (memory.audit.contains("panels") && memory.audit["panels"].is_array())
    for (const Json& panel : memory.audit["panels"]) tell_of_models(panel, options.clip);
  if (!options.output.empty())
    write_text_file(options.output,
                    moved_scene_text(memory.scene, fs::path(options.output).parent_path().string()),
                    options.force);
  if (options.json)
    std::puts(Json{{"scene", memory.scene}, {"audit", memory.audit}}.dump(2).c_str());
  else if (options.output.empty())
    std::fputs(memory.scene.c_str(), stdout);
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
  command->add_flag("--json", options->json, "print scene and audit as JSON on standard output");
  command->add_flag("--force", options->force, "overwrite files outside a folder named out");
  command->footer("Example: chainreel extract out/rr_free.mp4 -o out/again.yaml");
  command->callback([options] { run_extract(*options); });
}

}  // namespace chainreel
