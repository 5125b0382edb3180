// chainreel snapshot SCENE --at T -o FILE, chainreel snapshot MODEL --pose Q -o FILE; .png, .svg or .pdf

#include <cstdio>
#include <filesystem>
#include <memory>

#include "app/cli/command.hpp"
#include "app/commands/figure.hpp"
#include "app/commands/moment.hpp"
#include "app/film/automatic.hpp"
#include "app/film/model_scene.hpp"
#include "app/film/prepared.hpp"
#include "app/film/runs.hpp"
#include "app/film/target.hpp"
#include "app/report/report.hpp"
#include "app/report/run_report.hpp"
#include "core/error.hpp"
#include "draw/figures/poses.hpp"
#include "model/read_chain.hpp"
#include "scene/quantity.hpp"

namespace chainreel {
namespace {

struct SnapshotOptions {
  std::string file;
  std::string at;  // "": 0
  std::vector<std::string> poses;
  std::string output;
  std::string end_effector;
  std::vector<std::string> vary;
  int width = 0, height = 0;
  CommonOptions common;
  const Command* command = nullptr;
};

std::string default_output(const SnapshotOptions& options) {
  if (options.output.empty()) return "out/" + std::filesystem::path(options.file).stem().string() + ".png";
  picture_format_of(options.output);
  return options.output;
}

// The keys that the command line names, however it does.
std::vector<std::string> overrides_of(const SnapshotOptions& options) {
  std::vector<std::string> overrides = overrides_of(options.common);
  if (!options.end_effector.empty())
    overrides.push_back("end_effector=" + Json(options.end_effector).dump());
  return overrides;
}

void snapshot_scene(const SnapshotOptions& options, const std::string& output) {
  std::vector<std::string> overrides = overrides_of(options);
  add_comparison(options.vary, overrides);
  PreparedFilm film = load_film(options.file, overrides, true, options.common.quiet);
  for (const PreparedScene& panel : film.panels) say_notices(panel, options.common.quiet);
  Video& video = film.scene.video;
  if (options.width > 0) video.width = options.width;
  if (options.height > 0) video.height = options.height;
  const double at = options.at.empty() ? 0 : parse_quantity(options.at, {});
  if (at < 0 || at > film.scene.duration)
    throw Error(ExitCode::usage, "--at " + options.at + " lies outside the scene's duration of " +
                                     format_quantity(film.scene.duration, "s"));
  const Fonts fonts;
  const Moment shown = moment_at(film, at, fonts);
  tell_warnings(shown.warnings);
  write_picture(shown.picture, video.width, video.height, fonts, output, options.common.force, shown.memory);
}

void snapshot_model(const SnapshotOptions& options, const std::string& output) {
  if (!options.at.empty() || !options.vary.empty())
    throw Error(ExitCode::usage, "--at and --vary go with a scene; a model stands still at --pose");
  const ModelScene model = model_scene_of(options.file, overrides_of(options), "snapshot", keys_of_models(OfModel::picture));
  const Chain chain = read_chain(options.file, model.options);
  std::vector<std::vector<double>> poses = parse_poses(chain, options.poses, "--pose");
  if (poses.empty()) poses.push_back(zero_configuration(chain));
  const Fonts fonts;
  PoseFigureOptions figure;
  set_look(figure, model, chain);
  if (options.width > 0) figure.width = options.width;
  if (options.height > 0) figure.height = options.height;
  write_picture(draw_pose_figure(chain, poses, figure, fonts), figure.width, figure.height, fonts, output,
                options.common.force, memory_of_figure(*options.command, chain.name, options.file, poses));
}

void run_snapshot(const SnapshotOptions& options) {
  const std::string output = default_output(options);
  if (is_model_file(options.file))
    snapshot_model(options, output);
  else if (!options.poses.empty())
    throw Error(ExitCode::usage, "--pose goes with a model; a scene takes --at");
  else
    snapshot_scene(options, output);
  if (options.common.json)
    std::puts(Json{{"file", output}}.dump(2).c_str());
  else if (!options.common.quiet)
    std::printf("%s\n", output.c_str());
}

}  // namespace

void add_snapshot_command(CommandLine& app) {
  auto options = std::make_shared<SnapshotOptions>();
  Command* command =
      app.add_subcommand("snapshot", "one picture: a scene at an instant, or a model at poses");
  command->add_option("file", options->file, "a scene (.yaml) or a model (.urdf)").required();
  command->add_option("--at", options->at, "instant of the scene in seconds (default 0)");
  command->add_repeatable("--pose", options->poses, "q of a model: --pose 0,90deg (repeatable)");
  command->add_option("-o,--output", options->output, "a .png, .svg or .pdf file (default out/NAME.png)");
  command->add_option("--end-effector", options->end_effector,
                      "the link that is marked, where there are several ends");
  command->add_option("--width", options->width, "pixels").range(16, 16384);
  command->add_option("--height", options->height, "pixels").range(16, 16384);
  add_scene_flags(*command, options->common.flags, FlagGroup::look);
  add_scene_flags(*command, options->common.flags, FlagGroup::page);
  add_scene_flags(*command, options->common.flags, FlagGroup::view);
  add_vary_option(*command, options->vary);
  add_scene_options(*command, options->common);
  add_result_options(*command, options->common);
  command->footer("Example: chainreel snapshot assets/scenes/rrr_torque.yaml --at 1.2 -o out/rrr.png");
  options->command = command;
  command->callback([options] { run_snapshot(*options); });
}

}  // namespace chainreel
