#include "encode/film_start.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>

#include "encode/libav.hpp"

namespace chainreel {
namespace {

struct FreeScaler {
  void operator()(SwsContext* p) const { libav().sws_freeContext(p); }
};

CodecContextPtr open_decoder(const AVStream& stream, const std::string& path) {
  const AVCodec* codec = libav().avcodec_find_decoder(stream.codecpar->codec_id);
  if (codec == nullptr) throw Error(ExitCode::bad_input, "its codec has no decoder here", {path});
  CodecContextPtr decoder(check_allocated(libav().avcodec_alloc_context3(codec), "the decoder"));
  check_libav(libav().avcodec_parameters_to_context(decoder.get(), stream.codecpar), ExitCode::bad_input,
              "holds a film that cannot be decoded", path);
  check_libav(libav().avcodec_open2(decoder.get(), codec, nullptr), ExitCode::bad_input,
              "holds a film that cannot be decoded", path);
  return decoder;
}

// False where the file ends before a frame is whole.
bool decode_first_frame(AVFormatContext& input, int index, AVCodecContext& decoder, AVFrame& frame,
                        const std::string& path) {
  const PacketPtr packet(check_allocated(libav().av_packet_alloc(), "a packet"));
  for (bool ended = false;;) {
    const int received = libav().avcodec_receive_frame(&decoder, &frame);
    if (received == 0) return true;
    if (ended || received != AVERROR(EAGAIN)) return false;
    const int read = libav().av_read_frame(&input, packet.get());
    ended = read == AVERROR_EOF;
    if (!ended) check_libav(read, ExitCode::bad_input, "cannot be read", path);
    if (ended || packet->stream_index == index)
      check_libav(libav().avcodec_send_packet(&decoder, ended ? nullptr : packet.get()), ExitCode::bad_input,
                  "holds a first frame that cannot be decoded", path);
    libav().av_packet_unref(packet.get());
  }
}

// By the frame's own tags, as a player would.
Image to_image(const AVFrame& frame, int widest) {
  const int width = std::min(frame.width, widest);
  const int height = std::max(1, int(std::lround(double(frame.height) * width / frame.width)));
  const std::unique_ptr<SwsContext, FreeScaler> scaler(check_allocated(
      libav().sws_getContext(frame.width, frame.height, AVPixelFormat(frame.format), width, height, AV_PIX_FMT_BGRA,
                     SWS_AREA | SWS_ACCURATE_RND | SWS_FULL_CHR_H_INT | SWS_BITEXACT, nullptr, nullptr,
                     nullptr),
      "the scaler"));
  const int* matrix = libav().sws_getCoefficients(frame.colorspace);
  libav().sws_setColorspaceDetails(scaler.get(), matrix, frame.color_range == AVCOL_RANGE_JPEG, matrix, 1, 0, 1 << 16,
                           1 << 16);
  Image image(width, height);
  std::uint8_t* target[4] = {image.bgra.data(), nullptr, nullptr, nullptr};
  const int stride[4] = {4 * width, 0, 0, 0};
  libav().sws_scale(scaler.get(), frame.data, frame.linesize, 0, frame.height, target, stride);
  for (std::size_t i = 3; i < image.bgra.size(); i += 4) image.bgra[i] = 255;
  return image;
}

}  // namespace

FilmStart read_film_start(const std::string& path, int widest) {
  const FilmInputPtr input = open_film(path);
  check_libav(libav().avformat_find_stream_info(input.get(), nullptr), ExitCode::bad_input, "holds no readable film",
              path);
  const int index = check_libav(libav().av_find_best_stream(input.get(), AVMEDIA_TYPE_VIDEO, -1, -1, nullptr, 0),
                                ExitCode::bad_input, "holds no film", path);
  const CodecContextPtr decoder = open_decoder(*input->streams[index], path);
  const FramePtr frame(check_allocated(libav().av_frame_alloc(), "a frame"));
  if (!decode_first_frame(*input, index, *decoder, *frame, path))
    throw Error(ExitCode::bad_input, "holds no frame that can be decoded", {path});
  return {frame->width, frame->height, double(input->duration) / AV_TIME_BASE, to_image(*frame, widest)};
}

FilmInputPtr open_film(const std::string& path) {
  capture_libav_log();
  AVDictionary* options = nullptr;
  // A file that plays a list must not open others.
  libav().av_dict_set(&options, "protocol_whitelist", "file", 0);
  libav().av_dict_set(&options, "format_whitelist", "mov,mp4,m4a,3gp,3g2,mj2,matroska,webm", 0);
  AVFormatContext* input = nullptr;
  const int code = libav().avformat_open_input(&input, ("file:" + path).c_str(), nullptr, &options);
  libav().av_dict_free(&options);
  check_libav(code, ExitCode::bad_input, "is no film that can be read", path);
  return FilmInputPtr(input);
}

Tags read_film_tags(const std::string& path) {
  const FilmInputPtr input = open_film(path);
  Tags tags;
  const AVDictionaryEntry* entry = nullptr;
  while ((entry = libav().av_dict_get(input->metadata, "", entry, AV_DICT_IGNORE_SUFFIX)) != nullptr) {
    std::string name = entry->key;  // WebM writes them in capitals
    std::transform(name.begin(), name.end(), name.begin(), [](unsigned char c) { return std::tolower(c); });
    tags[name] = entry->value;
  }
  return tags;
}

}  // namespace chainreel
