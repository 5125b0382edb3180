#include "encode/film_reader.hpp"

#include <algorithm>
#include <cmath>

#include "encode/film_input.hpp"

namespace chainreel {
namespace {

// Times are told to a thousandth of a second in some containers.
constexpr double kSameTime = 1e-3;  // s
// Files order frames by when they are decoded, which is so much before they are shown, at most.
constexpr double kDecodedBefore = 0.5;  // s

struct FreeReaderScaler {
  void operator()(SwsContext* p) const { libav().sws_freeContext(p); }
};

// FFmpeg's own decoder of VP9 leaves opacity out.
const AVCodec* decoder_of(const AVStream& stream) {
  const bool has_opacity = libav().av_dict_get(stream.metadata, "alpha_mode", nullptr, 0) != nullptr;
  if (stream.codecpar->codec_id == AV_CODEC_ID_VP9 && has_opacity)
    if (const AVCodec* codec = libav().avcodec_find_decoder_by_name("libvpx-vp9")) return codec;
  return libav().avcodec_find_decoder(stream.codecpar->codec_id);
}

CodecContextPtr open_decoder(const AVStream& stream, const std::string& path) {
  const AVCodec* codec = decoder_of(stream);
  if (codec == nullptr) throw Error(ExitCode::bad_input, "its codec has no decoder here", {path});
  CodecContextPtr decoder(check_allocated(libav().avcodec_alloc_context3(codec), "the decoder"));
  check_libav(libav().avcodec_parameters_to_context(decoder.get(), stream.codecpar), ExitCode::bad_input,
              "holds a film that cannot be decoded", path);
  check_libav(libav().avcodec_open2(decoder.get(), codec, nullptr), ExitCode::bad_input,
              "holds a film that cannot be decoded", path);
  return decoder;
}

// By the frame's own tags, as a player would.
Image image_of(const AVFrame& frame, int width, int height) {
  const std::unique_ptr<SwsContext, FreeReaderScaler> scaler(check_allocated(
      libav().sws_getContext(frame.width, frame.height, AVPixelFormat(frame.format), width, height,
                             AV_PIX_FMT_BGRA, SWS_AREA | SWS_ACCURATE_RND | SWS_FULL_CHR_H_INT | SWS_BITEXACT,
                             nullptr, nullptr, nullptr),
      "the scaler"));
  const int* matrix = libav().sws_getCoefficients(frame.colorspace);
  libav().sws_setColorspaceDetails(scaler.get(), matrix, frame.color_range == AVCOL_RANGE_JPEG, matrix, 1, 0,
                                   1 << 16, 1 << 16);
  Image image(width, height);
  std::uint8_t* target[4] = {image.bgra.data(), nullptr, nullptr, nullptr};
  const int stride[4] = {4 * width, 0, 0, 0};
  libav().sws_scale(scaler.get(), frame.data, frame.linesize, 0, frame.height, target, stride);
  return image;
}

}  // namespace

struct FilmReader::State {
  std::string path;
  FilmInputPtr input;
  int stream = 0;
  CodecContextPtr decoder;
  FramePtr frame;
  PacketPtr packet;
  int count = 0;                // frames so far
  std::int64_t first_time = 0;  // of the first frame, in units of the stream
  bool ended = false;           // the file was read to its end

  // Decodes the next frame into `frame`; false behind the last.
  bool decode();
  double time() const;  // s from the first frame to `frame`
  // Goes on from a key frame that is shown no later than `seconds`; false where none is found, and then from anywhere.
  bool go_to_key_before(double seconds);
  Image image(int widest) const;  // of `frame`
};

bool FilmReader::State::decode() {
  for (;;) {
    const std::string what = "holds a frame " + std::to_string(count) + " that cannot be decoded";
    const int received = libav().avcodec_receive_frame(decoder.get(), frame.get());
    if (received == 0) {
      if (count++ == 0) first_time = frame->best_effort_timestamp;
      return true;
    }
    if (received == AVERROR_EOF || (received == AVERROR(EAGAIN) && ended)) return false;
    if (received != AVERROR(EAGAIN)) check_libav(received, ExitCode::bad_input, what, path);
    const int read = libav().av_read_frame(input.get(), packet.get());
    ended = read == AVERROR_EOF;
    if (!ended) check_libav(read, ExitCode::bad_input, "cannot be read", path);
    const bool is_ours = ended || packet->stream_index == stream;
    const int sent = is_ours ? libav().avcodec_send_packet(decoder.get(), ended ? nullptr : packet.get()) : 0;
    libav().av_packet_unref(packet.get());
    check_libav(sent, ExitCode::bad_input, what, path);
  }
}

double FilmReader::State::time() const {
  return double(frame->best_effort_timestamp - first_time) * av_q2d(input->streams[stream]->time_base);
}

bool FilmReader::State::go_to_key_before(double seconds) {
  const auto target = first_time + std::int64_t(seconds / av_q2d(input->streams[stream]->time_base));
  if (libav().av_seek_frame(input.get(), stream, target, AVSEEK_FLAG_BACKWARD) < 0) return false;
  libav().avcodec_flush_buffers(decoder.get());
  ended = false;
  return decode() && time() <= seconds + kSameTime;
}

Image FilmReader::State::image(int widest) const {
  const int width = std::min(frame->width, widest);
  const double scale = double(width) / frame->width;
  return image_of(*frame, width, std::max(1, int(std::lround(frame->height * scale))));
}

FilmReader::FilmReader(const std::string& path) : state_(std::make_unique<State>()) {
  State& s = *state_;
  s.path = path;
  s.input = open_film(path, FilmKinds::films_and_small_clips);
  check_libav(libav().avformat_find_stream_info(s.input.get(), nullptr), ExitCode::bad_input,
              "holds no readable film", path);
  s.stream = check_libav(libav().av_find_best_stream(s.input.get(), AVMEDIA_TYPE_VIDEO, -1, -1, nullptr, 0),
                         ExitCode::bad_input, "holds no film", path);
  s.decoder = open_decoder(*s.input->streams[s.stream], path);
  s.frame.reset(check_allocated(libav().av_frame_alloc(), "a frame"));
  s.packet.reset(check_allocated(libav().av_packet_alloc(), "a packet"));
}

FilmReader::~FilmReader() = default;
FilmReader::FilmReader(FilmReader&&) noexcept = default;
FilmReader& FilmReader::operator=(FilmReader&&) noexcept = default;

double FilmReader::seconds() const {
  return state_->input->duration == AV_NOPTS_VALUE ? 0 : double(state_->input->duration) / AV_TIME_BASE;
}

double FilmReader::fps() const {
  const AVRational rate = state_->input->streams[state_->stream]->avg_frame_rate;
  return rate.den == 0 ? 0 : av_q2d(rate);
}

std::string FilmReader::container() const {
  return state_->input->iformat->name;
}

int FilmReader::width() const {
  return state_->frame->width;
}
int FilmReader::height() const {
  return state_->frame->height;
}

double FilmReader::time() const {
  return state_->time();
}

bool FilmReader::next(Image& image, int widest) {
  if (!state_->decode()) return false;
  image = state_->image(widest);
  return true;
}

bool FilmReader::find(double seconds, Image& image, int widest) {
  if (!state_->decode()) return false;
  // Within the first second nothing is saved; a film that cannot be searched is read from its start.
  if (seconds > 2 * kDecodedBefore && !state_->go_to_key_before(seconds - kDecodedBefore)) {
    *this = FilmReader(state_->path);
    state_->decode();
  }
  State& s = *state_;
  FramePtr shown(check_allocated(libav().av_frame_alloc(), "a frame"));
  do
    std::swap(s.frame, shown);
  while (s.decode() && s.time() <= seconds + kSameTime);
  std::swap(s.frame, shown);
  image = s.image(widest);
  return true;
}

}  // namespace chainreel
