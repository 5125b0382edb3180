// chainreel sheet SCENE... -o FILE: one picture a scene, or several instants, all on one page; .png, .svg or .pdf

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <map>
#include <iterator>
#include <memory>

#include "app/cli/command.hpp"
#include "app/cli/result.hpp"
#include "app/cli/streams.hpp"
#include "app/commands/figure.hpp"
#include "app/film/automatic.hpp"
#include "app/film/prepared.hpp"
#include "app/film/runs.hpp"
#include "app/film/target.hpp"
#include "app/paper/paper.hpp"
#include "app/report/report.hpp"
#include "app/report/run_report.hpp"
#include "app/works/moment.hpp"
#include "core/error.hpp"
#include "draw/figures/contact_sheet.hpp"
#include "draw/page/sheet.hpp"
#include "picture/formula_words.hpp"
#include "scene/run/title.hpp"
#include "scene/text/asked_instant.hpp"

namespace chainreel {
namespace {

struct SheetOptions {
  std::vector<std::string> scenes;
  std::vector<std::string> at;  // each one or several between commas; none: the telling one of each scene
  std::vector<std::string> outputs;
  int columns = 0;
  int width = 0, height = 0;  // 0: 1920 x 1080
  std::string title;          // above all; "": of one scene at several instants its own, else none
  PaperOptions paper;
  CommonOptions common;
  const Command* command = nullptr;
};

// Words of all cells stand on one page, in one face.
void leave_out_faces(Scene& scene, bool quiet) {
  if (!scene.style.fonts.empty() && !quiet)
    std::fprintf(stderr, "note: %s: a sheet has one face: the style's `fonts` are left out\n", scene.name.c_str());
  scene.style.fonts = {};
}

constexpr double kLargestNames = 0.1;  // of panels, units of the picture's height: larger ones leave their panels no room
constexpr double kNoNames = 1e-6;      // of which nothing is seen

// What a small picture shows: all that is drawn, without the words around it.
void set_for_cell(Scene& scene, ThemeName theme, const ContactGrid& grid) {
  const double text_scale = text_scale_in(grid);
  scene.video.height = 1000;
  scene.video.width = int(std::lround(scene.video.height * grid.page_aspect()));
  scene.video.preset = Preset::overlay;
  scene.video.panel_names = grid.smallest_in_cell() <= kLargestNames ? grid.smallest_in_cell() : kNoNames;
  scene.theme = theme;
  scene.text_scale = text_scale;
  if (scene.layout == PageLayout::automatic) scene.layout = PageLayout::scene;
  std::erase(scene.draw, "mass_matrix");  // its numbers could not be read
  scene.annotate.clear();                 // likewise its words, and lines without them lead nowhere
}

std::string stem_of(const std::string& file) {
  return std::filesystem::path(file).stem().string();
}

// Of all scenes, and of some by their names: `--at 0.5,pen=2.6s`.
struct AskedOfScenes {
  std::vector<AskedInstant> of_all;
  std::map<std::string, std::vector<AskedInstant>> of_one;

  const std::vector<AskedInstant>& of(const std::string& file) const {
    const auto own = of_one.find(stem_of(file));
    return own == of_one.end() ? of_all : own->second;
  }
  std::size_t cells_of(const std::string& file) const { return std::max<std::size_t>(of(file).size(), 1); }
};

AskedOfScenes instants_of(const SheetOptions& options) {
  AskedOfScenes asked;
  std::vector<std::string> names;
  for (const std::string& file : options.scenes) names.push_back(stem_of(file));
  for (const std::string& text : options.at)
    for (const std::string& part : parted_instants(text)) {
      const NamedText named = named_instant(part);
      if (!named.name.empty() && std::ranges::count(names, named.name) == 0)
        throw Error(ExitCode::usage, "--at " + text + ": no scene of the sheet is called '" + named.name + "':" + did_you_mean(named.name, names) + " There are " + joined(names));
      (named.name.empty() ? asked.of_all : asked.of_one[named.name]).push_back(asked_at(named.text, text));
    }
  return asked;
}

constexpr double kSheetOfPaper = 1.41421356237309505;  // height over width of A4 upright
constexpr double kTallestColumn = 240;                 // mm: of a page narrower than that, what a journal's column is high

constexpr double kWordsOfPaper = 1.35;  // times the smallest that can be read: 9.5 pt

struct SheetSize {
  int width = 1920, height = 1080;  // px
  double text_scale = 1;
  double least_text = size::kTick;
};
SheetSize size_on_paper(const SheetOptions& options, double height_mm) {
  const PaperPage page = paper_page(options.paper, height_mm);
  return {page.width, page.height, text_scale_on(page, kWordsOfPaper * text_scale_of(options.common.flags)), page.least_text};
}
double tallest_sheet(const SheetOptions& options) {
  return std::min(std::max(std::round(kSheetOfPaper * options.paper.width_mm), kTallestColumn), tallest_page(options.paper));
}
// Below them nobody reads a word, whatever scale is asked for.
constexpr double kLeastPixels = 9;

SheetSize size_of(const SheetOptions& options) {
  check_paper(options.paper, options.width > 0 || options.height > 0);
  if (options.paper.is_given()) return size_on_paper(options, tallest_sheet(options));
  SheetSize size;
  size.text_scale = text_scale_of(options.common.flags);
  if (options.width > 0) size.width = options.width;
  if (options.height > 0) size.height = options.height;
  if (size.text_scale < 1) size.least_text = std::min(size.least_text, kLeastPixels / size.height);
  return size;
}

// Plots that a scene asks for would have no room in a cell.
void leave_out_plots(Scene& scene, bool quiet) {
  if (scene.places.contains("plot") && !scene.plot.empty() && !quiet)
    std::fprintf(stderr, "note: %s: the pictures of a sheet have no plots: `chainreel snapshot` shows one instant with them\n", scene.name.c_str());
  if (!scene.annotate.empty() && !quiet)
    std::fprintf(stderr, "note: %s: the pictures of a sheet have none of the words of `annotate`: `chainreel snapshot` shows one instant with them\n", scene.name.c_str());
  scene.plot.clear();
}

// What all cells of a page share.
struct Page {
  const SheetOptions& options;
  ContactSheetLook look;
  ThemeName theme;
  std::size_t count;  // of cells
  const AskedOfScenes& asked;
  SheetSize size{};
  ContactGrid grid{};

  // The title of the only scene stands above its instants.
  bool is_of_one() const { return options.scenes.size() == 1 && count > 1; }
  void lay_out();
  // On a page of a given height.
  bool chooses_columns() const { return options.columns == 0 && !has_own_height(); }
  void take(const Page& other) { look = other.look, size = other.size, grid = other.grid; }
  void set_title(const std::string& title) {
    look.title = title;
    lay_out();
  }

 private:
  bool has_own_height() const { return options.paper.is_given() && options.paper.height_mm == PaperOptions::kNotGiven; }
  void fit_to_paper();
  void set_size(const SheetSize& chosen) {
    size = chosen;
    look.aspect = double(size.width) / size.height;
    look.text_scale = size.text_scale;
    look.least_text = size.least_text;
  }
};

void Page::lay_out() {
  look.columns = options.columns;
  set_size(size_of(options));
  if (has_own_height()) fit_to_paper();
  grid = contact_grid(int(std::min<std::size_t>(count, kMostCells + 1)), look);
}

// A page as high as its rows. Large pictures are worth a higher page: up to where they are as wide as their columns.
void Page::fit_to_paper() {
  constexpr int kMostAcross = 6;
  constexpr double kLowest = 0.1, kStep = 1, kHeight = 0.25;  // of the width; mm; power of what a higher page costs
  if (count > kMostCells) return;
  const ContactSheetLook asked_for = look;
  const double tallest = tallest_sheet(options);
  double best = 0, height = tallest;
  int columns = look.columns;
  for (int across = std::max(options.columns, 1); across <= (options.columns > 0 ? options.columns : std::min(int(count), kMostAcross)); ++across)
    for (double tried = std::ceil(kLowest * options.paper.width_mm); tried <= tallest; tried += kStep) {
      set_size(size_on_paper(options, tried));
      look.columns = across;
      double merit = 0;
      try {
        merit = contact_grid(int(count), look).pictures[0].width() / look.aspect / std::pow(tried, kHeight);
      } catch (const Error&) {
        continue;  // too low for its words
      }
      if (merit > best) best = merit, height = tried, columns = across;
    }
  look = asked_for;
  set_size(size_on_paper(options, height));
  look.columns = columns;
}

// Of several pictures each says which instant it is; of several scenes whose.
std::string title_of_cell(const Moment& moment, const Scene& scene, const Page& page) {
  const std::string title = moment.title.empty() ? scene.name : moment.title;
  const bool is_only_scene = page.options.scenes.size() == 1;
  if (is_only_scene && !page.is_of_one()) return title;
  const std::string time = time_text(moment.at);
  return is_only_scene ? time : time + ": " + title;
}

// Of one scene at several instants: what its run tells of itself, `{fall}`, stands there, too.
std::string title_of_run(const PreparedFilm& film, const std::string& file) {
  const std::string title = film.panels.size() == 1 ? title_of(film.panels.front().scene, &film.panels.front().simulation, Runs(film)[0]) : title_of_page(film.scene);
  return title.empty() ? stem_of(file) : title;
}

// A cell an instant that is asked for. `told` gets what they show in numbers. A run that is over by then shows its end.
std::vector<ContactCell> cells_of(const std::string& file, const SheetOptions& options, Page& page, Json& told) {
  PreparedFilm film = load_film(file, overrides_of(options.common), true, options.common.quiet);
  say_notices(film.panels, options.common.quiet);
  leave_out_faces(film.scene, options.common.quiet);
  leave_out_plots(film.scene, options.common.quiet);
  for (PreparedScene& panel : film.panels) panel.scene.plot.clear();
  if (page.is_of_one() && page.look.title.empty()) page.set_title(title_of_run(film, file));
  set_for_cell(film.scene, page.theme, page.grid);
  if (film.panels.size() > 1 && film.scene.video.panel_names == kNoNames && !options.common.quiet)
    std::fprintf(stderr, "note: %s: the names of its panels have no room in pictures so small: take fewer --columns, or a sheet of fewer pictures\n", film.scene.name.c_str());
  for (PreparedScene& panel : film.panels) set_for_cell(panel.scene, page.theme, page.grid);
  std::vector<AskedInstant> asked = page.asked.of(file);
  for (AskedInstant& one : asked)
    if (one.event.empty()) one.at = std::min(one.at, film.scene.duration);
  Moments moments(film, *page.look.fonts);
  std::vector<Moment> shown;
  if (asked.empty()) shown.push_back(moments.telling());
  for (Moment& moment : moments.together(instants_asked(film, asked))) shown.push_back(std::move(moment));
  std::vector<ContactCell> cells;
  for (Moment& moment : shown) {
    if (cells.empty()) tell_warnings(moment.warnings);
    told.push_back({{"scene", file}});
    told.back().update(moment.numbers);
    cells.push_back({std::move(moment.picture), title_of_cell(moment, film.scene, page)});
  }
  return cells;
}

// The problems of all scenes are told at once.
std::vector<ContactCell> cells_of(const SheetOptions& options, Page& page, Json& told) {
  std::vector<ContactCell> all;
  std::vector<Problem> problems;
  ExitCode code = ExitCode::bad_input;
  for (const std::string& file : options.scenes) {
    throw_if_interrupted();
    try {
      std::vector<ContactCell> own = cells_of(file, options, page, told);
      std::ranges::move(own, std::back_inserter(all));
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
  return all;
}

constexpr int kMostLines = 5;  // of a title below its picture

// The number of columns of the largest pictures below which all titles stand whole; false where there is none.
bool choose_columns(Page& page, const std::vector<ContactCell>& cells) {
  constexpr int kMostAcross = 12;
  const Page before = page;
  std::optional<Page> best;
  for (int across = 1; across <= std::min(int(cells.size()), kMostAcross); ++across)
    for (int lines = 1; lines <= kMostLines; ++lines) {
      page.look.columns = across;
      page.look.title_lines = lines;
      try {
        page.grid = contact_grid(int(cells.size()), page.look);
      } catch (const Error&) {
        break;  // too low for its words
      }
      if (title_lines_of(page.grid, cells, page.look) > lines) continue;
      if (!best || page.grid.pictures[0].width() > best->grid.pictures[0].width()) best.emplace(page);
      break;
    }
  page.take(best ? *best : before);
  return best.has_value();
}

// Below each picture its title stands whole, on as many lines as the longest one takes, where that leaves pictures.
void give_room_to_titles(Page& page, const std::vector<ContactCell>& cells) {
  if (page.chooses_columns() && choose_columns(page, cells)) return;
  while (page.grid.title_lines < kMostLines && title_lines_of(page.grid, cells, page.look) > page.grid.title_lines) {
    const Page before = page;
    page.look.title_lines = page.grid.title_lines + 1;
    try {
      page.lay_out();
    } catch (const Error&) {
      page.take(before);
      return;
    }
  }
}

// It shows no scene of its own but many: the command is remembered.
ClipMemory memory_of_sheet(const Command& command, const std::string& title, const std::vector<ContactCell>& cells) {
  ClipMemory memory = memory_of_figure(command, title.empty() ? "Contact sheet" : title);
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
  require_formulas(options.title, true);
  const std::vector<std::string> outputs = options.outputs.empty() ? std::vector<std::string>{"out/sheet.png"} : options.outputs;
  for (const std::string& output : outputs) picture_format_of(output);
  refuse_twice(outputs);
  const AskedOfScenes asked = instants_of(options);
  std::size_t count = 0;
  for (const std::string& file : options.scenes) count += asked.cells_of(file);
  const ThemeName theme = theme_of(options.common.flags);
  const Fonts fonts;
  Page page{.options = options, .look = {}, .theme = theme, .count = count, .asked = asked};
  page.look.title = options.title;
  page.look.is_paper = options.paper.is_given();
  page.look.theme = &theme_named(to_string(theme));
  page.look.fonts = &fonts;
  page.lay_out();
  Json told = Json::array();
  const std::vector<ContactCell> cells = cells_of(options, page, told);
  give_room_to_titles(page, cells);
  const Picture sheet = draw_contact_sheet(page.grid, cells, page.look);
  ClipMemory memory = memory_of_sheet(*options.command, page.look.title, cells);
  if (options.paper.is_given()) memory.width_mm = options.paper.width_mm;
  for (const std::string& output : outputs) write_picture(sheet, page.size.width, page.size.height, fonts, output, options.common.force, memory);
  tell_files(options.common, outputs, [&] { return Json{{"columns", page.grid.columns}, {"lines", page.grid.lines}, {"cells", told}}; });
}

}  // namespace

void add_sheet_command(CommandLine& app) {
  auto options = std::make_shared<SheetOptions>();
  Command* command =
      app.add_subcommand("sheet", "several pictures on one page: one of each scene, or one scene at several instants");
  command->add_option("scenes", options->scenes, "scene files, up to 48").required().names_input();
  command->add_repeatable("--at", options->at,
                   "instants, a picture each: --at 0.2s,1.5s,2.5s or --at \"event touch\"; of a scene that is over by then its end; of one scene "
                   "by its name: --at pen=2.6s (repeatable; default: the last event of a scene, else its middle)");
  command->add_repeatable("-o,--output", options->outputs, "a .png, .svg or .pdf file (repeatable; default out/sheet.png)");
  command->add_option("--title", options->title, "above all, maybe with formulas between dollar signs; default: of one scene at several instants its own");
  command->add_option("--columns", options->columns, "default: as many as make the pictures largest")
      .range(1, kMostCells);
  command->add_option("--width", options->width, "pixels (default 1920)").range(16, 16384);
  command->add_option("--height", options->height, "pixels (default 1080)").range(16, 16384);
  add_paper_options(*command, options->paper, "that of its rows");
  add_scene_flags(*command, options->common.flags, FlagGroup::look);
  add_scene_options(*command, options->common);
  add_result_options(*command, options->common);
  command->footer("Example: chainreel sheet rr_free rr_torque pen -o out/sheet.png\n"
                  "         chainreel sheet rr_free pen --at pen=2.6s,rr_free=1s --width-mm 210 -o out/two.pdf\n"
                  "         chainreel sheet rr_torque --at 0,0.4,0.8,1.2,1.6,2 --width-mm 210 -o out/handout.pdf");
  options->command = command;
  command->callback([options] { run_sheet(*options); });
}

}  // namespace chainreel
