#include "app/film/target.hpp"

#include <algorithm>
#include <filesystem>
#include <regex>

#include "app/cli/streams.hpp"
#include "core/error.hpp"
#include "core/output_file.hpp"
#include "render/canvas.hpp"

namespace chainreel {
namespace {

namespace fs = std::filesystem;

// What a preset writes where no file is named: behind the scene's name.
std::vector<std::string> files_of_preset(Preset preset, const std::string& name) {
  switch (preset) {
    case Preset::web:
      return {name + ".webm", name + ".png"};
    case Preset::overlay:
      return {name + ".mov", name + ".webm"};
    case Preset::doc:
      return {name + ".gif"};
    case Preset::frames:
      return {name + "_frames/" + name + "_000000.png"};
    case Preset::still:
      return {name + ".png", name + ".svg", name + ".pdf"};
    case Preset::slides:
      break;
  }
  return {name + ".mp4"};
}

bool names_folder(const std::string& output) {
  std::error_code ignored;
  return output.ends_with('/') || fs::is_directory(output, ignored) || fs::path(output).extension().empty();
}

void require_possible(const Target& target, const Scene& scene) {
  const OutputFormat& format = *target.format;
  const auto keeps_opacity = [](const OutputFormat& row) { return row.shows != Shows::table && row.keeps_opacity; };
  if (is_transparent(scene) && !format.keeps_opacity)
    throw Error(ExitCode::usage,
                target.path + ": a transparent background cannot be written there: take " +
                    endings_of(keeps_opacity, "or"),
                scene.place_of(scene.layout == PageLayout::transparent ? "layout" : "video.preset"));
  if (!scene.video.crf || !format.codec || !has_crf(*format.codec)) return;
  try {
    require_settings({.width = scene.video.width,
                      .height = scene.video.height,
                      .fps = scene.video.fps,
                      .crf = scene.video.crf,
                      .codec = *format.codec});
  } catch (const Error& error) {
    throw Error(ExitCode::usage, target.path + ": " + error.problems().front().message,
                scene.place_of("video.crf"));
  }
}

}  // namespace

Target target_of(const std::string& path) {
  static const std::regex counter("%0?[0-9]*d");
  if (std::smatch found; std::regex_search(path, found, counter))
    throw Error(ExitCode::usage, "-o " + path + ": frames are counted from the first one's name: -o " + found.prefix().str() + "000000" + found.suffix().str());
  if (const OutputFormat* format = find_output_format(path)) return {format, path, false};
  throw Error(ExitCode::usage, "-o " + path + ": no output has that ending; there are " +
                                   endings_of([](const OutputFormat&) { return true; }, "and") +
                                   ", NAME_000000.png for a sequence of pictures, and folders/");
}

void check_outputs(const std::vector<std::string>& outputs, std::size_t scenes) {
  std::size_t folders = 0;
  for (const std::string& output : outputs) {
    if (output.empty()) throw Error(ExitCode::usage, "-o names no file");
    if (names_folder(output)) {
      ++folders;
      continue;
    }
    target_of(output);
    if (scenes > 1)
      throw Error(ExitCode::usage, "-o " + output + " names one file for several scenes: name a folder");
  }
  if (folders > 1 || (folders == 1 && outputs.size() > 1))
    throw Error(ExitCode::usage, "-o: name either one folder or files, each with its ending");
}

std::vector<Target> targets_of(const std::vector<std::string>& outputs, std::size_t scenes,
                               const Scene& scene) {
  check_outputs(outputs, scenes);
  std::vector<std::string> paths = outputs;
  if (outputs.empty() || names_folder(outputs.front())) {
    const fs::path folder = outputs.empty() ? fs::path("out") : fs::path(outputs.front());
    paths = files_of_preset(scene.video.preset.value_or(Preset::slides), scene.name);
    for (std::string& path : paths) path = (folder / path).string();
    if (is_transparent(scene) && !scene.video.preset)
      paths = {(folder / (scene.name + ".mov")).string()};
  }
  std::vector<Target> targets;
  for (const std::string& path : paths) {
    targets.push_back(target_of(path));
    targets.back().is_implied = paths != outputs && !targets.back().format->is_sequence;
    require_possible(targets.back(), scene);
  }
  refuse_twice(paths_of(targets));
  return targets;
}

std::vector<std::string> paths_of(const std::vector<Target>& targets) {
  std::vector<std::string> paths;
  for (const Target& target : targets) paths.push_back(target.path);
  return paths;
}

Image rasterise(const Picture& picture, int width, int height, const Fonts& fonts) {
  return Canvas(width, height, fonts, PageUse::still).drawn(picture);
}

const OutputFormat& picture_format_of(const std::string& path) {
  if (const OutputFormat* format = find_output_format(path, Shows::still)) return *format;
  const auto is_picture = [](const OutputFormat& row) { return row.shows == Shows::still; };
  throw Error(ExitCode::usage, "-o " + path + ": pictures are written as " + endings_of(is_picture, "or"));
}

void write_picture(const Picture& picture, int width, int height, const Fonts& fonts, const std::string& path,
                   bool overwrite, const ClipMemory& memory) {
  OutputFile output(path, overwrite);
  picture_format_of(path).write_still(
      output, {[&] { return picture; }, [&] { return rasterise(picture, width, height, fonts); }, height, fonts}, memory);
  throw_if_interrupted();
  output.commit();
}

}  // namespace chainreel
