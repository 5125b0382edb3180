// chainreel doctor: whether this machine has what a film needs.

#include <algorithm>
#include <cstdio>
#include <memory>
#include <optional>

#include "app/cli/command.hpp"
#include "app/cli/result.hpp"
#include "app/report/report.hpp"
#include "core/error.hpp"
#include "core/own_environment.hpp"
#include "encode/library_versions.hpp"
#include "picture/text.hpp"
#include "render/canvas.hpp"
#include "render/renderer_pins.hpp"

namespace chainreel {
namespace {

// What it takes and whether it is there; what is missing is remembered with its remedy.
struct Examination {
  Json report;
  std::vector<Problem> missing;
};

void examine_fonts(Examination& examination) {
  try {
    const Fonts fonts;
    for (const auto& [name, face] :
         {std::pair{"label", Face::label}, std::pair{"label_bold", Face::label_bold},
          std::pair{"math", Face::math}})
      examination.report["fonts"][name] = {{"file", fonts.file(face)}, {"sha256", fonts.sha256(face)}};
    const Canvas canvas(64, 64, fonts);
    const RendererInfo info = canvas.info();
    examination.report["renderer"] = {
        {"backend", info.backend}, {"renderer", info.renderer}, {"version", info.version}};
    for (const RendererPin& pin : renderer_pins())
      examination.report["renderer"]["pinned"][pin.name] = pin.value == nullptr ? Json() : Json(pin.value);
    examination.report["renderer"]["overruled"] = overruled_variables();
  } catch (const Error& error) {
    examination.missing.insert(examination.missing.end(), error.problems().begin(), error.problems().end());
  }
}

void examine_encoders(Examination& examination) {
  const std::vector<std::string> encoders = available_encoders();
  examination.report["encoders"] = encoders;
  examination.report["builds"] = encoder_builds();
  if (std::find(encoders.begin(), encoders.end(), "libx264") == encoders.end())
    examination.missing.push_back(
        {"no H.264 encoder: install Debian's package libx264-164", {}});
}

// The width of vectors stands in the renderer's name.
void print_renderer(const Json& renderer) {
  std::printf("renderer  %s, %s, OpenGL %s\n", renderer["backend"].get<std::string>().c_str(),
              renderer["renderer"].get<std::string>().c_str(), renderer["version"].get<std::string>().c_str());
  for (const auto& [name, value] : renderer["pinned"].items())
    std::printf("pinned    %s\n", value.is_null() ? ((name.ends_with('*') ? "no other " + name : name + " not set")).c_str() : (name + "=" + value.get<std::string>()).c_str());
  for (const Json& setting : renderer["overruled"])
    std::printf("overruled %s of the environment: pictures would have other bytes\n", setting.get<std::string>().c_str());
}

void run_doctor(const CommonOptions& options) {
  Examination examination;
  examination.report = {{"renderer", nullptr}, {"fonts", Json::object()}};
  examine_fonts(examination);
  examine_encoders(examination);
  for (const LibraryLine& line : library_versions()) examination.report["versions"][line.name] = line.version;
  const Json& report = examination.report;
  if (options.json) {
    print_json(report);
  } else {
    if (!report["renderer"].is_null()) print_renderer(report["renderer"]);
    for (const auto& [name, font] : report["fonts"].items())
      std::printf("font      %-10s %s\n", name.c_str(), font["file"].get<std::string>().c_str());
    for (const Json& encoder : report["encoders"])
      std::printf("encoder   %s\n", encoder.get<std::string>().c_str());
    for (const Json& build : report["builds"])
      std::printf("build     %s\n", build.get<std::string>().c_str());
    for (const auto& [name, version] : report["versions"].items())
      std::printf("version   %-14s %s\n", name.c_str(), version.get<std::string>().c_str());
  }
  if (!examination.missing.empty()) throw Error(ExitCode::no_renderer, examination.missing);
  if (!options.json && !options.quiet) std::puts("good: films can be made here");
}

}  // namespace

void add_doctor_command(CommandLine& app) {
  auto options = std::make_shared<CommonOptions>();
  Command* command =
      app.add_subcommand("doctor", "the renderer, encoders, fonts and versions of this machine");
  add_json_option(*command, *options);
  add_quiet_option(*command, *options);
  command->footer("Example: chainreel doctor --json");
  command->callback([options] { run_doctor(*options); });
}

}  // namespace chainreel
