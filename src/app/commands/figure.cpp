#include "app/commands/figure.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <optional>

#include "app/film/clip_origin.hpp"
#include "app/film/house_logo.hpp"
#include "app/film/target.hpp"
#include "app/report/sidecar.hpp"
#include "app/report/version.hpp"
#include "app/today/command_inputs.hpp"
#include "core/data_folder.hpp"
#include "core/error.hpp"
#include "core/format.hpp"
#include "core/hash.hpp"
#include "core/machine.hpp"
#include "core/output_file.hpp"
#include "draw/film/compose.hpp"
#include "draw/page/house_style.hpp"
#include "model/model_source.hpp"
#include "scene/text/scene_paths.hpp"
#include "table/data_table.hpp"

namespace chainreel {
namespace {

// Charts have many words beside and below their curves.
PaperPage on_paper(const FigureOptions& options) {
  return paper_page(options.paper, 0.75 * options.paper.width_mm);
}

struct PixelSize {
  int width = 1920, height = 1080;
};

PixelSize size_of(const FigureOptions& options) {
  if (options.paper.is_given()) {
    const PaperPage page = on_paper(options);
    return {page.width, page.height};
  }
  PixelSize size;
  if (options.width > 0) size.width = options.width;
  if (options.height > 0) size.height = options.height;
  return size;
}

std::string version_text() {
  return std::string(program_version()) + ", " + program_revision();
}

}  // namespace

void add_figure_options(Command& command, FigureOptions& options, CommonOptions& common,
                        const std::string& default_output) {
  command.add_repeatable("-o,--output", options.outputs,
                         "a .png, .svg, .pdf, .csv, .json or .npz file (repeatable; default " + default_output +
                             "); the numbers are written as CSV beside the picture");
  command.add_option("--width", options.width, "pixels").range(16, 16384);
  command.add_option("--height", options.height, "pixels").range(16, 16384);
  add_paper_options(command, options.paper, "three quarters of the width");
  add_scene_flags(command, common.flags, FlagGroup::look);
  options.command = &command;
}

void check_figure_size(const FigureOptions& options) {
  check_paper(options.paper, options.width > 0 || options.height > 0);
  size_of(options);
}

ChartLook chart_look(const FigureOptions& options, const Scene& scene, const Fonts& fonts) {
  constexpr double kSlide = 4.0 / 3;  // width by height: words of narrower pages are as large as on one that is as wide
  const PixelSize size = size_of(options);
  ChartLook look{double(size.width) / size.height, scene.text_scale, &page_theme(scene), &fonts};
  int unit = size.height;
  if (options.paper.is_given()) {
    look.text_scale = text_scale_on(on_paper(options), scene.text_scale);
  } else {
    unit = std::min(unit, int(std::lround(size.width / kSlide)));
    look.text_scale = std::max(scene.text_scale, kLeastWordPixels / (size::kTick * std::max(unit, kLeastPagePixels)));
  }
  look.height = double(size.height) / unit;
  look.logo = page_logo(scene, unit);
  look.is_small = options.paper.is_given() || look.text_scale > scene.text_scale;
  return look;
}

namespace {

// What is measured is another number at each time.
bool measures(const std::vector<std::string>& words) {
  return !words.empty() && words.front() == "chart";
}

}  // namespace

bool is_table_path(const std::string& path) {
  return find_table_format(path).has_value();
}

void check_figure_path(const std::string& path) {
  if (find_output_format(path, Shows::still) || is_table_path(path)) return;
  const auto is_picture = [](const OutputFormat& row) { return row.shows == Shows::still; };
  throw Error(ExitCode::usage, "-o " + path + ": charts are written as " + endings_of(is_picture, "or") +
                                   ", their numbers as .csv, .json or .npz");
}

void write_numbers(const std::string& path, const FigureNumbers& numbers, bool overwrite) {
  const TableFormat format = table_format_of(path);
  write_text_file(path,
                  format == TableFormat::csv   ? numbers.csv
                  : format == TableFormat::npz ? table_bytes(table_of_csv(numbers.csv), format)
                                               : numbers.report().dump(2, ' ', false, Json::error_handler_t::replace) + "\n",
                  overwrite);
}

FigureFiles::FigureFiles(const FigureOptions& options, const std::string& usual, bool overwrite)
    : options_(options), paths_(options.outputs), overwrite_(overwrite), records_(*options.command, overwrite) {
  std::vector<std::string> pictures;  // of beside_
  if (paths_.empty()) paths_.push_back(usual);
  for (const std::string& path : paths_) check_figure_path(path);
  refuse_twice(paths_);
  for (const std::string& path : paths_) {
    const OutputFile may_be_written(path, overwrite);  // throws where it may not
    const std::string table = std::filesystem::path(path).replace_extension(".csv").string();
    if (is_table_path(path) || is_named(table) || std::find(beside_.begin(), beside_.end(), table) != beside_.end()) continue;
    require_own_sidecar(table, overwrite);
    const OutputFile beside_it(table, overwrite);
    beside_.push_back(table);
    pictures.push_back(path);
  }
  if (measures(options.command->words()) || options.is_one_of_several) return;
  records_.open(paths_, paths_);
  records_.open(beside_, pictures);  // each is made again with its picture
}

ClipMemory memory_of_chart(const FigureOptions& options) {
  ClipMemory memory = memory_of_figure(*options.command, "");
  if (options.is_one_of_several) memory.figure.erase(kInputs);
  if (options.paper.is_given()) memory.width_mm = options.paper.width_mm;
  return memory;
}

namespace {

// The first bold line on it, with the formulas in it; "" where it has none.
std::string title_on(const Picture& picture) {
  std::string title;
  std::optional<double> line;
  for (const Item& item : picture.items) {
    const auto* run = std::get_if<GlyphRun>(&item.shape);
    if (run == nullptr || run->stroke_width > 0) continue;
    if (!line && run->face != Face::label_bold) continue;
    if (line && *line != run->origin.y) break;
    line = run->origin.y;
    title += run->text;
  }
  return title;
}

}  // namespace

void write_figure(const FigureOptions& options, const Picture& picture, const Fonts& fonts, ClipMemory memory, const std::string& path, bool overwrite) {
  const PixelSize size = size_of(options);
  memory.title = title_on(picture);
  if (memory.title.empty()) memory.title = std::filesystem::path(path).stem().string();
  write_picture(picture, size.width, size.height, fonts, path, overwrite, memory);
}

bool FigureFiles::is_named(const std::string& path) const {
  return std::any_of(paths_.begin(), paths_.end(), [&](const std::string& one) {
    return std::filesystem::path(one).lexically_normal() == std::filesystem::path(path).lexically_normal();
  });
}

std::vector<std::string> FigureFiles::write(const std::function<Picture()>& draw, const FigureNumbers& numbers, const Fonts& fonts) {
  std::vector<std::string> written;
  std::optional<Picture> picture;
  std::optional<ClipMemory> memory;
  for (const std::string& path : paths_) {
    written.push_back(path);
    if (is_table_path(path)) {
      write_numbers(path, numbers, overwrite_);
      forget_record(path);  // a new one is written below
      continue;
    }
    if (!picture) picture = draw(), memory = memory_of_chart(options_);
    write_figure(options_, *picture, fonts, *memory, path, overwrite_);
  }
  for (const std::string& table : beside_) {
    write_text_file(table, numbers.csv, overwrite_);
    forget_record(table);
    written.push_back(table);
  }
  records_.write();
  return written;
}

namespace {

// "" where it names none.
std::string first_file(const Command& command) {
  const std::vector<std::string> words = command.words();
  for (const std::size_t i : command.files())
    if (begin_of_path(words[i], words[i - 1]) == 0) return words[i];
  return "";
}

// The first file's, from which those of a figure are remembered: a name that a copy elsewhere has, too.
std::string folder_of(const Command& command) {
  return std::filesystem::path(first_file(command)).parent_path().string();
}

}  // namespace

ClipMemory memory_of_figure(const Command& command, const std::string& title) {
  const std::vector<std::string> words = words_from(command, folder_of(command));
  ClipMemory memory{title, {}, {}, {}, {{"arguments", words}, {"files", command.files()}}};
  if (const Json inputs = measures(words) ? Json() : command_inputs(command.words(), command.files()); are_known(inputs)) memory.figure[kInputs] = inputs;
  if (const std::string first = first_file(command); !first.empty() && !name_of_shipped(first).empty()) memory.figure[kShipped] = true;
  return memory;
}

ClipMemory memory_of_figure(const Command& command, const std::string& title, const std::string& model,
                            const std::vector<std::vector<double>>& poses) {
  ClipMemory memory = memory_of_figure(command, title);
  memory.figure["poses"] = poses;
  if (model.empty()) return memory;
  memory.figure["model"] = path_from(folder_of(command), model);
  memory.figure["model_sha256"] = sha256_of_file(model);
  memory.figure["model_elements_sha256"] = ModelSource(model).elements_sha256();
  return memory;
}

void remember_named_poses(ClipMemory& memory, const NamedPoses& poses) {
  if (!poses.empty()) memory.figure["named_poses"] = poses;
}

std::vector<const Method*> parse_methods(const std::string& text, const std::string& option) {
  std::vector<const Method*> chosen;
  if (text.empty())
    for (const Method& method : methods()) chosen.push_back(&method);
  std::size_t begin = 0;
  while (begin < text.size()) {
    const std::size_t end = std::min(text.find(',', begin), text.size());
    try {
      chosen.push_back(&find_method(text.substr(begin, end - begin)));
    } catch (const Error& error) {
      throw Error(ExitCode::usage, option + ": " + error.problems().front().message);
    }
    begin = end + 1;
  }
  return chosen;
}

std::vector<std::string> parse_highlight(const std::string& text, const std::vector<const Method*>& chosen) {
  std::vector<std::string> names;
  if (text.empty()) return names;
  for (const Method* method : parse_methods(text, "--highlight")) {
    if (std::find(chosen.begin(), chosen.end(), method) == chosen.end())
      throw Error(ExitCode::usage, "--highlight: " + method->name + " is not among --methods");
    names.push_back(method->name);
  }
  return names;
}

std::string csv_facts(const std::string& scene) {
  return "# scene: " + scene + "\n# machine: " + processor_name() + "\n# system: " + system_name() +
         "\n# compiler: " + compiler_name() + "\n# revision: " + version_text() + "\n";
}

std::string machine_line() {
  return processor_name() + "; " + compiler_name() + "; chainreel " + version_text();
}

}  // namespace chainreel
