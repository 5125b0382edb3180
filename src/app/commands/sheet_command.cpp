// chainreel sheet SCENE... -o FILE: one picture a scene, all on one page; .png, .svg or .pdf

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <memory>

#include "app/cli/command.hpp"
#include "app/cli/result.hpp"
#include "app/cli/streams.hpp"
#include "app/commands/figure.hpp"
#include "app/works/moment.hpp"
#include "app/film/automatic.hpp"
#include "app/film/prepared.hpp"
#include "app/film/runs.hpp"
#include "app/film/target.hpp"
#include "app/report/report.hpp"
#include "app/report/run_report.hpp"
#include "core/error.hpp"
#include "draw/figures/contact_sheet.hpp"
#include "scene/quantity.hpp"

namespace chainreel {
namespace {

struct SheetOptions {
  std::vector<std::string> scenes;
  std::string at;
  std::string output = "out/sheet.png";
  int columns = 0;
  int width = 1920, height = 1080;
  CommonOptions common;
  const Command* command = nullptr;
};

// Words of all cells stand on one page, in one face.
void leave_out_faces(Scene& scene, bool quiet) {
  if (!scene.style.fonts.empty() && !quiet)
    std::fprintf(stderr, "note: %s: a sheet has one face: the style's `fonts` are left out\n", scene.name.c_str());
  scene.style.fonts = {};
}

// What a small picture shows: all that is drawn, without the words around it.
void set_for_cell(Scene& scene, ThemeName theme, double text_scale) {
  scene.video.height = 1000;
  scene.video.width = int(std::lround(scene.video.height * kCellPageAspect));
  scene.video.preset = Preset::overlay;
  scene.video.names_panels = text_scale >= 1;  // words can be read there
  scene.theme = theme;
  scene.text_scale = text_scale;
  scene.plot.clear();
  if (scene.layout == PageLayout::automatic) scene.layout = PageLayout::scene;
  std::erase(scene.draw, "mass_matrix");  // its numbers could not be read
}

// `told` gets what the cell shows in numbers.
ContactCell cell_of(const std::string& file, const SheetOptions& options, ThemeName theme,
                    double text_scale, const Fonts& fonts, Json& told) {
  PreparedFilm film = load_film(file, overrides_of(options.common), true, options.common.quiet);
  say_notices(film.panels, options.common.quiet);
  leave_out_faces(film.scene, options.common.quiet);
  set_for_cell(film.scene, theme, text_scale);
  for (PreparedScene& panel : film.panels) set_for_cell(panel.scene, theme, text_scale);
  Moment moment = options.at.empty()
                      ? telling_moment(film, fonts)
                      : moment_at(film, std::min(parse_seconds(options.at, "--at"), film.scene.duration), fonts);
  tell_warnings(moment.warnings);
  told.push_back({{"scene", file}});
  told.back().update(moment.numbers);
  return {std::move(moment.picture), moment.title.empty() ? film.scene.name : moment.title};
}

// The problems of all scenes are told at once.
std::vector<ContactCell> cells_of(const SheetOptions& options, ThemeName theme, double text_scale,
                                  const Fonts& fonts, Json& told) {
  std::vector<ContactCell> cells;
  std::vector<Problem> problems;
  ExitCode code = ExitCode::bad_input;
  for (const std::string& file : options.scenes) {
    throw_if_interrupted();
    try {
      cells.push_back(cell_of(file, options, theme, text_scale, fonts, told));
    } catch (const Error& error) {
      if (error.code() == ExitCode::interrupted || error.code() == ExitCode::terminated) throw;
      code = error.code();
      for (Problem problem : error.problems()) {
        if (problem.place.file.empty()) problem.place.file = file;
        problems.push_back(std::move(problem));
      }
    }
  }
  if (!problems.empty()) throw Error(code, std::move(problems));
  return cells;
}

// It shows no scene of its own but many: the command is remembered.
ClipMemory memory_of_sheet(const Command& command, const std::vector<ContactCell>& cells) {
  ClipMemory memory = memory_of_figure(command, "Contact sheet");
  for (const ContactCell& cell : cells)
    memory.description += (memory.description.empty() ? "" : "; ") + cell.title;
  return memory;
}

// What a sheet decides for all its cells is not left to a scene's key, which would be passed over.
void refuse_own_keys(const std::vector<std::string>& set) {
  for (const std::string& text : set) {
    const std::string key = text.substr(0, text.find_first_of(".="));
    if (key == "theme" || key == "text_scale")
      throw Error(ExitCode::usage, "--set " + text + ": a sheet has one look: take --" +
                                       (key == "theme" ? "theme" : "text-scale"));
    if (key == "video" || key == "plot")
      throw Error(ExitCode::usage, "--set " + text + ": the pictures of a sheet have a size of their own and no plots: " +
                                       "take --width, --height and --columns");
  }
}

void run_sheet(const SheetOptions& options) {
  refuse_own_keys(options.common.set);
  picture_format_of(options.output);
  if (!options.at.empty() && parse_seconds(options.at, "--at") < 0)
    throw Error(ExitCode::usage, "--at " + options.at + " lies before the start");
  const ThemeName theme = theme_of(options.common.flags);
  const Fonts fonts;
  const ContactSheetLook look{double(options.width) / options.height, options.columns,
                              text_scale_of(options.common.flags), &theme_named(to_string(theme)), &fonts};
  const ContactGrid grid = contact_grid(int(options.scenes.size()), look);
  Json told = Json::array();
  const std::vector<ContactCell> cells = cells_of(options, theme, text_scale_in(grid), fonts, told);
  write_picture(draw_contact_sheet(grid, cells, look), options.width, options.height, fonts, options.output,
                options.common.force, memory_of_sheet(*options.command, cells));
  tell_files(options.common, {options.output},
             [&] { return Json{{"columns", grid.columns}, {"lines", grid.lines}, {"cells", told}}; });
}

}  // namespace

void add_sheet_command(CommandLine& app) {
  auto options = std::make_shared<SheetOptions>();
  Command* command =
      app.add_subcommand("sheet", "a contact sheet: one picture of each scene, all on one page");
  command->add_option("scenes", options->scenes, "scene files, up to 48").required().names_input();
  command->add_option(
      "--at", options->at,
      "instant of every scene in seconds, or its end where that is earlier (default: the last "
      "event of a scene, else its middle)");
  command->add_option("-o,--output", options->output, "a .png, .svg or .pdf file (default out/sheet.png)");
  command->add_option("--columns", options->columns, "default: as many as make the pictures largest")
      .range(1, kMostCells);
  command->add_option("--width", options->width, "pixels").range(16, 16384);
  command->add_option("--height", options->height, "pixels").range(16, 16384);
  add_scene_flags(*command, options->common.flags, FlagGroup::look);
  add_scene_options(*command, options->common);
  add_result_options(*command, options->common);
  command->footer("Example: chainreel sheet rr_free rr_torque pen -o out/sheet.png");
  options->command = command;
  command->callback([options] { run_sheet(*options); });
}

}  // namespace chainreel
