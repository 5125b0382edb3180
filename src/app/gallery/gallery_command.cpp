// chainreel gallery [FOLDER|FILM...] -o PAGE.html

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <memory>

#include "app/cli/command.hpp"
#include "app/cli/result.hpp"
#include "app/cli/streams.hpp"
#include "app/gallery/gallery_page.hpp"
#include "core/error.hpp"
#include "core/format.hpp"
#include "core/output_file.hpp"

namespace chainreel {
namespace {

struct GalleryOptions {
  std::vector<std::string> paths{"out"};
  std::string output = "out/index.html";
  std::string title = "Films of robot chains";
  CommonOptions common;
};

void tell_of_long_films(const std::vector<GalleryClip>& clips) {
  for (const GalleryClip& clip : clips) {
    const double bytes = double(std::filesystem::file_size(clip.path));
    if (bytes <= double(kLongClip)) continue;
    std::fprintf(stderr,
                 "%s: has %.0f MB; some browsers do not play so long a film out of a page: render it with a "
                 "smaller video.width or a higher video.crf\n",
                 clip.path.c_str(), bytes / 1e6);
  }
}

void run_gallery(const GalleryOptions& options) {
  if (!options.output.ends_with(".html"))
    throw Error(ExitCode::usage, "-o " + options.output + ": a gallery is written as .html");
  const FoundClips found = find_clips(options.paths);
  const std::vector<GalleryClip> clips = read_clips(found.paths);
  const std::vector<GalleryPicture> pictures = read_pictures(found.pictures);
  OutputFile output(options.output, options.common.force);
  std::ofstream stream(output.temporary_path(), std::ios::binary);
  write_gallery(stream, clips, pictures, options.title);
  stream.close();
  if (!stream) throw Error(ExitCode::file, "could not be written whole: is the disk full?", {output.path()});
  throw_if_interrupted();
  output.commit();
  if (!options.common.quiet) tell_of_long_films(clips);
  if (!options.common.quiet && !found.left_out.empty())
    std::fprintf(stderr, "note: left out: %s; browsers play %s and show %s: give such a -o beside, as in -o a.mov -o a.mp4\n",
                 joined(found.left_out).c_str(), played_endings("and").c_str(), shown_endings("and").c_str());
  if (!options.common.quiet && !found.shown_once.empty())
    std::fprintf(stderr, "note: shown once, as the film of the same name: %s; name one on the command line to show it, too\n", joined(found.shown_once).c_str());
  tell_files(options.common, {options.output}, [&] { return Json{{"clips", clips.size()}, {"pictures", pictures.size()}}; });
}

}  // namespace

void add_gallery_command(CommandLine& app) {
  auto options = std::make_shared<GalleryOptions>();
  Command* command = app.add_subcommand(
      "gallery", "one page for browsers with films, their audits, charts and scenes, and pictures below them, without a server");
  command->add_option("paths", options->paths, "folders with films and pictures, or films: " + played_endings("or") + ", or pictures: " + shown_endings("or") + " (default out)");
  command->add_option("-o,--output", options->output, "a .html file (default out/index.html)");
  command->add_option("--title", options->title, "of the page");
  add_result_options(*command, options->common);
  command->footer("Example: chainreel gallery out -o out/index.html");
  command->callback([options] { run_gallery(*options); });
}

}  // namespace chainreel
