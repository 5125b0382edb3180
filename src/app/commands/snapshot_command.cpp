// chainreel snapshot SCENE --at T -o FILE, chainreel snapshot MODEL --pose Q -o FILE; .png, .svg or .pdf
// chainreel snapshot SCENE --at 0,1.2s -o FOLDER/, chainreel snapshot MODEL --pose home=Q --pose reach=Q -o
// FOLDER/

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>

#include "app/cli/command.hpp"
#include "app/cli/named_pose.hpp"
#include "app/cli/result.hpp"
#include "app/cli/streams.hpp"
#include "app/commands/figure.hpp"
#include "app/film/automatic.hpp"
#include "app/film/model_scene.hpp"
#include "app/film/prepared.hpp"
#include "app/film/runs.hpp"
#include "app/film/target.hpp"
#include "app/paper/paper.hpp"
#include "app/paper/paper_film.hpp"
#include "app/report/instant_report.hpp"
#include "app/report/report.hpp"
#include "app/report/run_report.hpp"
#include "app/works/moment.hpp"
#include "core/error.hpp"
#include "core/output_file.hpp"
#include "draw/figures/poses.hpp"
#include "draw/page/house_style.hpp"
#include "model/read_chain.hpp"
#include "render/canvas.hpp"
#include "scene/text/asked_instant.hpp"
#include "scene/text/picture_names.hpp"

namespace chainreel {
namespace {

struct SnapshotOptions {
  std::string file;
  std::vector<std::string> at;  // each one or several between commas; none: 0
  std::vector<std::string> poses;
  std::vector<std::string> outputs;
  std::string end_effector;
  std::vector<std::string> vary;
  int width = 0, height = 0;
  PaperOptions paper;
  CommonOptions common;
  const Command* command = nullptr;
};

// The keys that the command line names, however it does.
std::vector<std::string> overrides_of(const SnapshotOptions& options) {
  std::vector<std::string> overrides = overrides_of(options.common);
  if (!options.end_effector.empty()) overrides.push_back("end_effector=" + Json(options.end_effector).dump());
  return overrides;
}

constexpr std::size_t kMostPictures = 500;  // of one command: all are held open until all are whole

// Where pictures go: the files of one picture, or a folder with a file each.
struct OutputPlace {
  std::vector<std::string> paths;
  bool is_folder = false;
};

OutputPlace place_of(const SnapshotOptions& options, std::size_t pictures) {
  std::error_code ignored;
  const std::string stem = std::filesystem::path(options.file).stem().string();
  if (options.outputs.empty())
    return pictures > 1 ? OutputPlace{{"out/" + stem}, true} : OutputPlace{{"out/" + stem + ".png"}, false};
  bool is_folder = false;
  for (const std::string& output : options.outputs) {
    const bool is_one = output.ends_with('/') || std::filesystem::is_directory(output, ignored);
    is_folder |= is_one;
    if (is_one && options.outputs.size() > 1)
      throw Error(ExitCode::usage, "-o " + output + ": a folder holds a picture each; several -o name files of one picture");
    if (!is_one) picture_format_of(output);
    if (!is_one && pictures > 1)
      throw Error(ExitCode::usage, "-o " + output + " names one file for " + std::to_string(pictures) +
                                       " pictures: name a folder, like -o out/");
  }
  refuse_twice(options.outputs);
  return {options.outputs, is_folder};
}

// Files that take their names together, when all are whole.
class Pictures {
 public:
  // `names` are those of files without ending; ignored where there is one picture. Begins to get a renderer ready.
  Pictures(const SnapshotOptions& options, OutputPlace place, const std::vector<std::string>& names, int width, int height)
      : place_(std::move(place)), height_(height) {
    if (names.size() > kMostPictures)
      throw Error(ExitCode::usage, "asks for " + std::to_string(names.size()) + " pictures; " +
                                       std::to_string(kMostPictures) +
                                       " are the most of one command: take several");
    for (const std::string& name : names) {
      files_.emplace_back();
      for (const std::string& path : place_.paths) {
        const auto file = place_.is_folder ? std::filesystem::path(path) / (name + ".png") : std::filesystem::path(path);
        files_.back().push_back(std::make_unique<OutputFile>(file.string(), options.common.force));
        if (picture_format_of(file.string()).has_pixels && !renderer_) renderer_.emplace(width, height, PageUse::still);
      }
    }
  }

  void write(std::size_t i, const Picture& picture, const Fonts& fonts, const ClipMemory& memory) {
    const auto image = [&] {
      if (!canvas_) canvas_ = std::make_unique<Canvas>(std::move(*renderer_), fonts);
      Image pixels;
      canvas_->draw(picture, pixels);
      return pixels;
    };
    for (const std::unique_ptr<OutputFile>& file : files_[i])
      picture_format_of(file->path()).write_still(*file, {[&] { return picture; }, image, height_, fonts}, memory);
    throw_if_interrupted();
  }

  // `numbers`: what each picture shows.
  void commit(const SnapshotOptions& options, const std::vector<Json>& numbers) {
    std::vector<std::string> list;
    Json pictures = Json::array();
    for (std::size_t i = 0; i < files_.size(); ++i) {
      std::vector<std::string> own;
      for (const std::unique_ptr<OutputFile>& file : files_[i]) {
        file->commit();
        own.push_back(file->path());
        list.push_back(file->path());
      }
      pictures.push_back(files_json(own));
      pictures.back().update(numbers[i]);
    }
    tell_files(options.common, list, [&] { return Json{{"pictures", pictures}}; });
  }

 private:
  OutputPlace place_;
  int height_;
  std::vector<std::vector<std::unique_ptr<OutputFile>>> files_;  // of each picture
  std::optional<ComingRenderer> renderer_;
  std::unique_ptr<Canvas> canvas_;
};

// As named_text, of a pose, where a name in front may be a joint's: elbow=90deg has none, home=elbow=90deg has.
NamedText named_pose(const Chain& chain, const std::string& text) {
  const NamedText named = named_text(text);
  const std::vector<std::string> coordinates = position_names(chain);
  const bool is_joint = std::find(coordinates.begin(), coordinates.end(), named.name) != coordinates.end();
  return is_joint ? NamedText{"", text} : named;
}

// The name of a pose may have been to be a joint's, where one number is no pose.
void refuse_mistyped_joints(const Chain& chain, const std::vector<std::string>& poses) {
  for (const std::string& text : poses) {
    const NamedText named = named_pose(chain, text);
    if (named.name.empty() || named.text.find_first_of(",=") != std::string::npos || chain.nq == 1) continue;
    if (const std::string near = did_you_mean(named.name, position_names(chain)); !near.empty())
      throw Error(ExitCode::usage, "--pose " + text + ": " + chain.name + " has no coordinate '" + named.name + "':" + near);
  }
}

// Two pictures of one name would be one file.
void require_own_names(const std::vector<std::string>& names, const std::string& option) {
  ProblemList problems;
  PictureNames given;
  for (const std::string& name : names) given.add(name, {option}, problems);
  problems.throw_if_any(ExitCode::usage);
}

// A page of that shape on paper.
PaperPage page_of(const SnapshotOptions& options, int width, int height) {
  return paper_page(options.paper, options.paper.width_mm * height / width);
}

void snapshot_scene(const SnapshotOptions& options) {
  std::vector<AskedInstant> asked;
  std::vector<std::string> names;
  const std::string stem = std::filesystem::path(options.file).stem().string();
  for (const std::string& text : options.at.empty() ? std::vector<std::string>{"0"} : options.at)
    for (const std::string& part : parted_instants(text)) {
      const NamedText named = named_instant(part);
      asked.push_back(asked_at(named.text, text));
      names.push_back(file_name_of(named.name.empty() ? stem + "_" + asked.back().name() : named.name));
    }
  require_own_names(names, "--at");
  const OutputPlace place = place_of(options, asked.size());

  std::vector<std::string> overrides = overrides_of(options);
  add_comparison(options.vary, options.file, options.common.quiet, overrides);
  PreparedFilm film = load_film(options.file, overrides, true, options.common.quiet);
  require_varied_read(options.vary, film.scene);
  say_notices(film.panels, options.common.quiet);
  Video& video = film.scene.video;
  // As --set has it, so that the picture can be asked about and made again.
  const auto give = [&film](int given, int& size, const char* key) {
    if (given <= 0) return;
    size = given;
    film.scene.set.push_back(std::string(key) + "=" + std::to_string(given));
  };
  give(options.width, video.width, "video.width");
  give(options.height, video.height, "video.height");
  const std::vector<double> instants = instants_asked(film, asked);
  const Fonts fonts(families_of(film.scene));
  if (options.paper.is_given()) set_paper_page(film, options.paper, fonts, options.common.quiet);
  Pictures pictures(options, place, names, video.width, video.height);
  Moments moments(film, fonts);
  const Json alone = told_alone(film);
  std::vector<Json> numbers;
  for (std::size_t i = 0; i < instants.size(); ++i) {
    Moment shown = moments.moment(instants[i]);
    shown.memory.audit.update(alone);
    if (!asked[i].event.empty()) shown.memory.audit[kAtEvent] = asked[i].event;
    if (options.paper.is_given()) {
      shown.memory.width_mm = options.paper.width_mm;
      shown.memory.audit[kPaper] = to_json(options.paper);
    }
    if (i == 0) tell_warnings(shown.warnings);
    if (i == 0) tell_left_out(shown.left_out, shown.held_text_scale, film.scene, options.common.quiet);
    pictures.write(i, shown.picture, fonts, shown.memory);
    numbers.push_back(shown.numbers);
  }
  pictures.commit(options, numbers);
}

// What each picture shows: of a folder a pose each; of one file all poses in one place.
struct PosePicture {
  std::string name;
  std::vector<std::vector<double>> poses;
  NamedPoses named{};
};

std::vector<PosePicture> pose_pictures(const Chain& chain, const SnapshotOptions& options, bool is_folder) {
  const std::string stem = std::filesystem::path(options.file).stem().string();
  std::vector<PosePicture> pictures;
  for (const std::string& text : options.poses) {
    const NamedText named = named_pose(chain, text);
    const std::string numbers = named_pose_text(chain, options.file, named.text, "--pose");
    const std::vector<double> q = parse_pose(chain, numbers, "--pose");
    const std::string own_name = named.name.empty() && numbers != named.text ? named.text : named.name;
    const bool joins = !is_folder && !pictures.empty();
    if (!joins)
      pictures.push_back(
          {file_name_of(own_name.empty() ? stem + "_" + std::to_string(pictures.size() + 1) : own_name),
           {}});
    pictures.back().poses.push_back(q);
    if (numbers != named.text) pictures.back().named[named.text] = numbers;
  }
  if (pictures.empty()) pictures.push_back({file_name_of(stem), {zero_configuration(chain)}});
  return pictures;
}

// Of several files each remembers the command that makes it alone: its pose, whose name was the file's.
// `memory`: what all have.
ClipMemory memory_of_pose(ClipMemory memory, const SnapshotOptions& options, const Chain& chain,
                          const std::vector<PosePicture>& shown, std::size_t i) {
  memory.figure["poses"] = shown[i].poses;
  Json words = Json::array();
  std::size_t pose = 0;
  const Json all = memory.figure["arguments"];
  for (std::size_t k = 0; k < all.size(); ++k) {
    words.push_back(all[k]);
    if (all[k] != Json("--pose")) continue;
    ++k;
    const bool is_shown = shown.size() == 1 || pose++ == i;
    if (is_shown)
      words.push_back(named_pose(chain, all[k].get<std::string>()).text);
    else
      words.erase(words.size() - 1);
  }
  memory.figure["arguments"] = words;
  remember_named_poses(memory, shown[i].named);
  if (options.paper.is_given()) memory.width_mm = options.paper.width_mm;
  return memory;
}

void snapshot_model(const SnapshotOptions& options) {
  if (!options.at.empty() || !options.vary.empty())
    throw Error(ExitCode::usage, "--at and --vary go with a scene; a model stands still at --pose");
  const ModelScene model =
      model_scene_of(options.file, overrides_of(options), "snapshot", keys_of_models(OfModel::picture));
  const Chain chain = read_chain(options.file, model.options);
  tell_warnings(chain.slips);
  refuse_mistyped_joints(chain, options.poses);
  const bool is_named = std::any_of(options.poses.begin(), options.poses.end(), [&](const std::string& text) {
    return !named_pose(chain, text).name.empty();
  });
  // Poses without names in one file are one picture with all of them; a file for one that has a name has its own.
  OutputPlace place = place_of(options, is_named ? options.poses.size() : 1);
  if (is_named && options.outputs.empty())
    place = {{"out/" + std::filesystem::path(options.file).stem().string()}, true};
  if (is_named && !place.is_folder && options.poses.size() > 1)
    throw Error(ExitCode::usage, "-o " + options.outputs.front() +
                                     ": poses with names are files of their own in a folder: name that, " +
                                     "like -o out/, or leave the names out");
  const std::vector<PosePicture> shown = pose_pictures(chain, options, place.is_folder);
  std::vector<std::string> names;
  for (const PosePicture& one : shown) names.push_back(one.name);
  require_own_names(names, "--pose");
  const Fonts fonts(families_of(model.scene));
  PoseFigureOptions figure;
  set_look(figure, model, chain);
  if (options.width > 0) figure.width = options.width;
  if (options.height > 0) figure.height = options.height;
  if (options.paper.is_given()) {
    const PaperPage page = page_of(options, figure.width, figure.height);
    figure.width = page.width;
    figure.height = page.height;
    figure.text_scale = text_scale_on(page, figure.text_scale);
  }
  Pictures pictures(options, place, names, figure.width, figure.height);
  const ClipMemory memory = memory_of_figure(*options.command, chain.name, options.file, {});
  std::vector<Json> numbers;
  for (std::size_t i = 0; i < shown.size(); ++i) {
    pictures.write(i, draw_pose_figure(chain, shown[i].poses, figure, fonts), fonts, memory_of_pose(memory, options, chain, shown, i));
    Json poses = Json::array();
    for (const std::vector<double>& q : shown[i].poses) poses.push_back(pose_report(chain, q));
    numbers.push_back({{"poses", poses}});
  }
  pictures.commit(options, numbers);
}

void run_snapshot(const SnapshotOptions& options) {
  check_paper(options.paper, options.width > 0 || options.height > 0);
  if (is_model_file(options.file)) return snapshot_model(options);
  if (!options.poses.empty()) throw Error(ExitCode::usage, "--pose goes with a model; a scene takes --at");
  snapshot_scene(options);
}

}  // namespace

void add_snapshot_command(CommandLine& app) {
  auto options = std::make_shared<SnapshotOptions>();
  Command* command =
      app.add_subcommand("snapshot", "one picture: a scene at an instant, or a model at poses");
  command->add_option("file", options->file, "a scene (.yaml) or a model (.urdf)").required().names_input();
  command->add_repeatable("--at", options->at,
                          "instants of the scene: 1.2s, `event NAME`, or several between commas, maybe "
                          "named: hit=1.2s (default 0)");
  command->add_repeatable("--pose", options->poses,
                          "q of a model: --pose 0,90deg, by joints: --pose joint2=90deg, named: --pose home=0,90deg, or a state of an SRDF beside it: --pose home (repeatable)");
  command->add_repeatable(
      "-o,--output", options->outputs,
      "a .png, .svg or .pdf file, which holds all poses at once (repeatable); or a folder for a picture each (default "
      "out/NAME.png, of several out/NAME/)");
  command->add_option("--end-effector", options->end_effector,
                      "the link that is marked, where there are several ends");
  command->add_option("--width", options->width, "pixels").range(16, 16384);
  command->add_option("--height", options->height, "pixels").range(16, 16384);
  add_paper_options(*command, options->paper, "by the page's shape");
  add_scene_flags(*command, options->common.flags, FlagGroup::look);
  add_scene_flags(*command, options->common.flags, FlagGroup::page);
  add_scene_flags(*command, options->common.flags, FlagGroup::view);
  add_vary_option(*command, options->vary);
  add_scene_options(*command, options->common);
  add_result_options(*command, options->common);
  command->footer(
      "Example: chainreel snapshot rrr_torque --at 1.2 -o out/rrr.png\n"
      "         chainreel snapshot rr.urdf --pose home=0,0 --pose reach=40deg,-90deg -o out/poses/");
  options->command = command;
  command->callback([options] { run_snapshot(*options); });
}

}  // namespace chainreel
