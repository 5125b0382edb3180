#include "encode/film_chunk.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "encode/codecs.hpp"
#include "encode/film_input.hpp"
#include "encode/muxer.hpp"
#include "encode/x264_encoder.hpp"

namespace chainreel {
namespace {

constexpr int kFewKeyFrames = 8;        // of a chunk whose frames are all key frames
constexpr int kShortest = 24;           // frames; key frames are ten times as large as others
constexpr int kShortestOfMultiple = 40;  // frames of chunks that are so many for the sake of equal shares

int rounded_up(int number, int to) {
  return (number + to - 1) / to * to;
}

int chunk_count(int frames, FrameRate fps) {
  const int fewest = std::max(1, (frames + gop_of(fps) - 1) / gop_of(fps));
  for (const auto& [multiple, shortest] : {std::pair{4, kShortestOfMultiple}, {2, kShortest}})
    if (const int count = rounded_up(fewest, multiple); frames / count >= shortest) return count;
  return fewest;
}

}  // namespace

bool has_fixed_chunks(VideoCodec codec) {
  return !row_of(codec).every_frame_is_key;
}

std::vector<int> chunk_bounds(int frames, FrameRate fps, std::optional<VideoCodec> codec) {
  const int count =
      codec && has_fixed_chunks(*codec) ? chunk_count(frames, fps) : rounded_up(frames, kFewKeyFrames) / kFewKeyFrames;
  std::vector<int> bounds;
  for (int i = 0; i <= count; ++i) bounds.push_back(int(std::int64_t(frames) * i / std::max(1, count)));
  return bounds;
}

struct FilmWriter::State {
  PacketFile file;
  int delay;  // frames by which decoding must begin earlier than showing

  PacketPtr packet;
  std::int64_t frames = 0, packets = 0;

  // The track is described by an encoder, which is as those that the chunks come from and then goes.
  State(const std::string& path, const VideoSettings& settings, const std::string& head)
      : State(path, settings, encoder_with(settings, head)) {}
  State(const std::string& path, const VideoSettings& settings, const CodecContextPtr& encoder)
      : file(path, *row_of(settings.codec).container, *encoder, settings.tags),
        delay(encoder->has_b_frames),
        packet(check_allocated(libav().av_packet_alloc(), "a packet")) {}

  static CodecContextPtr encoder_with(const VideoSettings& settings, std::string head) {
    CodecContextPtr encoder = open_encoder(settings);
    if (head.empty() && settings.codec == VideoCodec::h264) head = X264Encoder(settings).head();
    if (head.empty()) return encoder;
    libav().av_freep(&encoder->extradata);
    encoder->extradata_size = 0;
    auto* const bytes = static_cast<std::uint8_t*>(
        check_allocated(libav().av_malloc(head.size() + AV_INPUT_BUFFER_PADDING_SIZE), "the film's track"));
    std::memset(bytes, 0, head.size() + AV_INPUT_BUFFER_PADDING_SIZE);
    std::memcpy(bytes, head.data(), head.size());
    encoder->extradata = bytes;
    encoder->extradata_size = int(head.size());
    return encoder;
  }
};

FilmWriter::FilmWriter(const std::string& path, const VideoSettings& settings, const std::string& head) {
  require_settings(settings);
  capture_libav_log();
  state_ = std::make_unique<State>(path, settings, head);
}

FilmWriter::~FilmWriter() = default;

void FilmWriter::add(const FilmChunk& chunk) {
  for (const FilmPacket& packet : chunk.packets) add(packet);
  end_chunk(chunk.frames);
}

void FilmWriter::add(const FilmPacket& from) {
  State& s = *state_;
  AVPacket& to = *s.packet;
  to.data = reinterpret_cast<std::uint8_t*>(const_cast<char*>(from.data.data()));  // it is only read
  to.size = int(from.data.size());
  to.pts = s.frames + from.pts;
  to.dts = s.packets++ - s.delay;
  to.flags = from.is_key ? AV_PKT_FLAG_KEY : 0;
  if (!from.opacity.empty()) {
    std::uint8_t* const side = check_allocated(
        libav().av_packet_new_side_data(&to, AV_PKT_DATA_MATROSKA_BLOCKADDITIONAL, from.opacity.size()), "a packet");
    std::memcpy(side, from.opacity.data(), from.opacity.size());
  }
  s.file.write(to);
  libav().av_packet_unref(&to);
}

void FilmWriter::end_chunk(int frames) {
  state_->frames += frames;
}

void FilmWriter::finish() {
  if (state_->frames == 0) refuse_empty_film(state_->file.path());
  state_->file.finish();
}

FilmPacket kept_packet(const AVPacket& packet) {
  FilmPacket kept;
  kept.data.assign(reinterpret_cast<const char*>(packet.data), std::size_t(packet.size));
  kept.pts = packet.pts;
  kept.is_key = (packet.flags & AV_PKT_FLAG_KEY) != 0;
  std::size_t size = 0;
  if (const auto* side = libav().av_packet_get_side_data(&packet, AV_PKT_DATA_MATROSKA_BLOCKADDITIONAL, &size))
    kept.opacity.assign(reinterpret_cast<const char*>(side), size);
  return kept;
}

struct PacketReader::State {
  std::string path, head;
  FrameRate fps;
  FilmInputPtr input;
  PacketPtr packet;
  const AVStream* stream = nullptr;
  VideoCodec codec = VideoCodec::h264;
};

namespace {

VideoCodec codec_of(const AVStream& stream, const std::string& path) {
  switch (stream.codecpar->codec_id) {
    case AV_CODEC_ID_H264:
      return VideoCodec::h264;
    case AV_CODEC_ID_VP9:
      return VideoCodec::vp9;
    case AV_CODEC_ID_PRORES:
      return VideoCodec::prores;
    default:
      throw Error(ExitCode::bad_input, "holds no film that this program wrote", {path});
  }
}

}  // namespace

PacketReader::PacketReader(const std::string& path, FrameRate fps) : state_(std::make_unique<State>()) {
  State& s = *state_;
  s.path = path;
  s.fps = fps;
  s.input = open_film(path);
  s.packet.reset(check_allocated(libav().av_packet_alloc(), "a packet"));
  if (s.input->nb_streams != 1) throw Error(ExitCode::bad_input, "holds no film that this program wrote", {path});
  s.stream = s.input->streams[0];
  s.codec = codec_of(*s.stream, path);
  // Packets of MP4 stand in another form than an encoder's, which its head tells.
  if (s.codec == VideoCodec::h264)
    s.head.assign(reinterpret_cast<const char*>(s.stream->codecpar->extradata),
                  std::size_t(std::max(0, s.stream->codecpar->extradata_size)));
}

PacketReader::~PacketReader() = default;
PacketReader::PacketReader(PacketReader&&) noexcept = default;

VideoCodec PacketReader::codec() const {
  return state_->codec;
}

const std::string& PacketReader::head() const {
  return state_->head;
}

bool PacketReader::next(FilmPacket& packet) {
  State& s = *state_;
  const int code = libav().av_read_frame(s.input.get(), s.packet.get());
  if (code == AVERROR_EOF) return false;
  check_libav(code, ExitCode::bad_input, "cannot be read", s.path);
  packet = kept_packet(*s.packet);
  // WebM counts in milliseconds: the frame nearest to that.
  packet.pts = std::llround(double(packet.pts) * av_q2d(s.stream->time_base) * s.fps.value());
  libav().av_packet_unref(s.packet.get());
  return true;
}

}  // namespace chainreel
