#include "app/paper/paper.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/error.hpp"
#include "core/format.hpp"
#include "draw/page/sheet.hpp"

namespace chainreel {
namespace {

constexpr int kPrintDpi = 300, kMostPixels = 16384;
constexpr double kMmPerInch = 25.4, kPointsPerMm = 72 / kMmPerInch;
constexpr double kSmallestPrint = 7;  // pt: what a paper's figure may say
constexpr double kLeastMm = 20, kMostMm = 2000;

double pixels_per_mm(const PaperOptions& options) {
  return (options.dpi > 0 ? options.dpi : kPrintDpi) / kMmPerInch;
}

}  // namespace

void add_paper_options(Command& command, PaperOptions& options, const std::string& default_height) {
  command.add_option("--width-mm", options.width_mm, "millimetres on paper: 84 for a column; nothing is written below 7 pt");
  command.add_option("--height-mm", options.height_mm, "goes with --width-mm (default: " + default_height + ")");
  command.add_option("--dpi", options.dpi, "of a .png with --width-mm (default 300)").range(50, 2400);
}

void check_paper(const PaperOptions& options, bool in_pixels) {
  for (const auto& [name, mm] : {std::pair{"--width-mm", options.width_mm}, {"--height-mm", options.height_mm}})
    if (mm != PaperOptions::kNotGiven && !(mm >= kLeastMm && mm <= kMostMm))
      throw Error(ExitCode::usage, std::string(name) + " takes millimetres between 20 and 2000, like 84");
  if (options.is_given() && in_pixels)
    throw Error(ExitCode::usage, "--width-mm is the size on paper: leave out --width and --height, --dpi says how many pixels");
  if (!options.is_given() && (options.height_mm != PaperOptions::kNotGiven || options.dpi > 0))
    throw Error(ExitCode::usage, "--height-mm and --dpi go with --width-mm");
}

PaperPage paper_page(const PaperOptions& options, double height_mm) {
  if (options.height_mm != PaperOptions::kNotGiven) height_mm = options.height_mm;
  const double per_mm = pixels_per_mm(options);
  const PaperPage page{options.width_mm, int(std::lround(options.width_mm * per_mm)), int(std::lround(height_mm * per_mm)),
                       kSmallestPrint / (height_mm * kPointsPerMm)};
  if (std::max(page.width, page.height) > kMostPixels)
    throw Error(ExitCode::usage, "--width-mm: that makes " + std::to_string(page.width) + " x " + std::to_string(page.height) +
                                     " pixels, more than " + std::to_string(kMostPixels) + " a side: take a smaller --dpi");
  return page;
}

double tallest_page(const PaperOptions& options) {
  return std::floor(kMostPixels / pixels_per_mm(options));
}

void give_size(Video& video, const PaperPage& page) {
  video.width = page.width;
  video.height = page.height;
  video.least_text = page.least_text;
}

double text_scale_on(const PaperPage& page, double text_scale) {
  return std::max(1.0, text_scale) * page.least_text / kSmallestText;
}

Json to_json(const PaperOptions& options) {
  if (!options.is_given()) return nullptr;
  Json json{{"width_mm", options.width_mm}};
  if (options.height_mm != PaperOptions::kNotGiven) json["height_mm"] = options.height_mm;
  if (options.dpi > 0) json["dpi"] = options.dpi;
  return json;
}

PaperOptions paper_of(const Json& json) {
  PaperOptions options;
  const auto number = [&](const char* key, double otherwise) { return json.is_object() && json.contains(key) && json[key].is_number() ? json[key].get<double>() : otherwise; };
  options.width_mm = number("width_mm", PaperOptions::kNotGiven);
  options.height_mm = number("height_mm", PaperOptions::kNotGiven);
  options.dpi = int(std::clamp(number("dpi", 0), 0.0, 1e6));
  check_paper(options, false);
  return options;
}

std::vector<std::string> paper_flags(const PaperOptions& options) {
  std::vector<std::string> flags;
  if (options.is_given()) flags = {"--width-mm", format_shortest(options.width_mm)};
  if (options.height_mm != PaperOptions::kNotGiven) flags.insert(flags.end(), {"--height-mm", format_shortest(options.height_mm)});
  if (options.dpi > 0) flags.insert(flags.end(), {"--dpi", std::to_string(options.dpi)});
  return flags;
}

}  // namespace chainreel
