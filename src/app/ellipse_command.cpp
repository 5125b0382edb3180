// chainreel ellipse MODEL --pose Q [--pose Q ...] -o FILE.png

#include <cstdio>
#include <filesystem>
#include <memory>

#include "app/command.hpp"
#include "app/pipeline.hpp"
#include "app/report.hpp"
#include "core/error.hpp"
#include "draw/poses.hpp"
#include "dynamics/effective_mass.hpp"
#include "model/read_chain.hpp"

namespace chainreel {
namespace {

struct EllipseOptions {
  std::string model;
  std::vector<std::string> poses;
  std::string output;
  std::string end_effector;
  int width = 1920, height = 1080;
  CommonOptions common;
};

// The numbers that the figure shows, pose by pose.
Json numbers_of(const Chain& chain, const std::vector<std::vector<double>>& poses) {
  Workspace ws(chain);
  Json list = Json::array();
  for (const std::vector<double>& q : poses) {
    Json entry;
    entry["q"] = to_json(std::span<const double>(q));
    add_effective_mass(entry, effective_mass_of(chain, ws, q, chain.end_effector, Task::linear));
    list.push_back(entry);
  }
  return list;
}

void run_ellipse(const EllipseOptions& options) {
  std::string output = options.output;
  if (output.empty()) output = "out/" + std::filesystem::path(options.model).stem().string() + "_ellipse.png";
  if (!output.ends_with(".png"))
    throw Error(ExitCode::usage, "-o " + output + ": figures are written as .png");
  ModelOptions model = model_options_of(options.common);
  model.end_effector = options.end_effector;
  const Chain chain = read_chain(options.model, model);
  require_end_effector(chain);
  std::vector<std::vector<double>> poses = parse_poses(chain, options.poses, "--pose");

  const Fonts fonts;
  PoseFigureOptions figure;
  figure.width = options.width;
  figure.height = options.height;
  write_picture(draw_ellipse_figure(chain, poses, figure, fonts), options.width, options.height, fonts,
                output, options.common.force);
  if (options.common.json)
    std::puts(Json{{"file", output}, {"poses", numbers_of(chain, poses)}}.dump(2).c_str());
  else if (!options.common.quiet)
    std::printf("%s\n", output.c_str());
}

}  // namespace

void add_ellipse_command(CLI::App& app) {
  auto options = std::make_shared<EllipseOptions>();
  CLI::App* command = app.add_subcommand("ellipse", "a figure of the effective-mass ellipse at chosen poses");
  command->add_option("model", options->model, "a model (.urdf)")->required();
  add_repeatable(*command, "--pose", options->poses, "q of the chain: --pose 0,90deg (repeatable)")
      ->required();
  command->add_option("-o,--output", options->output, "a .png file (default out/NAME_ellipse.png)");
  command->add_option("--end-effector", options->end_effector, "the link whose mass is felt");
  command->add_option("--width", options->width, "pixels")->check(CLI::Range(16, 16384));
  command->add_option("--height", options->height, "pixels")->check(CLI::Range(16, 16384));
  add_common_options(*command, options->common);
  command->footer(
      "Example: chainreel ellipse models/rr.urdf --pose 0,90deg --pose 0,150deg -o out/ellipse.png");
  command->callback([options] { run_ellipse(*options); });
}

}  // namespace chainreel
