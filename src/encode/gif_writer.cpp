#include <zlib.h>

#include <cstring>
#include <optional>
#include <vector>

#include "encode/codecs.hpp"
#include "encode/gif_comment.hpp"
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

void GifWriter::write(const Image& frame) {
  State& s = *state_;
  if (!s.small.takes_next()) return;
  const Image& image = s.small.shrink(frame);
  s.colors.count(image);
  s.frames.push_back(packed(image));
}

void GifWriter::finish() {
  State& s = *state_;
  PaletteMap map(s.colors.choose());
  const FramePtr frame = allocate_frame(s.muxer.encoder());
  Image image(s.small.width(), s.small.height());
  for (const std::vector<Bytef>& bytes : s.frames) {
    unpack(bytes, image);
    check_libav(av_frame_make_writable(frame.get()), ExitCode::limit, "no memory left for a frame");
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

}  // namespace chainreel
