// chainreel ellipse MODEL --pose Q [--pose Q ...] -o FILE.png|.svg|.pdf|.csv, and other ways to name poses.

#include <cstdio>
#include <filesystem>
#include <memory>

#include "app/command.hpp"
#include "app/ellipse_numbers.hpp"
#include "app/ellipse_poses.hpp"
#include "app/figure.hpp"
#include "app/model_view.hpp"
#include "app/pipeline.hpp"
#include "core/error.hpp"
#include "core/output_file.hpp"
#include "draw/poses.hpp"
#include "model/read_chain.hpp"

namespace chainreel {
namespace {

struct EllipseOptions {
  std::string model;
  PoseSources sources;
  std::string reading;  // "": mass
  std::string shape;    // "": the scene's, else ellipsoid
  std::string layout;   // "": superposed along a motion, else grid
  bool joint_space = false;
  std::string joints;  // "1,2"
  std::string output;
  std::string end_effector;
  std::string title;
  int width = 1920, height = 1080;
  CommonOptions common;
  const Command* command = nullptr;

  EllipseReading read_as() const { return reading_named(reading); }
  // In the plane there is nothing to cut.
  EllipseForm form(const Motion& motion) const {
    const std::string named = shape.empty() ? motion.ellipse.shape : shape;
    return {read_as(), named == "section" && !motion.chain.planar};
  }
};

std::string output_of(const EllipseOptions& options) {
  std::string output = options.output;
  const std::string& named = options.model.empty() ? options.sources.along : options.model;
  if (output.empty()) output = "out/" + std::filesystem::path(named).stem().string() + "_ellipse.png";
  check_figure_path(output);
  if (options.joint_space && output.ends_with(".csv"))
    throw Error(ExitCode::usage,
                "-o " + output + ": --joint-space is written as .png, .svg or .pdf; --json prints its numbers");
  return output;
}

// Two joints, counted from 0.
std::array<int, 2> joints_of(const Chain& chain, const std::string& text) {
  if (chain.nv < 2) throw Error(ExitCode::usage, "--joint-space shows two joints; " + chain.name + " has one");
  if (text.empty() && chain.nv > 2)
    throw Error(ExitCode::usage, chain.name + " has " + std::to_string(chain.nv) +
                                     " joints: choose the two that --joint-space is to show, like --joints 1,2");
  const std::vector<double> numbers = text.empty() ? std::vector<double>{1, 2} : parse_list(text, "--joints");
  const auto good = [&](double n) { return n == int(n) && n >= 1 && n <= chain.nv; };
  if (numbers.size() != 2 || !good(numbers[0]) || !good(numbers[1]) || numbers[0] == numbers[1])
    throw Error(ExitCode::usage, "--joints takes two different joints between 1 and " + std::to_string(chain.nv) +
                                     ", like --joints 1,2; not '" + text + "'");
  return {int(numbers[0]) - 1, int(numbers[1]) - 1};
}

// The model, or what the scene moves.
Motion chain_and_poses(const EllipseOptions& options) {
  if (!options.sources.along.empty()) {
    if (!options.end_effector.empty())
      throw Error(ExitCode::usage, "--along takes the scene's end effector: --set end_effector=" + options.end_effector);
    if (!options.model.empty())
      throw Error(ExitCode::usage, "--along takes the model of its scene: leave out " + options.model);
    return motion_of(options.sources, options.common);
  }
  if (options.model.empty()) throw Error(ExitCode::usage, "which model? Name a .urdf, or a scene by --along");
  ModelOptions model = model_options_of(options.common);
  model.end_effector = options.end_effector;
  Motion read{read_chain(options.model, model), {}, theme_of(options.common.flags),
              text_scale_of(options.common.flags)};
  require_end_effector(read.chain);
  read.poses = gather_poses(read.chain, options.sources);
  return read;
}

PoseFigureOptions figure_of(const EllipseOptions& options, const Motion& motion) {
  const GatheredPoses& poses = motion.poses;
  PoseFigureOptions figure;
  figure.title = options.title;
  figure.width = options.width;
  figure.height = options.height;
  figure.text_scale = motion.text_scale;
  figure.theme = &theme_named(motion.theme);
  figure.reading = options.read_as();
  figure.layout = !options.layout.empty() ? options.layout : poses.t.empty() ? "grid" : "superposed";
  figure.labels = poses.labels;
  figure.path = poses.path;
  figure.cell = poses.cell;
  if (options.sources.along.empty()) {
    ModelOptions model = model_options_of(options.common);
    set_view(figure, options.common.flags, options.model, motion.chain, model);
  } else {
    figure.camera = motion.camera;
    figure.shapes = motion.shapes;
  }
  figure.section = options.form(motion).section;
  return figure;
}

void check_combination(const EllipseOptions& options) {
  if (options.joint_space && (!options.reading.empty() || !options.layout.empty() || options.sources.field))
    throw Error(ExitCode::usage, "--joint-space shows M(q) itself: leave out --reading, --layout and --field");
  if (!options.joint_space && !options.joints.empty())
    throw Error(ExitCode::usage, "--joints goes with --joint-space");
  if (options.sources.field && !options.layout.empty())
    throw Error(ExitCode::usage, "--field is one picture of the workspace: leave out --layout");
}

void run_ellipse(const EllipseOptions& options) {
  check_combination(options);
  const std::string output = output_of(options);
  const Motion motion = chain_and_poses(options);
  const Chain& chain = motion.chain;
  const GatheredPoses& poses = motion.poses;
  const ClipMemory memory = memory_of_figure(*options.command, options.title, options.model, poses.q);
  Json numbers;
  if (options.joint_space) {
    const std::array<int, 2> joints = joints_of(chain, options.joints);
    const Fonts fonts;
    write_picture(draw_joint_space_figure(chain, poses.q, joints, figure_of(options, motion), fonts), options.width,
                  options.height, fonts, output, options.common.force, memory);
    numbers = joint_space_json(chain, poses, joints);
  } else if (output.ends_with(".csv")) {
    write_text_file(output, ellipse_csv(chain, poses, options.form(motion)), options.common.force);
  } else {
    const Fonts fonts;
    write_picture(draw_ellipse_figure(chain, poses.q, figure_of(options, motion), fonts), options.width,
                  options.height, fonts, output, options.common.force, memory);
  }
  if (options.common.json) {
    Json report{{"file", output}};
    if (!options.joint_space) {
      report["reading"] = to_string(options.read_as());
      report["shape"] = options.form(motion).section ? "section" : "ellipsoid";
      report["unit"] = options.read_as() == EllipseReading::energy ? "m/s" : "kg";
      numbers = ellipse_json(chain, poses, options.form(motion));
    }
    report["poses"] = numbers;
    std::puts(report.dump(2).c_str());
  } else if (!options.common.quiet) {
    std::printf("%s\n", output.c_str());
  }
}

}  // namespace

void add_ellipse_command(CommandLine& app) {
  auto options = std::make_shared<EllipseOptions>();
  Command* command = app.add_subcommand("ellipse", "a figure of the effective mass at chosen poses");
  command->add_option("model", options->model, "a model (.urdf); not with --along");
  PoseSources& sources = options->sources;
  command->add_repeatable("--pose", sources.poses, "q of the chain: --pose 0,90deg (repeatable)");
  command->add_option("--sweep", sources.sweep, "poses that differ in one coordinate: --sweep q2=0:180deg:9");
  command->add_option("--along", sources.along, "poses along the motion of a scene (.yaml)");
  command->add_flag("--field", sources.field, "a grid of points of the workspace, of planar chains of 2 or 3 joints");
  command->add_option("--samples", sources.samples, "poses --along (default 6), points across the --field (default 12)")
      .range(1, 200);
  command->add_option("--elbow", sources.elbow, "of a --field: up, the elbow left of the way to the end, or down")
      .one_of({"up", "down"});
  command->add_option("--reading", options->reading,
                      "mass: forces for unit accelerations (default); energy: velocities of equal kinetic energy; "
                      "belt: mass felt along each direction")
      .one_of(reading_names());
  command->add_option("--layout", options->layout, "of the poses: grid, row, superposed")
      .one_of(figure_layout_names());
  command->add_flag("--joint-space", options->joint_space, "the unit circle of accelerations beside its image under M(q)");
  command->add_option("--joints", options->joints, "the two joints of --joint-space: --joints 1,2");
  command->add_option("-o,--output", options->output,
                      "a .png, .svg, .pdf or .csv file (default out/NAME_ellipse.png)");
  command->add_option("--end-effector", options->end_effector, "the link whose mass is felt");
  command->add_option("--title", options->title, "above the figure");
  add_scene_flags(*command, options->common.flags, kLookFlags);
  add_scene_flags(*command, options->common.flags, kViewFlags);
  command->add_option("--shape", options->shape, "of arms in space: ellipsoid, or section by the xy plane of the end effector")
      .one_of({"ellipsoid", "section"});
  command->add_option("--width", options->width, "pixels").range(16, 16384);
  command->add_option("--height", options->height, "pixels").range(16, 16384);
  add_common_options(*command, options->common);
  command->footer(
      "Example: chainreel ellipse models/rr.urdf --pose 0,90deg --pose 0,150deg -o out/ellipse.png");
  options->command = command;
  command->callback([options] { run_ellipse(*options); });
}

}  // namespace chainreel
