// chainreel compare A B

#include <algorithm>
#include <cctype>
#include <cstdio>
#include <filesystem>
#include <memory>

#include "app/cli/result.hpp"
#include "app/compare/comparison.hpp"
#include "core/error.hpp"
#include "core/format.hpp"

namespace chainreel {
namespace {

namespace fs = std::filesystem;

// What can be compared, a row a kind. `is_one` looks at no more than a name and what kind of file it is.
struct ComparedKind {
  const char* told;
  bool (*is_one)(const std::string& path);
  Comparison (*compare)(const CompareOptions& options);
  bool has_picture = false;  // of the difference, for -o, --pixels and --count-edges
  bool has_strip = false;
  bool is_model = false;  // takes --set, --package and --base
  bool has_tolerance = true;
};

bool is_folder(const std::string& path) {
  std::error_code ignored;
  return fs::is_directory(path, ignored);
}

constexpr ComparedKind kKinds[] = {
    {.told = "folders of .png files", .is_one = is_folder, .compare = compare_folders, .has_picture = true},
    {.told = "pictures (.png)",
     .is_one = [](const std::string& path) { return ends_in(path, {".png"}); },
     .compare = compare_picture_files,
     .has_picture = true},
    {.told = "films (.mp4, .mov, .webm, .gif, .apng)",
     .is_one =
         [](const std::string& path) {
           return ends_in(path, {".mp4", ".mov", ".webm", ".gif", ".apng"});
         },
     .compare = compare_films,
     .has_picture = true,
     .has_strip = true},
    {.told = "models (.urdf, .xml)", .is_one = is_model_file, .compare = compare_models, .is_model = true, .has_tolerance = false},
    {.told = "trajectories (.csv)",
     .is_one = [](const std::string& path) { return ends_in(path, {".csv"}); },
     .compare = compare_trajectories},
};

const ComparedKind& kind_of(const std::string& path) {
  for (const ComparedKind& kind : kKinds)
    if (kind.is_one(path)) return kind;
  std::vector<std::string> kinds;
  for (const ComparedKind& kind : kKinds) kinds.push_back(kind.told);
  throw Error(ExitCode::usage, "cannot be compared: two of a kind are, " + joined(kinds, "; "), {path});
}

// What the command was asked for that things of this kind do not have.
void refuse_what_is_not_there(const ComparedKind& kind, const CompareOptions& options) {
  const auto refuse = [&](const std::string& option) {
    throw Error(ExitCode::usage, option + " says nothing of " + kind.told);
  };
  if (!kind.has_strip && !options.strip.empty()) refuse("--strip");
  if (!kind.has_picture && !options.output.empty()) refuse("-o");
  if (!kind.has_picture && options.side_by_side) refuse("--side-by-side");
  if (!kind.has_picture && options.tolerance.pixels > 0) refuse("--pixels");
  if (!kind.has_picture && options.count_edges) refuse("--count-edges");
  if (!kind.has_tolerance && options.has_wish()) refuse("--tolerance");
  if (options.side_by_side && options.output.empty())
    throw Error(ExitCode::usage, "--side-by-side is about the picture that -o names");
  for (const std::string& path : {kind.compare == compare_folders ? "" : options.output, options.strip})
    if (!path.empty() && !ends_in(path, {".png"}))
      throw Error(ExitCode::usage, path + ": differences are shown as .png files");
  if (!options.strip.empty() && options.strip == options.output)
    throw Error(ExitCode::usage, "-o and --strip name the same file, " + options.strip);
}

void run_compare(CompareOptions options) {
  if (options.has_wish() && !(options.wished >= 0 && options.wished <= 1))
    throw Error(ExitCode::usage, "--tolerance is an error from 0 to 1");
  if (options.has_wish()) options.tolerance.error = options.wished;
  options.tolerance.forgive_edges = !options.count_edges;
  const ComparedKind& kind = kind_of(options.before);
  if (&kind != &kind_of(options.after))
    throw Error(ExitCode::usage, options.before + " and " + options.after +
                                     " are not of one kind: one is of " + kind.told + ", the other of " +
                                     kind_of(options.after).told);
  if (!overrides_of(options.common).empty() && !kind.is_model)
    throw Error(ExitCode::usage,
                std::string("--set, --package and --base say how models are read, nothing of ") + kind.told);
  refuse_what_is_not_there(kind, options);
  const Comparison found = kind.compare(options);
  const auto report_of_all = [&] {
    Json report = found.report;
    report.update({{"before", options.before},
                   {"after", options.after},
                   {"equal", found.equal},
                   {"passes", found.passes}});
    if (!report.contains("tolerance")) report["tolerance"] = nullptr;
    if (kind.has_picture)
      report["tolerance"] = {{"error", options.tolerance.error},
                             {"pixels", options.tolerance.pixels},
                             {"edges_forgiven", options.tolerance.forgive_edges}};
    return report;
  };
  tell_result(options.common, report_of_all, [&] {
    for (const std::string& line : found.words) std::printf("%s\n", line.c_str());
  });
  if (!found.passes)
    throw Error(ExitCode::comparison_failed, options.before + " and " + options.after + " differ");
}

}  // namespace

void add_compare_command(CommandLine& app) {
  auto options = std::make_shared<CompareOptions>();
  Command* command = app.add_subcommand(
      "compare", "whether two pictures, folders of them, films, models or trajectories differ, and in what");
  command
      ->add_option("before", options->before,
                   "a .png, a folder of them, a film (.mp4, .mov, .webm, .gif, .apng), a .urdf, or a .csv of "
                   "`simulate`")
      .required();
  command->add_option("after", options->after, "another of the same kind").required();
  command->add_option(
      "-o,--output", options->output,
      "a .png that shows the difference, of films that of the worst frame; of folders a folder "
      "for the pairs that are unequal");
  command->add_flag("--side-by-side", options->side_by_side,
                    "in that picture: before, after and the difference");
  command->add_option("--strip", options->strip, "of films: a .png of the mean error over time, a bar a frame, dark where it is beyond the tolerance");
  command->add_option("--tolerance", options->wished,
                      "of pictures the perceptual error (FLIP, 0 to 1) beyond which a pixel counts as different (default 0.1); of tables the "
                      "share of a column's range by which its numbers may differ (default 1e-9)");
  command->add_option("--pixels", options->tolerance.pixels, "so many pixels of a picture may be different")
      .range(0, 1 << 30)
      .show_default();
  command->add_flag("--count-edges", options->count_edges,
                    "pixels that anti-aliasing may explain count, too");
  add_scene_options(*command, options->common);
  add_result_options(*command, options->common);
  command->footer(
      "Exit code 1 where they differ beyond the tolerance. Of pictures and films pixels alone are judged, what they remember of\n"
      "their scenes and models is told: a mass that no pixel shows is a difference for `verify` and of two .urdf files.\n"
      "Example: chainreel compare out/before.png out/after.png -o out/difference.png\n"
      "of what  chainreel snapshot rr_free -o out/before.png  and  chainreel snapshot rr_free --at 0.1 -o out/after.png  write");
  command->callback([options] { run_compare(*options); });
}

}  // namespace chainreel
