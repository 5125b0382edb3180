// chainreel render SCENE... [-o FILE|DIR]

#include <cstdio>
#include <filesystem>
#include <map>
#include <memory>

#include "app/automatic.hpp"
#include "app/command.hpp"
#include "app/pipeline.hpp"
#include "app/report.hpp"
#include "core/error.hpp"
#include "core/format.hpp"

namespace chainreel {
namespace {

namespace fs = std::filesystem;

struct RenderOptions {
  std::vector<std::string> scenes;
  std::string output;
  CommonOptions common;
};

// Where each scene's film goes: a file is for one scene, a folder for any number.
std::vector<std::string> output_paths(const RenderOptions& options) {
  const fs::path output(options.output);
  const bool folder = options.output.empty() || options.output.ends_with('/') || fs::is_directory(output) ||
                      (options.scenes.size() > 1 && output.extension() != ".mp4");
  if (!folder && options.scenes.size() > 1)
    throw Error(ExitCode::usage,
                "-o " + options.output + " names one file for several scenes: name a folder");
  if (!folder && output.extension() != ".mp4")
    throw Error(ExitCode::usage,
                "-o " + options.output + ": films are written as .mp4; name a .mp4 file or a folder/");
  std::vector<std::string> paths;
  std::map<std::string, std::string> taken;
  for (const std::string& scene : options.scenes) {
    const std::string name = fs::path(scene).stem().string() + ".mp4";
    const fs::path path = !folder ? output : (options.output.empty() ? fs::path("out") : output) / name;
    const auto [other, is_new] = taken.emplace(path.string(), scene);
    if (!is_new)
      throw Error(ExitCode::usage, scene + " and " + other->second + " would both be written to " +
                                       path.string() + ": render them one by one with -o");
    paths.push_back(path.string());
  }
  return paths;
}

// Every scene is read before the first is rendered, so that bad input costs no time and loses nothing.
std::vector<PreparedFilm> load_all(const RenderOptions& options) {
  std::vector<PreparedFilm> films;
  std::vector<Problem> problems;
  ExitCode code = ExitCode::bad_input;
  for (const std::string& scene : options.scenes) {
    try {
      films.push_back(load_film(scene, overrides_of(options.common)));
    } catch (const Error& error) {
      code = error.code();
      problems.insert(problems.end(), error.problems().begin(), error.problems().end());
    }
  }
  if (!problems.empty()) throw Error(code, std::move(problems));
  return films;
}

void run_render(const RenderOptions& options) {
  const std::vector<std::string> paths = output_paths(options);
  const std::vector<PreparedFilm> films = load_all(options);

  Json reports = Json::array();
  std::vector<std::vector<std::string>> table{{"scene", "frames", "film s", "taken s", "file"}};
  for (std::size_t i = 0; i < films.size(); ++i) {
    for (const PreparedScene& panel : films[i].panels) say_choice(panel, options.common.quiet);
    const RenderResult result = render_film(films[i], paths[i], options.common.force, options.common.quiet);
    reports.push_back(result.audit);
    reports.back()["file"] = result.video;
    table.push_back({films[i].scene.name, std::to_string(result.frames), format_fixed(result.film_seconds, 2),
                     format_fixed(result.seconds.total, 2), result.video});
  }
  if (options.common.json)
    std::puts(reports.dump(2).c_str());
  else if (!options.common.quiet)
    std::fputs(table_text(table).c_str(), stdout);
}

}  // namespace

void add_render_command(CLI::App& app) {
  auto options = std::make_shared<RenderOptions>();
  CLI::App* command =
      app.add_subcommand("render", "render scenes to MP4 films, each with its audit as NAME.json");
  command->add_option("scenes", options->scenes, "scene files")->required();
  command->add_option("-o,--output", options->output,
                      "a .mp4 file, or a folder for several (default out/NAME.mp4)");
  add_common_options(*command, options->common);
  command->footer("Example: chainreel render assets/scenes/rr_free.yaml -o out/rr.mp4 --set duration=2");
  command->callback([options] { run_render(*options); });
}

}  // namespace chainreel
