#include "encode/video_writer.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "core/format.hpp"
#include "encode/bleed.hpp"
#include "encode/codecs.hpp"
#include "encode/film_chunk.hpp"
#include "encode/still_blocks.hpp"
#include "encode/x264_encoder.hpp"
#include "encode/yuv.hpp"

namespace chainreel {
namespace {

constexpr int kLargestSide = 16384;  // x264's own limit

std::string size_text(int width, int height) {
  return std::to_string(width) + "x" + std::to_string(height);
}

void copy_alpha(const Image& image, const PixelBox& box, std::uint8_t* plane, int stride) {
  for (int y = box.y; y < box.bottom(); ++y) {
    const std::uint8_t* row = &image.bgra[std::size_t(4) * std::size_t(image.width) * std::size_t(y)];
    for (int x = box.x; x < box.right(); ++x) plane[std::ptrdiff_t(stride) * y + x] = row[4 * x + 3];
  }
}

}  // namespace

double crf_of(const VideoSettings& settings) {
  return std::round(settings.crf.value_or(row_of(settings.codec).crf.value_or(0)));
}

bool has_crf(VideoCodec codec) {
  return row_of(codec).worst_crf.has_value();
}

void require_even_sides(int width, int height) {
  if (width > 0 && height > 0 && width <= kLargestSide && height <= kLargestSide && width % 2 == 0 &&
      height % 2 == 0)
    return;
  const auto below = [](int side) { return std::clamp(side - side % 2, 2, kLargestSide); };
  const auto above = [](int side) { return std::clamp(side + side % 2, 2, kLargestSide); };
  const std::string smaller = size_text(below(width), below(height));
  const std::string larger = size_text(above(width), above(height));
  throw Error(ExitCode::usage,
              "a film of " + size_text(width, height) +
                  " pixels is not possible: both sides must be even and from 2 to " +
                  std::to_string(kLargestSide) + "; the nearest legal " +
                  (smaller == larger ? "size is " + smaller : "sizes are " + smaller + " and " + larger));
}

void require_settings(const VideoSettings& settings) {
  require_even_sides(settings.width, settings.height);
  if (settings.fps.num <= 0 || settings.fps.den <= 0)
    throw Error(ExitCode::usage, "a film needs a positive frame rate, not " +
                                     std::to_string(settings.fps.num) + "/" +
                                     std::to_string(settings.fps.den));
  const CodecRow& row = row_of(settings.codec);
  if (const double crf = settings.crf.value_or(0); row.worst_crf && !(crf >= 0 && crf <= *row.worst_crf))
    throw Error(ExitCode::usage, "the quality (crf) must be from 0 to " + format_shortest(*row.worst_crf) +
                                     ", not " + format_shortest(crf));
  if (settings.alpha && !row.alpha)
    throw Error(ExitCode::usage, "MP4 with H.264 has no opacity: take .mov or .webm");
}

struct ChunkTape::State {
  std::vector<FramePtr> frames;
  std::vector<StillBlocks::Flags> still;  // of H.264, of each frame
};

ChunkTape::ChunkTape() : state_(std::make_unique<State>()) {}
ChunkTape::~ChunkTape() = default;
ChunkTape::ChunkTape(ChunkTape&&) noexcept = default;
ChunkTape& ChunkTape::operator=(ChunkTape&&) noexcept = default;

int ChunkTape::frames() const {
  return int(state_->frames.size());
}

double ChunkTape::bytes_of_frame(const VideoSettings& settings) {
  const double pixels = double(settings.width) * settings.height;
  return pixels * (row_of(settings.codec).every_pixel ? 6 : 1.5) * (settings.alpha ? 1.7 : 1);
}

void encode_by_preset(const std::vector<ChunkTape>& tapes, const VideoSettings& settings, int threads) {
  const CodecContextPtr encoder = open_preset_h264(settings, threads);
  const auto send = [&](const AVFrame* frame) { encode_frame(*encoder, frame, "", [](const AVPacket&) {}); };
  std::int64_t count = 0;
  for (const ChunkTape& tape : tapes)
    for (const FramePtr& kept : tape.state_->frames) {
      const FramePtr frame(check_allocated(libav().av_frame_clone(kept.get()), "a frame"));
      frame->pts = count++;  // it was that of its chunk
      send(frame.get());
    }
  send(nullptr);
}

struct ChunkEncoder::State {
  VideoSettings settings;
  CodecContextPtr encoder;
  FramePtr frame;
  Image bled;  // the frame with colours in its transparent pixels
  FilmChunk chunk;
  ChunkTape* tape;
  StageTime conversion;
  std::unique_ptr<X264Encoder> x264;  // of H.264, in the place of the other
  StillBlocks blocks;

  State(const VideoSettings& s, ChunkTape* t)
      : settings(s), encoder(open_encoder(s)), frame(allocate_frame(*encoder)), tape(t), blocks(s.width, s.height) {
    if (s.codec == VideoCodec::h264) x264 = std::make_unique<X264Encoder>(s);
  }

  // To FFmpeg's encoder, or with nullptr the end.
  void send(const AVFrame* next) {
    encode_frame(*encoder, next, "", [this](const AVPacket& packet) { chunk.packets.push_back(kept_packet(packet)); });
  }
  void encode(const AVFrame& next, StillBlocks::Flags& still) {
    if (x264)
      chunk.packets.push_back(x264->encode(next, still));
    else
      send(&next);
  }

  bool has_frame = false;

  PlanesYuv420 planes() {
    PlanesYuv420 planes;
    for (int i = 0; i < 3; ++i) {
      planes.plane[i] = frame->data[i];
      planes.stride[i] = frame->linesize[i];
    }
    return planes;
  }

  // What `frame` shows in the box; the rest of the encoder's frame stays what it was.
  void convert(const Image& image, const PixelBox& box) {
    if (row_of(settings.codec).every_pixel) {
      PlanesYuv444 planes;
      for (int i = 0; i < (settings.alpha ? 4 : 3); ++i) {
        planes.plane[i] = reinterpret_cast<std::uint16_t*>(frame->data[i]);
        planes.stride[i] = frame->linesize[i] / 2;
      }
      convert_to_yuv444(image, box, planes);
      return;
    }
    convert_to_yuv420(image, box, planes());
    if (settings.alpha) copy_alpha(image, box, frame->data[3], frame->linesize[3]);
  }
};

ChunkEncoder::ChunkEncoder(const VideoSettings& settings, ChunkTape* tape) {
  require_settings(settings);
  capture_libav_log();
  state_ = std::make_unique<State>(settings, tape);
}

ChunkEncoder::~ChunkEncoder() = default;

void ChunkEncoder::write(const Image& image, const std::vector<PixelBox>& changed) {
  State& s = *state_;
  if (image.width != s.settings.width || image.height != s.settings.height)
    throw Error(ExitCode::usage, "a frame of " + size_text(image.width, image.height) +
                                     " does not fit a film of " +
                                     size_text(s.settings.width, s.settings.height));
  StageClock clock;
  // The encoder may still hold the last frame: then its pixels are not ours to change, and a copy takes their place.
  check_libav(libav().av_frame_make_writable(s.frame.get()), ExitCode::limit, "no memory left for a frame");
  const PixelBox whole = {0, 0, image.width, image.height};
  const bool follows = s.x264 && s.has_frame;
  if (follows) s.blocks.keep(s.planes(), changed);
  if (s.settings.alpha) {  // colours spread beyond what changed
    s.bled = image;
    bleed_colors(s.bled);
    s.convert(s.bled, whole);
  } else if (!s.has_frame) {
    s.convert(image, whole);
  } else {
    for (const PixelBox& box : changed) s.convert(image, box);
  }
  s.has_frame = true;
  s.frame->pts = s.chunk.frames++;
  StillBlocks::Flags unknown;
  StillBlocks::Flags& still = follows ? s.blocks.compare(s.planes()) : unknown;
  s.conversion += clock.lap();
  if (s.tape != nullptr) {
    s.tape->state_->frames.emplace_back(check_allocated(libav().av_frame_clone(s.frame.get()), "a frame"));
    s.tape->state_->still.push_back(still);
  } else {
    s.encode(*s.frame, still);
  }
}

void ChunkEncoder::play(const ChunkTape& tape) {
  for (std::size_t i = 0; i < tape.state_->frames.size(); ++i) state_->encode(*tape.state_->frames[i], tape.state_->still[i]);
  state_->chunk.frames += tape.frames();
}

void ChunkEncoder::finish() {
  if (!state_->x264) state_->send(nullptr);
}

StageTime ChunkEncoder::conversion() const {
  return state_->conversion;
}

FilmChunk ChunkEncoder::take() {
  return std::move(state_->chunk);
}

}  // namespace chainreel
