// PNG: 8-bit RGBA, or RGB where every pixel is opaque; text chunks for what the picture should
// remember (tEXt, or iTXt in UTF-8 where a text is not ASCII). Nothing in the file depends on the time of
// writing.
#pragma once

#include <map>
#include <string>
#include <string_view>

#include "core/image.hpp"
#include "encode/frame_sink.hpp"

namespace chainreel {

// `per_metre`: pixels, for printing; 0: not said. Throws Error (exit 6) where the file cannot be written whole.
void write_png(const std::string& path, const Image& image,
               const std::map<std::string, std::string>& text = {}, double per_metre = 0);

// The same in memory, without texts.
std::string png_bytes(const Image& image);
// The bytes of a PNG with these ASCII texts more.
std::string with_png_text(std::string png, const std::map<std::string, std::string>& text);

// Channels of 16 bits become those of 8. Throws Error (exit 3), of what is too large (exit 7).
Image read_png(const std::string& path);

// The same of a file's bytes; errors name the path.
Image decode_png(std::string_view bytes, const std::string& path);

// Under this keyword write_png tells which pixels it wrote, as pixels_checksum has them.
inline constexpr const char* kPixels = "chainreel pixels";
// Of a picture as it is read, whatever its file's compression: CRC-32, eight hexadecimal digits.
std::string pixels_checksum(const Image& image);

// The texts that stand before the pixels, keyword to value. Throws Error (exit 3).
std::map<std::string, std::string> read_png_text(const std::string& path);

// Frames as PNG files name000000.png, name000001.png, ..; opacity is straight.

class PngSequence final : public FrameSink {
 public:
  // Files are `stem` and six digits in `folder`, which is there; those of the frames from `first` on. Tags go into frame 0.
  PngSequence(std::string folder, std::string stem, Tags tags, int first = 0);
  using FrameSink::write;
  void write(const Image& frame, const std::vector<PixelBox>& changed) override;
  void finish() override {}

  static std::string file_name(const std::string& stem, int frame);

 private:
  std::string folder_, stem_;
  Tags tags_;
  int next_;
};

}  // namespace chainreel
