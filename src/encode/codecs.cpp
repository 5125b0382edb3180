#include "encode/codecs.hpp"

#include <algorithm>
#include <cmath>

#include "core/format.hpp"

namespace chainreel {
namespace {

// The same bytes on every machine and, as films are encoded in chunks beside one another, the least work for each: libvpx cuts
// frames by their number of threads.
constexpr int kEncoderThreads = 1;
constexpr double kGopSeconds = 2;
constexpr int kProresQuantiser = 4;  // a fixed one; the decoded picture is within 2/255 in flat areas

CodecContextPtr make_context(const char* name) {
  const AVCodec* codec = libav().avcodec_find_encoder_by_name(name);
  if (codec == nullptr)
    throw Error(ExitCode::no_renderer, std::string("FFmpeg's libavcodec has no encoder ") + name +
                                           ": install Debian's libavcodec59");
  CodecContextPtr context(check_allocated(libav().avcodec_alloc_context3(codec), "the encoder"));
  context->sample_aspect_ratio = {1, 1};
  context->flags |= AV_CODEC_FLAG_BITEXACT | AV_CODEC_FLAG_GLOBAL_HEADER;
  return context;
}

// Closed GOPs of at most two seconds: a player seeks to any of them, and chunks can be encoded apart and joined.
void set_gop(AVCodecContext& context, FrameRate fps) {
  const int gop = gop_of(fps);
  context.gop_size = gop;
  context.keyint_min = gop;
  context.flags |= AV_CODEC_FLAG_CLOSED_GOP;
}

// As other programs ask for it, which take the preset as it is: to be measured beside ours, see X264Encoder.
AVDictionary* h264_options(AVCodecContext& context, const VideoSettings& settings) {
  context.pix_fmt = AV_PIX_FMT_YUV420P;
  AVDictionary* options = nullptr;
  libav().av_dict_set(&options, "preset", "veryfast", 0);
  libav().av_dict_set(&options, "crf", format_shortest(crf_of(settings)).c_str(), 0);
  return options;
}

AVDictionary* vp9_options(AVCodecContext& context, const VideoSettings& settings) {
  context.pix_fmt = settings.alpha ? AV_PIX_FMT_YUVA420P : AV_PIX_FMT_YUV420P;
  context.bit_rate = 0;  // constant quality
  set_gop(context, settings.fps);
  AVDictionary* options = nullptr;
  libav().av_dict_set(&options, "crf", format_shortest(crf_of(settings)).c_str(), 0);
  libav().av_dict_set(&options, "deadline", "good", 0);
  libav().av_dict_set(&options, "cpu-used", "4", 0);
  libav().av_dict_set(&options, "tile-columns", "2", 0);  // players decode them beside one another
  // Frames that are never shown have no opacity beside them: libvpx cannot have both.
  if (settings.alpha) libav().av_dict_set(&options, "auto-alt-ref", "0", 0);
  return options;
}

AVDictionary* prores_options(AVCodecContext& context, const VideoSettings& settings) {
  context.pix_fmt = settings.alpha ? AV_PIX_FMT_YUVA444P10 : AV_PIX_FMT_YUV444P10;
  context.flags |= AV_CODEC_FLAG_QSCALE;
  context.global_quality = kProresQuantiser * FF_QP2LAMBDA;
  AVDictionary* options = nullptr;
  libav().av_dict_set(&options, "profile", "4444", 0);
  libav().av_dict_set(&options, "alpha_bits", settings.alpha ? "16" : "0", 0);
  return options;
}

constexpr CodecRow kH264{"libx264", &kMp4, 18, 51, false, false, false, h264_options};
constexpr CodecRow kVp9{"libvpx-vp9", &kWebm, 28, 63, true, false, false, vp9_options};
constexpr CodecRow kProres{"prores_ks", &kMov, {}, {}, true, true, true, prores_options};

CodecContextPtr context_of(const VideoSettings& settings) {
  CodecContextPtr context = make_context(row_of(settings.codec).encoder);
  context->width = settings.width;
  context->height = settings.height;
  context->color_primaries = AVCOL_PRI_BT709;
  context->color_trc = AVCOL_TRC_BT709;
  context->colorspace = AVCOL_SPC_BT709;
  context->color_range = AVCOL_RANGE_MPEG;
  if (!row_of(settings.codec).every_pixel)
    context->chroma_sample_location = AVCHROMA_LOC_CENTER;  // as yuv.hpp computes it
  // One tick is one frame: frame k is shown from k * den / num on, exactly.
  context->time_base = {settings.fps.den, settings.fps.num};
  context->framerate = {settings.fps.num, settings.fps.den};
  return context;
}

CodecContextPtr open_codec(const VideoSettings& settings, int threads) {
  const CodecRow& row = row_of(settings.codec);
  CodecContextPtr context = context_of(settings);
  context->thread_count = threads;
  AVDictionary* options = row.options(*context, settings);
  const int code = libav().avcodec_open2(context.get(), context->codec, &options);
  libav().av_dict_free(&options);
  check_libav(code, ExitCode::no_renderer,
              std::string(row.encoder) + " refuses a film of " + std::to_string(settings.width) + "x" +
                  std::to_string(settings.height) + " at " + std::to_string(settings.fps.num) + "/" +
                  std::to_string(settings.fps.den) + " frames/s");
  return context;
}

}  // namespace

int gop_of(FrameRate fps) {
  return std::max(1, static_cast<int>(std::lround(kGopSeconds * fps.num / fps.den)));
}

const CodecRow& row_of(VideoCodec codec) {
  switch (codec) {
    case VideoCodec::h264:
      return kH264;
    case VideoCodec::vp9:
      return kVp9;
    case VideoCodec::prores:
      break;
  }
  return kProres;
}

CodecContextPtr open_encoder(const VideoSettings& settings) {
  if (settings.codec != VideoCodec::h264) return open_codec(settings, kEncoderThreads);
  CodecContextPtr described = context_of(settings);
  described->pix_fmt = AV_PIX_FMT_YUV420P;
  return described;
}

CodecContextPtr open_preset_h264(const VideoSettings& settings, int threads) {
  return open_codec(settings, threads);
}

CodecContextPtr open_small_encoder(const char* name, AVPixelFormat format, int width, int height,
                                   AVRational frame_time) {
  CodecContextPtr context = make_context(name);
  context->width = width;
  context->height = height;
  context->pix_fmt = format;
  context->time_base = frame_time;
  context->framerate = av_inv_q(frame_time);
  context->thread_count = 1;
  check_libav(
      libav().avcodec_open2(context.get(), context->codec, nullptr), ExitCode::no_renderer,
      std::string(name) + " refuses a clip of " + std::to_string(width) + "x" + std::to_string(height));
  return context;
}

void encode_frame(AVCodecContext& encoder, const AVFrame* frame, const std::string& path,
                  const std::function<void(AVPacket&)>& take) {
  const std::string failed = std::string(encoder.codec->name) + " failed";
  const PacketPtr packet(check_allocated(libav().av_packet_alloc(), "a packet"));
  check_libav(libav().avcodec_send_frame(&encoder, frame), ExitCode::no_renderer, failed, path);
  for (;;) {
    const int code = libav().avcodec_receive_packet(&encoder, packet.get());
    if (code == AVERROR(EAGAIN) || code == AVERROR_EOF) return;
    check_libav(code, ExitCode::no_renderer, failed, path);
    take(*packet);
    libav().av_packet_unref(packet.get());
  }
}

FramePtr allocate_frame(const AVCodecContext& encoder) {
  FramePtr frame(check_allocated(libav().av_frame_alloc(), "a frame"));
  frame->format = encoder.pix_fmt;
  frame->width = encoder.width;
  frame->height = encoder.height;
  frame->color_primaries = encoder.color_primaries;
  frame->color_trc = encoder.color_trc;
  frame->colorspace = encoder.colorspace;
  frame->color_range = encoder.color_range;
  check_libav(libav().av_frame_get_buffer(frame.get(), 0), ExitCode::limit, "no memory left for a frame");
  return frame;
}

}  // namespace chainreel
