#include "encode/video_writer.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <string>
#include <utility>

#include "core/format.hpp"
#include "encode/libav.hpp"
#include "encode/yuv420.hpp"

namespace chainreel {
namespace {

// x264 writes its thread count into the stream and cuts motion vectors by it, so it is a constant and not the
// machine's number of cores. Four: per frame of 1920x1080 on two cores, 1 thread took 18 ms, 2 took 13, 3
// took 10, 4 took 9, 6 took 13 or more; the files are of one size, and on a single core 4 cost no more
// than 1.
constexpr int kEncoderThreads = 4;
constexpr double kGopSeconds = 2;
constexpr int kLargestSide = 16384;  // x264's own limit

struct CloseFormat {
  void operator()(AVFormatContext* format) const {
    if (format->pb != nullptr) avio_closep(&format->pb);
    avformat_free_context(format);
  }
};
using FormatPtr = std::unique_ptr<AVFormatContext, CloseFormat>;

std::string size_text(int width, int height) {
  return std::to_string(width) + "x" + std::to_string(height);
}

void require_settings(const VideoSettings& settings) {
  require_even_sides(settings.width, settings.height);
  if (settings.fps.num <= 0 || settings.fps.den <= 0)
    throw Error(ExitCode::usage, "a film needs a positive frame rate, not " +
                                     std::to_string(settings.fps.num) + "/" +
                                     std::to_string(settings.fps.den));
  if (!(settings.crf >= 0 && settings.crf <= 51))
    throw Error(ExitCode::usage,
                "the quality (crf) must be from 0 to 51, not " + format_shortest(settings.crf));
}

CodecContextPtr open_encoder(const VideoSettings& settings) {
  const AVCodec* codec = avcodec_find_encoder_by_name("libx264");
  if (codec == nullptr)
    throw Error(ExitCode::no_renderer,
                "FFmpeg's libavcodec has no encoder libx264: install Debian's libavcodec59");
  CodecContextPtr context(check_allocated(avcodec_alloc_context3(codec), "the encoder"));

  context->width = settings.width;
  context->height = settings.height;
  context->sample_aspect_ratio = {1, 1};
  context->pix_fmt = AV_PIX_FMT_YUV420P;
  context->color_primaries = AVCOL_PRI_BT709;
  context->color_trc = AVCOL_TRC_BT709;
  context->colorspace = AVCOL_SPC_BT709;
  context->color_range = AVCOL_RANGE_MPEG;
  context->chroma_sample_location = AVCHROMA_LOC_CENTER;  // as yuv420.hpp computes it

  // One tick is one frame: frame k is shown from k * den / num on, exactly.
  context->time_base = {settings.fps.den, settings.fps.num};
  context->framerate = {settings.fps.num, settings.fps.den};

  // Closed GOPs of two seconds: a player seeks to any of them, and parts can be encoded apart and joined.
  const int gop =
      std::max(1, static_cast<int>(std::lround(kGopSeconds * settings.fps.num / settings.fps.den)));
  context->gop_size = gop;
  context->keyint_min = gop;
  context->thread_count = kEncoderThreads;
  context->flags |= AV_CODEC_FLAG_CLOSED_GOP | AV_CODEC_FLAG_BITEXACT | AV_CODEC_FLAG_GLOBAL_HEADER;

  AVDictionary* options = nullptr;
  av_dict_set(&options, "preset", "veryfast", 0);
  av_dict_set(&options, "profile", "high", 0);
  av_dict_set(&options, "crf", format_shortest(settings.crf).c_str(), 0);
  // cpu-independent: the same bytes whichever instruction set x264 finds.
  av_dict_set(&options, "x264-params", "scenecut=0:open-gop=0:force-cfr=1:cpu-independent=1", 0);
  const int code = avcodec_open2(context.get(), codec, &options);
  av_dict_free(&options);
  check_libav(code, ExitCode::no_renderer,
              "x264 refuses a film of " + size_text(settings.width, settings.height) + " at " +
                  std::to_string(settings.fps.num) + "/" + std::to_string(settings.fps.den) + " frames/s");
  return context;
}

FramePtr allocate_frame(const AVCodecContext& encoder) {
  FramePtr frame(check_allocated(av_frame_alloc(), "a frame"));
  frame->format = encoder.pix_fmt;
  frame->width = encoder.width;
  frame->height = encoder.height;
  frame->color_primaries = encoder.color_primaries;
  frame->color_trc = encoder.color_trc;
  frame->colorspace = encoder.colorspace;
  frame->color_range = encoder.color_range;
  check_libav(av_frame_get_buffer(frame.get(), 0), ExitCode::limit, "no memory left for a frame");
  return frame;
}

}  // namespace

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

struct VideoWriter::State {
  std::string path;
  VideoSettings settings;
  CodecContextPtr encoder;
  FormatPtr format;
  FramePtr frame;
  PacketPtr packet;
  AVStream* stream = nullptr;
  std::int64_t frames = 0;
  bool finished = false;

  void check_file(int code) const {
    check_libav(code, ExitCode::file, "the film could not be written", path);
  }
  void open_file();
  void encode(const AVFrame* next);
};

// MP4 with its index first. Times are exact: movie and track both count in the track's ticks.
void VideoWriter::State::open_file() {
  const std::string url = "file:" + path;  // or "a:b.mp4" would be taken for a protocol
  AVFormatContext* raw = nullptr;
  check_libav(avformat_alloc_output_context2(&raw, nullptr, "mp4", url.c_str()), ExitCode::no_renderer,
              "FFmpeg's libavformat cannot write MP4");
  format.reset(raw);
  format->flags |= AVFMT_FLAG_BITEXACT;  // no creation time, no version of the library
  stream = check_allocated(avformat_new_stream(format.get(), nullptr), "the film's track");
  stream->time_base = encoder->time_base;
  stream->avg_frame_rate = encoder->framerate;
  check_libav(avcodec_parameters_from_context(stream->codecpar, encoder.get()), ExitCode::limit,
              "no memory left for the film's track");
  check_libav(avio_open(&format->pb, url.c_str(), AVIO_FLAG_WRITE), ExitCode::file,
              "the film cannot be written here; choose another place with -o", path);

  std::int64_t ticks = settings.fps.num;
  while (ticks < 10000)
    ticks *= 2;  // what players are used to; a multiple of the frame rate, so nothing is rounded
  AVDictionary* options = nullptr;
  av_dict_set(&options, "movflags", "+faststart", 0);
  av_dict_set_int(&options, "video_track_timescale", ticks, 0);
  av_dict_set_int(&options, "movie_timescale", ticks, 0);
  const int code = avformat_write_header(format.get(), &options);
  av_dict_free(&options);
  check_file(code);
}

// Gives the encoder a frame, or with nullptr the end, and writes every packet that is ready.
void VideoWriter::State::encode(const AVFrame* next) {
  check_libav(avcodec_send_frame(encoder.get(), next), ExitCode::no_renderer, "x264 failed", path);
  for (;;) {
    const int code = avcodec_receive_packet(encoder.get(), packet.get());
    if (code == AVERROR(EAGAIN) || code == AVERROR_EOF) return;
    check_libav(code, ExitCode::no_renderer, "x264 failed", path);
    packet->duration = 1;  // x264 leaves it open; without it the last frame would have no length
    packet->stream_index = stream->index;
    av_packet_rescale_ts(packet.get(), encoder->time_base, stream->time_base);
    check_file(av_write_frame(format.get(), packet.get()));
    av_packet_unref(packet.get());
  }
}

VideoWriter::VideoWriter(const std::string& path, const VideoSettings& settings)
    : state_(std::make_unique<State>()) {
  require_settings(settings);
  capture_libav_log();
  State& s = *state_;
  s.path = path;
  s.settings = settings;
  s.encoder = open_encoder(settings);
  s.frame = allocate_frame(*s.encoder);
  s.packet.reset(check_allocated(av_packet_alloc(), "a packet"));
  s.open_file();
}

// A film without its index cannot be played, so an unfinished one is taken away.
VideoWriter::~VideoWriter() {
  if (state_->finished) return;
  state_->format.reset();
  std::error_code ignored;
  if (std::filesystem::is_regular_file(state_->path, ignored)) std::filesystem::remove(state_->path, ignored);
}

void VideoWriter::write(const Image& image) {
  State& s = *state_;
  if (image.width != s.settings.width || image.height != s.settings.height)
    throw Error(ExitCode::usage, "a frame of " + size_text(image.width, image.height) +
                                     " does not fit a film of " +
                                     size_text(s.settings.width, s.settings.height));
  // The encoder may still hold the last frame: then its pixels are not ours to change.
  check_libav(av_frame_make_writable(s.frame.get()), ExitCode::limit, "no memory left for a frame");
  PlanesYuv420 planes;
  for (int i = 0; i < 3; ++i) {
    planes.plane[i] = s.frame->data[i];
    planes.stride[i] = s.frame->linesize[i];
  }
  convert_to_yuv420(image, planes);
  s.frame->pts = s.frames++;
  s.encode(s.frame.get());
}

void VideoWriter::finish() {
  State& s = *state_;
  if (s.finished) return;
  if (s.frames == 0)
    throw Error(ExitCode::bad_input, "the film has no frame: its duration is shorter than half a frame",
                {s.path});
  s.encode(nullptr);
  avio_flush(s.format->pb);
  s.check_file(s.format->pb->error);  // before the index is moved to the front of data that is not there
  s.check_file(av_write_trailer(s.format.get()));
  avio_flush(s.format->pb);
  s.check_file(s.format->pb->error);
  s.check_file(avio_closep(&s.format->pb));
  s.finished = true;
}

}  // namespace chainreel
