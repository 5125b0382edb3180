// FFmpeg's writer of APNG knows no texts: they are put in behind the head once the file is whole, as iTXt
// chunks (PNG specification, 5.3 and 11.3.4.5). Compressed, as FFmpeg's players find out what a file is from its first 2048 bytes:
// where these end before the picture, they take it for a still.
#include <zlib.h>

#include <fstream>
#include <iterator>
#include <new>

#include "encode/codecs.hpp"
#include "encode/muxer.hpp"
#include "encode/small_frames.hpp"

namespace chainreel {
namespace {

constexpr std::size_t kImageStart = 8 + 25;  // the signature and IHDR

std::string big_endian(std::uint32_t value) {
  return {char(value >> 24), char(value >> 16), char(value >> 8), char(value)};
}

std::string text_chunk(const std::string& keyword, const std::string& text) {
  uLongf size = compressBound(uLong(text.size()));
  std::string packed(size, '\0');
  const int code = compress2(reinterpret_cast<Bytef*>(packed.data()), &size, reinterpret_cast<const Bytef*>(text.data()), uLong(text.size()), Z_BEST_COMPRESSION);
  if (code != Z_OK) throw std::bad_alloc();
  packed.resize(size);
  // Compressed by method 0, no language, no translated keyword.
  const std::string body = "iTXt" + keyword + std::string("\0\1\0\0\0", 5) + packed;
  const auto crc = std::uint32_t(crc32(0, reinterpret_cast<const Bytef*>(body.data()), uInt(body.size())));
  return big_endian(std::uint32_t(body.size() - 4)) + body + big_endian(crc);
}

void put_texts(const std::string& path, const Tags& tags) {
  if (tags.empty()) return;
  std::string chunks;
  for (const auto& [keyword, text] : tags) chunks += text_chunk(keyword, text);
  std::ifstream stream(path, std::ios::binary);
  std::string bytes{std::istreambuf_iterator<char>(stream), {}};
  if (!stream || bytes.size() < kImageStart || bytes.compare(12, 4, "IHDR") != 0)
    throw Error(ExitCode::file, "could not be read again to put its texts in", {path});
  bytes.insert(kImageStart, chunks);
  std::ofstream out(path, std::ios::binary);
  out.write(bytes.data(), std::streamsize(bytes.size()));
  out.close();
  if (!out) throw Error(ExitCode::file, "could not be written whole: is the disk full?", {path});
}

}  // namespace

struct ApngWriter::State {
  std::string path;
  SmallClipSettings settings;
  SmallFrames small;
  Muxer muxer;
  FramePtr frame;

  State(const std::string& p, const SmallClipSettings& s)
      : path(p),
        settings(s),
        small(s.width, s.height, s.fps),
        muxer(path, kApng,
              open_small_encoder("apng", s.alpha ? AV_PIX_FMT_RGBA : AV_PIX_FMT_RGB24, small.width(),
                                 small.height(), {small.fps().den, small.fps().num}),
              {}),
        frame(allocate_frame(muxer.encoder())) {}
};

ApngWriter::ApngWriter(const std::string& path, const SmallClipSettings& settings) {
  capture_libav_log();
  state_ = std::make_unique<State>(path, settings);
}

ApngWriter::~ApngWriter() = default;

void ApngWriter::write(const Image& full, const std::vector<PixelBox>&) {
  State& s = *state_;
  const bool is_shown = s.small.takes_next();
  s.small.count();
  if (!is_shown) return;
  const Image& image = s.small.shrink(full);
  check_libav(libav().av_frame_make_writable(s.frame.get()), ExitCode::limit, "no memory left for a frame");
  const int channels = s.settings.alpha ? 4 : 3;
  for (int y = 0; y < image.height; ++y) {
    const std::uint8_t* from = &image.bgra[std::size_t(4) * std::size_t(image.width) * std::size_t(y)];
    std::uint8_t* to = s.frame->data[0] + std::ptrdiff_t(s.frame->linesize[0]) * y;
    for (int x = 0; x < image.width; ++x, from += 4, to += channels) {
      to[0] = from[2];
      to[1] = from[1];
      to[2] = from[0];
      if (channels == 4) to[3] = from[3];
    }
  }
  s.muxer.encode(*s.frame);
}

bool ApngWriter::takes_next() const {
  return state_->small.takes_next();
}

void ApngWriter::skip() {
  state_->small.count();
}

void ApngWriter::finish() {
  state_->muxer.finish();
  put_texts(state_->path, state_->settings.tags);
}

}  // namespace chainreel
