#include "support/video_probe.hpp"

#include <array>
#include <cstring>
#include <fstream>
#include <memory>

#include "core/error.hpp"
#include "encode/libav.hpp"

extern "C" {
#include <libswscale/swscale.h>
}

namespace chainreel {
namespace {

struct CloseInput {
  void operator()(AVFormatContext* p) const { avformat_close_input(&p); }
};
using InputPtr = std::unique_ptr<AVFormatContext, CloseInput>;

struct FreeScaler {
  void operator()(SwsContext* p) const { sws_freeContext(p); }
};

std::string text_or_unknown(const char* text) {
  return text == nullptr ? "unknown" : text;
}

Ratio ratio(AVRational r) {
  return {r.num, r.den == 0 ? 1 : r.den};
}

std::uint64_t big_endian(const std::array<unsigned char, 16>& bytes, std::size_t from, std::size_t count) {
  std::uint64_t value = 0;
  for (std::size_t i = from; i < from + count; ++i) value = value << 8 | bytes[i];
  return value;
}

Image to_image(const AVFrame& frame) {
  Image image(frame.width, frame.height);
  const std::unique_ptr<SwsContext, FreeScaler> scaler(check_allocated(
      sws_getContext(frame.width, frame.height, AVPixelFormat(frame.format), frame.width, frame.height,
                     AV_PIX_FMT_BGRA, SWS_BILINEAR | SWS_ACCURATE_RND | SWS_FULL_CHR_H_INT | SWS_BITEXACT,
                     nullptr, nullptr, nullptr),
      "the scaler"));
  // By the frame's own tags, as a player would.
  const int* matrix = sws_getCoefficients(frame.colorspace);
  sws_setColorspaceDetails(scaler.get(), matrix, frame.color_range == AVCOL_RANGE_JPEG, matrix, 1, 0, 1 << 16,
                           1 << 16);
  std::uint8_t* target[4] = {image.bgra.data(), nullptr, nullptr, nullptr};
  const int stride[4] = {4 * frame.width, 0, 0, 0};
  sws_scale(scaler.get(), frame.data, frame.linesize, 0, frame.height, target, stride);
  return image;
}

InputPtr open_input(const std::string& path) {
  AVFormatContext* raw = nullptr;
  check_libav(avformat_open_input(&raw, ("file:" + path).c_str(), nullptr, nullptr), ExitCode::bad_input,
              "cannot be opened", path);
  InputPtr input(raw);
  check_libav(avformat_find_stream_info(raw, nullptr), ExitCode::bad_input, "holds no readable stream", path);
  return input;
}

CodecContextPtr open_decoder(const AVStream& stream, const std::string& path) {
  // FFmpeg's own decoder of VP9 leaves opacity out.
  const AVCodec* codec = stream.codecpar->codec_id == AV_CODEC_ID_VP9
                             ? avcodec_find_decoder_by_name("libvpx-vp9")
                             : avcodec_find_decoder(stream.codecpar->codec_id);
  if (codec == nullptr) throw Error(ExitCode::bad_input, "its codec has no decoder here", {path});
  CodecContextPtr decoder(check_allocated(avcodec_alloc_context3(codec), "the decoder"));
  check_libav(avcodec_parameters_to_context(decoder.get(), stream.codecpar), ExitCode::bad_input,
              "bad parameters", path);
  decoder->err_recognition = AV_EF_CRCCHECK | AV_EF_BITSTREAM | AV_EF_BUFFER | AV_EF_EXPLODE;
  check_libav(avcodec_open2(decoder.get(), codec, nullptr), ExitCode::bad_input, "cannot be decoded", path);
  return decoder;
}

void describe(VideoFacts& facts, const AVFormatContext& input, const AVStream& stream) {
  const AVCodecParameters& parameters = *stream.codecpar;
  facts.codec = avcodec_get_name(parameters.codec_id);
  facts.profile = text_or_unknown(avcodec_profile_name(parameters.codec_id, parameters.profile));
  facts.pixel_format = text_or_unknown(av_get_pix_fmt_name(AVPixelFormat(parameters.format)));
  facts.width = parameters.width;
  facts.height = parameters.height;
  facts.pixel_aspect = ratio(parameters.sample_aspect_ratio);
  facts.fps = ratio(stream.avg_frame_rate);
  facts.duration = {stream.duration * stream.time_base.num, stream.time_base.den};
  facts.movie_duration = {input.duration, AV_TIME_BASE};
  facts.declared_frames = static_cast<int>(stream.nb_frames);
  facts.primaries = text_or_unknown(av_color_primaries_name(parameters.color_primaries));
  facts.transfer = text_or_unknown(av_color_transfer_name(parameters.color_trc));
  facts.matrix = text_or_unknown(av_color_space_name(parameters.color_space));
  facts.range = text_or_unknown(av_color_range_name(parameters.color_range));
  const AVDictionaryEntry* alpha_mode = av_dict_get(stream.metadata, "alpha_mode", nullptr, 0);
  if (alpha_mode != nullptr) facts.alpha_mode = alpha_mode->value;
}

// Takes every frame that the decoder has ready.
void take_frames(VideoFacts& facts, AVCodecContext& decoder, const AVStream& stream, AVFrame& frame,
                 const std::string& path) {
  for (;;) {
    const int code = avcodec_receive_frame(&decoder, &frame);
    if (code == AVERROR(EAGAIN) || code == AVERROR_EOF) return;
    check_libav(code, ExitCode::bad_input, "frame " + std::to_string(facts.frames) + " cannot be decoded",
                path);
    if (av_compare_ts(frame.pts, stream.time_base, facts.frames, av_inv_q(stream.avg_frame_rate)) != 0)
      facts.regular = false;
    if (frame.key_frame != 0) facts.key_frames.push_back(facts.frames);
    if (facts.frames == 0) facts.first = to_image(frame);
    if (facts.frames == facts.declared_frames / 2) facts.middle = to_image(frame);
    if (facts.declared_frames == 0 || facts.frames == facts.declared_frames - 1) facts.last = to_image(frame);
    facts.pixel_format = text_or_unknown(av_get_pix_fmt_name(AVPixelFormat(frame.format)));
    ++facts.frames;
  }
}

}  // namespace

// Walks the top-level boxes of an MP4 (ISO/IEC 14496-12, 4.2): size, four letters, for size 1 a 64-bit size.
bool has_index_first(const std::string& path) {
  std::ifstream stream(path, std::ios::binary);
  std::array<unsigned char, 16> head{};
  while (stream.read(reinterpret_cast<char*>(head.data()), 8)) {
    const std::string kind(reinterpret_cast<const char*>(head.data()) + 4, 4);
    if (kind == "moov") return true;
    if (kind == "mdat") return false;
    std::uint64_t size = big_endian(head, 0, 4);
    std::uint64_t read = 8;
    if (size == 1 && stream.read(reinterpret_cast<char*>(head.data()) + 8, 8)) {
      size = big_endian(head, 8, 8);
      read = 16;
    }
    if (size < read) return false;
    stream.seekg(static_cast<std::streamoff>(size - read), std::ios::cur);
  }
  return false;
}

VideoFacts probe_video(const std::string& path) {
  capture_libav_log();
  const InputPtr input = open_input(path);
  const int index = check_libav(av_find_best_stream(input.get(), AVMEDIA_TYPE_VIDEO, -1, -1, nullptr, 0),
                                ExitCode::bad_input, "holds no film", path);
  const AVStream& stream = *input->streams[index];
  VideoFacts facts;
  describe(facts, *input, stream);
  facts.index_first = has_index_first(path);
  facts.regular = true;

  const CodecContextPtr decoder = open_decoder(stream, path);
  const FramePtr frame(check_allocated(av_frame_alloc(), "a frame"));
  const PacketPtr packet(check_allocated(av_packet_alloc(), "a packet"));
  for (;;) {
    const int code = av_read_frame(input.get(), packet.get());
    if (code == AVERROR_EOF) break;
    check_libav(code, ExitCode::bad_input, "cannot be read to its end", path);
    if (packet->stream_index == index) {
      check_libav(avcodec_send_packet(decoder.get(), packet.get()), ExitCode::bad_input,
                  "cannot be decoded after frame " + std::to_string(facts.frames), path);
      take_frames(facts, *decoder, stream, *frame, path);
    }
    av_packet_unref(packet.get());
  }
  check_libav(avcodec_send_packet(decoder.get(), nullptr), ExitCode::bad_input,
              "cannot be decoded to its end", path);
  take_frames(facts, *decoder, stream, *frame, path);
  facts.regular = facts.regular && facts.frames > 0;
  return facts;
}

}  // namespace chainreel
