#include "app/film/target.hpp"

#include <algorithm>
#include <array>
#include <filesystem>
#include <map>

#include "core/error.hpp"
#include "encode/video_writer.hpp"

namespace chainreel {
namespace {

namespace fs = std::filesystem;

struct EndingRow {
  const char* ending;
  TargetKind kind;
};
constexpr std::array<EndingRow, 9> kEndings = {{{".mp4", TargetKind::mp4},
                                                {".webm", TargetKind::webm},
                                                {".mov", TargetKind::mov},
                                                {".gif", TargetKind::gif},
                                                {".apng", TargetKind::apng},
                                                {".png", TargetKind::png},
                                                {".svg", TargetKind::svg},
                                                {".pdf", TargetKind::pdf},
                                                {".csv", TargetKind::csv}}};
constexpr const char* kFirstOfSequence = "000000";

// What a preset writes where no file is named: behind the scene's name.
std::vector<std::string> files_of_preset(const std::string& preset, const std::string& name) {
  if (preset == "web") return {name + ".webm", name + ".png"};
  if (preset == "overlay") return {name + ".mov", name + ".webm"};
  if (preset == "doc") return {name + ".gif"};
  if (preset == "frames") return {name + "_frames/" + name + "_" + kFirstOfSequence + ".png"};
  if (preset == "still") return {name + ".png", name + ".svg", name + ".pdf"};
  return {name + ".mp4"};  // slides, and no preset
}

bool names_folder(const std::string& output) {
  std::error_code ignored;
  return output.ends_with('/') || fs::is_directory(output, ignored) || fs::path(output).extension().empty();
}

void require_possible(const Target& target, const Scene& scene) {
  if (is_transparent(scene) && (target.kind == TargetKind::mp4 || target.kind == TargetKind::gif))
    throw Error(ExitCode::usage,
                target.path +
                    ": a transparent background cannot be written there: take .mov, .webm, .apng, .png, "
                    ".svg or .pdf",
                scene.place_of(scene.layout == "transparent" ? "layout" : "video.preset"));
  if (!scene.video.crf) return;
  try {
    if (target.kind == TargetKind::mp4 || target.kind == TargetKind::webm)
      require_settings({.width = scene.video.width,
                        .height = scene.video.height,
                        .fps = scene.video.fps,
                        .crf = scene.video.crf,
                        .codec = target.kind == TargetKind::mp4 ? VideoCodec::h264 : VideoCodec::vp9});
  } catch (const Error& error) {
    throw Error(ExitCode::usage, target.path + ": " + error.problems().front().message,
                scene.place_of("video.crf"));
  }
}

}  // namespace

bool is_clip(TargetKind kind) {
  return kind <= TargetKind::sequence;
}

bool is_still(TargetKind kind) {
  return kind == TargetKind::png || kind == TargetKind::svg || kind == TargetKind::pdf;
}

Target target_of(const std::string& path) {
  const fs::path file(path);
  if (file.extension() == ".png" && file.stem().string().ends_with(kFirstOfSequence))
    return {TargetKind::sequence, path, false};
  for (const EndingRow& row : kEndings)
    if (file.extension() == row.ending) return {row.kind, path, false};
  std::string endings;
  for (const EndingRow& row : kEndings) endings += std::string(endings.empty() ? "" : ", ") + row.ending;
  throw Error(ExitCode::usage, "-o " + path + ": no output has that ending; there are " + endings +
                                   ", NAME_000000.png for a sequence of pictures, and folders/");
}

void check_outputs(const std::vector<std::string>& outputs, std::size_t scenes) {
  std::size_t folders = 0;
  for (const std::string& output : outputs) {
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
    paths = files_of_preset(scene.video.preset, scene.name);
    for (std::string& path : paths) path = (folder / path).string();
    if (is_transparent(scene) && scene.video.preset.empty())
      paths = {(folder / (scene.name + ".mov")).string()};
  }
  std::vector<Target> targets;
  for (const std::string& path : paths) {
    targets.push_back(target_of(path));
    targets.back().is_implied = paths != outputs && targets.back().kind != TargetKind::sequence;
    require_possible(targets.back(), scene);
  }
  std::map<std::string, int> seen;
  for (const std::string& path : paths_of(targets))
    if (++seen[fs::path(path).lexically_normal().string()] > 1)
      throw Error(ExitCode::usage, "-o " + path + " is named twice");
  return targets;
}

std::vector<std::string> paths_of(const std::vector<Target>& targets) {
  std::vector<std::string> paths;
  for (const Target& target : targets) paths.push_back(target.path);
  return paths;
}

}  // namespace chainreel
