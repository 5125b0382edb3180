// The kinds of files that a motion becomes, a row each: what it shows and keeps, how it is made and what it
// remembers. To add one: its row, its writer in encode or render, and for a film its codec's settings.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>

#include "app/film/clip_memory.hpp"
#include "core/image.hpp"
#include "core/output_file.hpp"
#include "encode/frame_sink.hpp"
#include "encode/video_writer.hpp"
#include "picture/picture.hpp"
#include "picture/text.hpp"

namespace chainreel {

// One instant, drawn or rasterised when a format asks for it.
struct StillView {
  std::function<Picture()> picture;
  std::function<Image()> image;
  int height;  // px
  const Fonts& fonts;
};

enum class Shows { motion, still, table };

struct OutputFormat {
  const char* ending;  // ".mp4"; of a sequence, how the name of its first picture ends
  const char* told;    // half a sentence for people
  Shows shows = Shows::motion;
  bool is_sequence = false;           // a folder of pictures
  bool has_pixels = true;             // of what is shown
  bool keeps_opacity = true;          // of a transparent page
  std::optional<VideoCodec> codec{};  // of films, whose size and quality it limits
  const char* browser_type = "";      // "video/mp4", "image/png" where browsers play or show it

  // Of small clips: what takes the frames of a motion, in their order. Size, rate, opacity and tags are the settings'. Films
  // are made of chunks, see encode/film_chunk; sequences are pictures one by one.
  std::unique_ptr<FrameSink> (*make_clip)(const std::string& path, const VideoSettings& settings) = nullptr;
  // Writes a still.
  void (*write_still)(const OutputFile& file, const StillView& view, const ClipMemory& memory) = nullptr;
  // What the file says of itself. Throws Error (exit 3) where it says nothing.
  Tags (*read_tags)(const std::string& path) = nullptr;
};

std::span<const OutputFormat> output_formats();

// Whether an SVG was edited since the program wrote it; not, where it does not tell.
bool is_other_svg(const std::string& text);

// By the path's ending, among those that show this or among all; null where no row has it.
const OutputFormat* find_output_format(const std::string& path, std::optional<Shows> shows = {});

// ".png, .svg or .pdf": the endings of those rows that are wanted, sequences left out.
std::string endings_of(const std::function<bool(const OutputFormat&)>& is_wanted,
                       const std::string& last_word);

}  // namespace chainreel
