// chainreel ellipse MODEL --pose Q [--pose Q ...] -o FILE.png|.svg|.pdf|.csv, and other ways to name poses.

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <memory>

#include "app/cli/command.hpp"
#include "app/cli/named_pose.hpp"
#include "app/cli/result.hpp"
#include "app/commands/ellipse_numbers.hpp"
#include "app/commands/figure.hpp"
#include "app/film/model_scene.hpp"
#include "app/film/target.hpp"
#include "app/paper/paper.hpp"
#include "app/paper/pose_page.hpp"
#include "app/report/run_report.hpp"
#include "app/today/table_record.hpp"
#include "core/data_folder.hpp"
#include "core/error.hpp"
#include "core/format.hpp"
#include "core/output_file.hpp"
#include "draw/figures/poses.hpp"
#include "draw/page/house_style.hpp"
#include "draw/page/sheet.hpp"
#include "model/read_chain.hpp"
#include "picture/formula_words.hpp"
#include "scene/text/read_scene.hpp"

namespace chainreel {
namespace {

struct EllipseOptions {
  std::string model;
  PoseSources sources;
  std::string reading;  // "": the scene's, else mass
  std::string shape;    // "": the scene's, else ellipsoid
  std::string layout;   // "": superposed along a motion, else grid
  bool joint_space = false;
  std::string joints;  // "1,2"
  std::vector<std::string> outputs;
  std::string end_effector;
  std::string title;
  int width = 0, height = 0;  // 0: as the scene says
  PaperOptions paper;
  bool letters = false;
  CommonOptions common;
  const Command* command = nullptr;

  // As the scene does, unless the command says otherwise.
  EllipseReading read_as(const Motion& motion) const {
    return value_named<EllipseReading>(reading).value_or(motion.ellipse.reading);
  }
  // In the plane there is nothing to cut.
  EllipseForm form(const Motion& motion) const {
    const EllipseShape shown = value_named<EllipseShape>(shape).value_or(motion.ellipse.shape);
    return {read_as(motion), shown == EllipseShape::section && !motion.chain.planar};
  }
};

// What is drawn, and how the scene, or what stands in its place, wants it to look.
struct EllipseJob {
  Motion motion;
  PoseFigureOptions figure;
  NamedPoses named_poses{};  // those of --pose
};

constexpr double kSlide = 9.0 / 16;   // height of a page, of its width
constexpr double kTall = 2;           // of one that is tried: its margins are the widest
constexpr double kWidestTried = 420;  // mm: a sheet of A3

// What is left out on a page that has no room for it.
void tell_missing_masses(const EllipseJob& job, const EllipseOptions& options, const TipMass& tip, const Fonts& fonts) {
  if (options.common.quiet || job.figure.layout == "superposed" || job.figure.cell > 0) return;
  const PoseFigureFit fit = fit_of_poses(tip, job.motion.poses.q, job.figure, fonts);
  if (fit.metre > 0 && !fit.is_whole)
    std::fprintf(stderr, "note: this page has no room for whole poses below the pictures: they are in --json and .csv; a larger page has, or fewer poses\n");
  if (fit.metre > 0 && !fit.has_masses)
    std::fprintf(stderr, "note: this page has no room for the masses below %s: they are in --json and .csv; %s\n",
                 job.motion.poses.q.size() == 1 ? "the pose" : "the poses",
                 job.figure.layout == "row" ? "--layout grid has more" : "a larger page has, or fewer poses");
}

// A page of that width which is as high as the squares of a joint-space figure need; nothing where no height is enough.
std::optional<PoseFigureOptions> joint_space_page(const EllipseJob& job, const EllipseOptions& options, std::array<int, 2> joints,
                                                  double width_mm, const Fonts& fonts) {
  PoseFigureOptions figure = job.figure;
  PaperOptions paper = options.paper;
  paper.width_mm = width_mm;
  paper.height_mm = PaperOptions::kNotGiven;
  set_page(figure, paper_page(paper, kTall * width_mm), job.figure.text_scale);
  const std::optional<double> height =
      joint_space_height(job.motion.chain, job.motion.poses.q, joints, figure, fonts);
  if (!height) return std::nullopt;
  set_page(figure, paper_page(paper, std::max(kSlide, *height / figure.width) * width_mm), job.figure.text_scale);
  return figure;
}

void set_joint_space_on_paper(EllipseJob& job, const EllipseOptions& options, std::array<int, 2> joints, const Fonts& fonts) {
  const double width = options.paper.width_mm;
  const std::optional<PoseFigureOptions> figure = joint_space_page(job, options, joints, width, fonts);
  if (!figure) {
    double enough = std::ceil(width);
    while (enough <= kWidestTried && !joint_space_page(job, options, joints, enough, fonts)) ++enough;
    throw Error(ExitCode::usage, "a page " + format_shortest(width) + " mm wide has no room for chain and axes beside words of 7 pt" +
                                     (enough <= kWidestTried ? ": take --width-mm " + format_shortest(enough) : ""));
  }
  const double height = std::ceil(figure->height * width / figure->width);
  if (options.paper.height_mm != PaperOptions::kNotGiven) {
    set_page(job.figure, paper_page(options.paper, height), job.figure.text_scale);
    if (!joint_space_has_room(job.motion.chain, job.motion.poses.q, joints, job.figure, fonts))
      throw Error(ExitCode::usage, "a page " + format_shortest(options.paper.height_mm) + " mm high has no room for these poses: take --height-mm " +
                                       format_shortest(height) + ", or leave it out");
    return;
  }
  job.figure = *figure;
  if (!options.common.quiet && height > kSlide * width + 1)
    std::fprintf(stderr, "note: the page is %s mm high, so that poses and axes have room beside words of 7 pt; --height-mm says otherwise\n",
                 format_shortest(height).c_str());
}

std::vector<std::string> outputs_of(const EllipseOptions& options) {
  std::vector<std::string> outputs = options.outputs;
  const std::string& named = options.model.empty() ? options.sources.along : options.model;
  if (outputs.empty()) outputs = {"out/" + std::filesystem::path(named).stem().string() + "_ellipse.png"};
  for (const std::string& output : outputs) {
    check_figure_path(output);
    if (options.joint_space && is_table_path(output) && lower_case_ending(output) != ".json")
      throw Error(ExitCode::usage, "-o " + output + ": --joint-space is written as .png, .svg or .pdf, its numbers as .json");
  }
  refuse_twice(outputs);
  return outputs;
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

std::vector<std::string> model_overrides(const EllipseOptions& options) {
  std::vector<std::string> overrides = overrides_of(options.common);
  if (!options.end_effector.empty())
    overrides.push_back("end_effector=" + Json(options.end_effector).dump());
  return overrides;
}

EllipseJob job_of_scene(const EllipseOptions& options) {
  if (!options.end_effector.empty())
    throw Error(ExitCode::usage, "--along takes the scene's end effector: --set end_effector=" + options.end_effector);
  if (!options.model.empty())
    throw Error(ExitCode::usage, "--along takes the model of its scene: leave out " + options.model);
  EllipseJob job{motion_of(options.sources, options.common), {}};
  const Motion& motion = job.motion;
  job.figure.text_scale = motion.text_scale;
  job.figure.theme = motion.theme;
  job.figure.camera = motion.camera;
  job.figure.shapes = motion.shapes;
  job.figure.logo = motion.logo;
  job.figure.width = motion.video.width;
  job.figure.height = motion.video.height;
  return job;
}

// A scene in the model's place lends its mechanism and its look, as where the model stands in it in numbers.
ModelScene model_in_scene(const EllipseOptions& options) {
  std::error_code ignored;
  if (!std::filesystem::exists(options.model, ignored))
    throw Error(ExitCode::usage, options.model + " is neither a model (.urdf) nor a scene (.yaml) that is there");
  ModelScene model = model_scene_of(read_scene(options.model, model_overrides(options)));
  require_single_run(model.scene);
  if (!model.scene.constraints.empty())
    throw Error(ExitCode::usage, options.model + " has constraints, which few poses keep: the ellipses along its motion are `--along " +
                                     options.model + "`, those of its model alone are of its .urdf");
  if (options.sources.poses.empty() && options.sources.sweep.empty() && !options.sources.field)
    throw Error(ExitCode::usage, "of a scene, the ellipses along its motion are `--along " + options.model +
                                     "`; of its model, give --pose 0,90deg, --sweep q2=0:180deg:9 or --field");
  model.scene.title.clear();  // is the film's
  return model;
}

ModelScene model_of(const EllipseOptions& options) {
  if (!is_model_file(options.model)) return model_in_scene(options);
  std::vector<std::string> honoured = keys_of_models(OfModel::picture);
  honoured.insert(honoured.end(), {"title", "ellipse"});
  return model_scene_of(options.model, model_overrides(options), "ellipse", honoured);
}

EllipseJob job_of_model(const EllipseOptions& options) {
  if (options.model.empty()) throw Error(ExitCode::usage, "which model? Name a .urdf, a scene that holds one, or a scene by --along");
  const ModelScene model = model_of(options);
  Chain chain = read_chain(model.scene.model, model.options);
  tell_warnings(chain.slips);
  EllipseJob job{{std::move(chain), {}, &page_theme(model.scene), model.scene.text_scale}, {}};
  job.motion.families = families_of(model.scene);
  Motion& motion = job.motion;
  require_end_effector(motion.chain);
  PoseSources sources = options.sources;
  for (std::string& pose : sources.poses) {
    const std::string numbers = named_pose_text(motion.chain, model.scene.model.path, pose, "--pose");
    if (numbers != pose) job.named_poses[pose] = numbers;
    pose = numbers;
  }
  motion.poses = gather_poses(motion.chain, sources);
  motion.ellipse = model.scene.ellipse;
  set_look(job.figure, model, motion.chain);
  job.figure.title = model.scene.title;
  return job;
}

// The chain and its poses, and all of the figure that the command names.
EllipseJob job_of(const EllipseOptions& options) {
  EllipseJob job = options.sources.along.empty() ? job_of_model(options) : job_of_scene(options);
  const GatheredPoses& poses = job.motion.poses;
  PoseFigureOptions& figure = job.figure;
  if (!options.title.empty()) figure.title = options.title;
  require_formulas(figure.title, true);
  if (options.width > 0) figure.width = options.width;
  if (options.height > 0) figure.height = options.height;
  figure.reading = options.read_as(job.motion);
  figure.layout = !options.layout.empty() ? options.layout : poses.t.empty() ? "grid" : "superposed";
  figure.labels = poses.labels;
  figure.path = poses.path;
  figure.cell = poses.cell;
  figure.branch = poses.branch;
  figure.section = options.form(job.motion).section;
  figure.letters = options.letters;
  if (options.letters && !options.joint_space && (figure.cell > 0 || figure.layout == "superposed"))
    throw Error(ExitCode::usage, "--letters name panels: with --field leave them out, else take --layout grid or row");
  return job;
}

void check_combination(const EllipseOptions& options) {
  if (options.joint_space && (!options.reading.empty() || !options.layout.empty() || options.sources.field))
    throw Error(ExitCode::usage, "--joint-space shows M(q) itself: leave out --reading, --layout and --field");
  check_paper(options.paper, options.width > 0 || options.height > 0);
  if (!options.joint_space && !options.joints.empty())
    throw Error(ExitCode::usage, "--joints goes with --joint-space");
  if (options.sources.field && !options.layout.empty())
    throw Error(ExitCode::usage, "--field is one picture of the workspace: leave out --layout");
}

void run_ellipse(const EllipseOptions& options) {
  check_combination(options);
  const std::vector<std::string> outputs = outputs_of(options);
  EllipseJob job = job_of(options);
  const Motion& motion = job.motion;
  const PoseFigureOptions& figure = job.figure;
  const Chain& chain = motion.chain;
  const TipMass tip(chain, motion.constraints);
  const GatheredPoses& poses = motion.poses;
  if (options.joint_space && tip.is_constrained())
    throw Error(ExitCode::usage,
                "--joint-space shows M(q), which says of a constrained mechanism only what its cut chain would do: leave "
                "one of the two out; `chainreel dynamics " + options.sources.along + " --at T` prints M, Jc and Lambda");
  const std::array<int, 2> joints = options.joint_space ? joints_of(chain, options.joints) : std::array<int, 2>{};
  const Fonts fonts(motion.families);
  const bool is_drawn = !std::all_of(outputs.begin(), outputs.end(), is_table_path);
  if (options.paper.is_given() && options.joint_space && is_drawn) set_joint_space_on_paper(job, options, joints, fonts);
  if (options.paper.is_given() && !options.joint_space && is_drawn) put_on_paper(job.figure, options.paper, tip, poses.q, fonts);
  const bool is_row_of_free_height = figure.layout == "row" && !options.joint_space && !options.paper.is_given() && options.height == 0 && is_model_file(options.model);
  if (is_row_of_free_height && is_drawn) cut_row(job.figure, tip, poses.q, fonts);
  if (!options.joint_space && is_drawn) tell_missing_masses(job, options, tip, fonts);
  ClipMemory memory =
      memory_of_figure(*options.command, figure.title, is_model_file(options.model) ? options.model : "", poses.q);
  remember_named_poses(memory, job.named_poses);
  if (options.paper.is_given()) memory.width_mm = options.paper.width_mm;
  const auto report = [&] {
    if (options.joint_space) return Json{{"poses", joint_space_json(chain, poses, joints)}};
    return Json{{"reading", to_string(options.read_as(motion))},
                {"shape", options.form(motion).section ? "section" : "ellipsoid"},
                {"unit", options.read_as(motion) == EllipseReading::energy ? "m/s" : "kg"},
                {"poses", ellipse_json(tip, poses, options.form(motion))}};
  };
  const std::string csv = options.joint_space ? "" : ellipse_csv(tip, poses, options.form(motion));
  TableRecords records(*options.command, options.common.force);
  records.open(outputs, outputs);
  records.remember_named_poses(memory.figure);
  std::optional<Picture> picture;
  int numbers_left_out = 0;
  for (const std::string& output : outputs) {
    if (is_table_path(output)) {
      write_numbers(output, {csv, report}, options.common.force);
      continue;
    }
    if (!picture)
      picture = options.joint_space ? draw_joint_space_figure(chain, poses.q, joints, figure, fonts)
                                    : draw_ellipse_figure(tip, poses.q, figure, fonts, &numbers_left_out);
    write_picture(*picture, figure.width, figure.height, fonts, output, options.common.force, memory);
  }
  records.write();
  if (numbers_left_out > 0 && !options.common.quiet)
    std::fprintf(stderr, "note: %s no room here: all are in --json and .csv, %s\n",
                 numbers_left_out == 1 ? "the number of one semi-axis has" : ("the numbers of " + std::to_string(numbers_left_out) + " semi-axes have").c_str(),
                 figure.layout == "superposed" || figure.cell > 0 ? "and below the pictures of --layout grid" : "and a larger page has it");
  tell_files(options.common, outputs, report);
}

}  // namespace

void add_ellipse_command(CommandLine& app) {
  auto options = std::make_shared<EllipseOptions>();
  Command* command = app.add_subcommand("ellipse", "a figure of the effective mass at chosen poses");
  command->add_option("model", options->model, "a model (.urdf), or a scene (.yaml) for its model, as in numbers; not with --along").names_input(".urdf");
  PoseSources& sources = options->sources;
  command->add_repeatable("--pose", sources.poses, "q of the chain: --pose 0,90deg, by joints: --pose joint2=90deg, or a state of an SRDF beside it: --pose home (repeatable)");
  command->add_option("--sweep", sources.sweep, "poses that differ in one coordinate: --sweep q2=0:180deg:9");
  command->add_option("--along", sources.along, "poses along the motion of a scene (.yaml)").names_input();
  command->add_flag("--field", sources.field, "a grid of points of the workspace, of planar chains of 2 or 3 joints; of 3 at the pose whose joints behind the first bend alike");
  command->add_option("--samples", sources.samples, "poses --along (default 6), points across the --field (default 12)")
      .range(1, 200);
  command->add_option("--elbow", sources.elbow, "of a --field: up (default), the elbow left of the way to the end, or down")
      .one_of({"up", "down"});
  command->add_option("--reading", options->reading,
                      "mass: forces for unit accelerations (default); energy: velocities of equal kinetic energy; "
                      "belt: mass felt along each direction")
      .one_of(words_of(names_of(EllipseReading{})));
  command->add_option("--layout", options->layout, "of the poses: grid, row, superposed")
      .one_of(figure_layout_names());
  command->add_flag("--joint-space", options->joint_space, "the unit circle of accelerations beside its image under M(q)");
  command->add_option("--joints", options->joints, "the two joints of --joint-space: --joints 1,2");
  command->add_repeatable("-o,--output", options->outputs,
                          "a .png, .svg, .pdf, .csv, .json or .npz file (repeatable; default out/NAME_ellipse.png)");
  command->add_option("--end-effector", options->end_effector, "the link whose mass is felt");
  command->add_option("--title", options->title, "above the figure");
  add_scene_flags(*command, options->common.flags, FlagGroup::look);
  add_scene_flags(*command, options->common.flags, FlagGroup::view);
  command->add_option("--shape", options->shape, "of arms in space: ellipsoid, or section by the xy plane of the end effector")
      .one_of(words_of(names_of(EllipseShape{})));
  command->add_option("--width", options->width, "pixels").range(16, 16384);
  command->add_option("--height", options->height, "pixels (default: of a --layout row what its panels need)").range(16, 16384);
  add_paper_options(*command, options->paper, "what suits the poses");
  command->add_flag("--letters", options->letters, "(a), (b), .. before the captions of panels");
  add_scene_options(*command, options->common);
  add_result_options(*command, options->common);
  command->footer(
      "Example: chainreel ellipse rr.urdf --pose 0,90deg --pose 0,150deg -o out/ellipse.png");
  options->command = command;
  command->callback([options] { run_ellipse(*options); });
}

}  // namespace chainreel
