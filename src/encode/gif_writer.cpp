#include "encode/gif_writer.hpp"

#include <zlib.h>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <optional>
#include <vector>

#include "core/error.hpp"
#include "core/input_file.hpp"
#include "core/json.hpp"
#include "encode/codecs.hpp"
#include "encode/muxer.hpp"
#include "encode/palette.hpp"
#include "encode/small_frames.hpp"

namespace chainreel {
namespace {

std::vector<Bytef> packed(const Image& image) {
  uLongf size = compressBound(uLong(image.bgra.size()));
  std::vector<Bytef> bytes(size);
  if (compress2(bytes.data(), &size, image.bgra.data(), uLong(image.bgra.size()), Z_BEST_SPEED) != Z_OK)
    throw Error(ExitCode::limit, "no memory left for the frames of a GIF");
  bytes.resize(size);
  bytes.shrink_to_fit();
  return bytes;
}

void unpack(const std::vector<Bytef>& bytes, Image& image) {
  uLongf size = uLong(image.bgra.size());
  if (uncompress(image.bgra.data(), &size, bytes.data(), uLong(bytes.size())) != Z_OK)
    throw Error(ExitCode::limit, "the frames of a GIF are lost");
}

}  // namespace

struct GifWriter::State {
  std::string path;
  Tags tags;
  SmallFrames small;
  Muxer muxer;
  PaletteMaker colors;
  std::vector<std::vector<Bytef>> frames;

  State(const std::string& p, const SmallClipSettings& s)
      : path(p),
        tags(s.tags),
        small(s.width, s.height, s.fps),
        muxer(path, kGif,
              open_small_encoder("gif", AV_PIX_FMT_PAL8, small.width(), small.height(),
                                 {small.fps().den, small.fps().num}),
              {}) {}
};

GifWriter::GifWriter(const std::string& path, const SmallClipSettings& settings) {
  capture_libav_log();
  state_ = std::make_unique<State>(path, settings);
}

GifWriter::~GifWriter() = default;

void GifWriter::write(const Image& frame, const std::vector<PixelBox>&) {
  State& s = *state_;
  const bool is_shown = s.small.takes_next();
  s.small.count();
  if (!is_shown) return;
  const Image& image = s.small.shrink(frame);
  s.colors.count(image);
  s.frames.push_back(packed(image));
}

bool GifWriter::takes_next() const {
  return state_->small.takes_next();
}

void GifWriter::skip() {
  state_->small.count();
}

void GifWriter::finish() {
  State& s = *state_;
  PaletteMap map(s.colors.choose());
  const FramePtr frame = allocate_frame(s.muxer.encoder());
  Image image(s.small.width(), s.small.height());
  for (const std::vector<Bytef>& bytes : s.frames) {
    unpack(bytes, image);
    check_libav(libav().av_frame_make_writable(frame.get()), ExitCode::limit, "no memory left for a frame");
    // Entries that are left over are transparent: the encoder takes one for "as before".
    std::memset(frame->data[1], 0, AVPALETTE_SIZE);
    for (std::size_t i = 0; i < map.palette().size(); ++i) {
      const Pixel& p = map.palette()[i];
      const std::uint32_t argb = 0xFFu << 24 | unsigned(p.r) << 16 | unsigned(p.g) << 8 | p.b;
      std::memcpy(frame->data[1] + 4 * i, &argb, 4);
    }
    map.map(image, frame->data[0], frame->linesize[0]);
    s.muxer.encode(*frame);
  }
  s.muxer.finish();
  put_gif_comment(s.path, s.tags);
}

namespace {

constexpr char kExtension = 0x21, kComment = char(0xFE), kImage = 0x2C, kTrailer = 0x3B;
constexpr std::size_t kBlock = 255;                 // bytes of a data sub-block, at most
constexpr std::size_t kHead = 13, kImageHead = 10;  // with the logical screen; from the separator on

// The bytes of a table whose presence and size the packed byte of its head tells.
std::size_t color_table(char packed) {
  const auto bits = std::uint8_t(packed);
  return bits & 0x80 ? std::size_t(3) << ((bits & 7) + 1) : 0;
}

// The data from `at` on, which then stands behind the empty sub-block that ends them.
std::string sub_blocks(const std::string& gif, std::size_t& at) {
  std::string data;
  while (at < gif.size()) {
    const std::size_t count = std::uint8_t(gif[at++]);
    if (count == 0) break;
    data += gif.substr(std::min(at, gif.size()), count);
    at += count;
  }
  return data;
}

Tags tags_of(const std::string& text) {
  Tags tags;
  const Json json = parse_json(text);
  if (!json.is_object()) return tags;
  for (const auto& [keyword, value] : json.items())
    if (value.is_string()) tags[keyword] = value.get<std::string>();
  return tags;
}

}  // namespace

void put_gif_comment(const std::string& path, const Tags& tags) {
  if (tags.empty()) return;
  Json json = Json::object();
  for (const auto& [keyword, text] : tags) json[keyword] = text;
  const std::string text = json.dump(-1, ' ', true);
  std::string block{kExtension, kComment};
  for (std::size_t at = 0; at < text.size(); at += kBlock) {
    const std::string part = text.substr(at, kBlock);
    block += char(part.size()) + part;
  }
  block += '\0';
  std::string gif = read_plain_file(path);
  if (gif.size() <= kHead || gif.back() != kTrailer)
    throw Error(ExitCode::file, "could not be read again to put its comment in", {path});
  gif.insert(gif.size() - 1, block);
  std::ofstream out(path, std::ios::binary);
  out.write(gif.data(), std::streamsize(gif.size()));
  out.close();
  if (!out) throw Error(ExitCode::file, "could not be written whole: is the disk full?", {path});
}

Tags read_gif_comment(const std::string& path) {
  const std::string gif = read_plain_file(path);
  if (gif.size() < kHead || !gif.starts_with("GIF8")) throw Error(ExitCode::bad_input, "is no GIF", {path});
  std::size_t at = kHead + color_table(gif[10]);
  while (at + 1 < gif.size()) {
    const char kind = gif[at], label = gif[at + 1];
    if (kind == kExtension) {
      at += 2;
      const std::string data = sub_blocks(gif, at);
      if (label != kComment) continue;
      if (Tags tags = tags_of(data); !tags.empty()) return tags;
    } else if (kind == kImage && at + kImageHead < gif.size()) {
      at += kImageHead + color_table(gif[at + kImageHead - 1]) + 1;  // and the least size of its codes
      sub_blocks(gif, at);
    } else {
      break;
    }
  }
  return {};
}

}  // namespace chainreel
