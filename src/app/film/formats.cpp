#include "app/film/formats.hpp"

#include <array>
#include <filesystem>

#include "core/format.hpp"
#include "encode/film_start.hpp"
#include "encode/gif_writer.hpp"
#include "encode/png.hpp"
#include "encode/small_frames.hpp"
#include "render/vector_shapes.hpp"

namespace chainreel {
namespace {

template <class Writer>
std::unique_ptr<FrameSink> small_clip(const std::string& path, const VideoSettings& s) {
  return std::make_unique<Writer>(path, SmallClipSettings{s.width, s.height, s.fps, s.alpha, s.tags});
}

void write_png_still(const OutputFile& file, const StillView& view, const ClipMemory& memory) {
  const Image image = view.image();
  write_png(file.temporary_path(), image, memory.tags(), memory.width_mm > 0 ? 1000 * image.width / memory.width_mm : 0);
}

// By it a picture knows whether it was edited.
const std::string kSvgHash = "<!-- sha256 of what stands above: ", kSvgEnd = "</svg>\n";

void write_svg_still(const OutputFile& file, const StillView& view, const ClipMemory& memory) {
  VectorPage page = memory.page();
  page.height_px = view.height;
  std::string text = svg_text(view.picture(), view.fonts, page);
  text.erase(text.size() - kSvgEnd.size());
  write_temporary(file, text + kSvgHash + sha256_of(text) + " -->\n" + kSvgEnd);
}

}  // namespace

bool is_other_svg(const std::string& text) {
  const std::size_t at = text.rfind(kSvgHash);
  if (at == std::string::npos) return false;
  const std::string head = text.substr(0, at);
  return text.substr(at) != kSvgHash + sha256_of(head) + " -->\n" + kSvgEnd;
}

namespace {

void write_pdf_still(const OutputFile& file, const StillView& view, const ClipMemory& memory) {
  write_temporary(file, pdf_text(view.picture(), view.fonts, memory.page()));
}

// A sequence stands before single pictures, whose ending it has, too.
constexpr std::array<OutputFormat, 11> kFormats = {{
    {.ending = ".mp4",
     .told = "H.264, for slides and browsers; `video.crf` 0 to 51",
     .keeps_opacity = false,
     .codec = VideoCodec::h264,
     .browser_type = "video/mp4",
     .read_tags = read_film_tags},
    {.ending = ".webm",
     .told = "VP9, for pages; with opacity under preset overlay",
     .codec = VideoCodec::vp9,
     .browser_type = "video/webm",
     .read_tags = read_film_tags},
    {.ending = ".mov",
     .told = "ProRes 4444, for compositing; with opacity under preset overlay",
     .codec = VideoCodec::prores, .read_tags = read_film_tags},
    {.ending = ".gif",
     .told = "at most 25 frames/s and 800 pixels wide; one palette, no dither",
     .keeps_opacity = false,
     .browser_type = "image/gif",
     .make_clip = small_clip<GifWriter>,
     .read_tags = read_gif_comment},
    {.ending = ".apng",
     .told = "at most 25 frames/s and 800 pixels wide, every colour",
     .browser_type = "image/apng",
     .make_clip = small_clip<ApngWriter>, .read_tags = read_png_text},
    {.ending = "000000.png",
     .told = "a folder of every frame as a PNG, and NAME.tex for LaTeX's animate",
     .is_sequence = true, .read_tags = read_png_text},
    {.ending = ".png",
     .told = "the first frame, or that at `--at`",
     .shows = Shows::still, .browser_type = "image/png", .write_still = write_png_still, .read_tags = read_png_text},
    {.ending = ".svg",
     .told = "that frame as a drawing; text stays text",
     .shows = Shows::still, .has_pixels = false, .browser_type = "image/svg+xml", .write_still = write_svg_still, .read_tags = read_svg_words},
    {.ending = ".pdf",
     .told = "that frame as a page; text stays text",
     .shows = Shows::still, .has_pixels = false, .write_still = write_pdf_still, .read_tags = read_pdf_words},
    {.ending = ".csv",
     .told = "the motion as a table, a row a frame: t, q, qd, tau, energies, end effector, with units",
     .shows = Shows::table},
    {.ending = ".npz",
     .told = "the same as arrays for NumPy",
     .shows = Shows::table},
}};

}  // namespace

std::span<const OutputFormat> output_formats() {
  return kFormats;
}

const OutputFormat* find_output_format(const std::string& path, std::optional<Shows> shows) {
  const std::string ending = lower_case_ending(path), name = std::filesystem::path(path).stem().string() + ending;
  for (const OutputFormat& row : kFormats)
    if (shows.value_or(row.shows) == row.shows &&
        (row.is_sequence ? name.ends_with(row.ending) : ending == row.ending))
      return &row;
  return nullptr;
}

std::string endings_of(const std::function<bool(const OutputFormat&)>& is_wanted,
                       const std::string& last_word) {
  std::vector<std::string> endings;
  for (const OutputFormat& row : kFormats)
    if (!row.is_sequence && is_wanted(row)) endings.push_back(row.ending);
  const std::string last = endings.back();
  endings.pop_back();
  return joined(endings) + (endings.empty() ? "" : " " + last_word + " ") + last;
}

}  // namespace chainreel
