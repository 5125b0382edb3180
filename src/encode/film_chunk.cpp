#include "encode/film_chunk.hpp"

#include <algorithm>
#include <cstring>

#include "encode/codecs.hpp"
#include "encode/muxer.hpp"

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
  State(const std::string& path, const VideoSettings& settings)
      : State(path, settings, open_encoder(settings)) {}
  State(const std::string& path, const VideoSettings& settings, const CodecContextPtr& encoder)
      : file(path, *row_of(settings.codec).container, *encoder, settings.tags),
        delay(encoder->has_b_frames),
        packet(check_allocated(libav().av_packet_alloc(), "a packet")) {}
};

FilmWriter::FilmWriter(const std::string& path, const VideoSettings& settings) {
  require_settings(settings);
  capture_libav_log();
  state_ = std::make_unique<State>(path, settings);
}

FilmWriter::~FilmWriter() = default;

void FilmWriter::add(const FilmChunk& chunk) {
  State& s = *state_;
  for (const FilmPacket& from : chunk.packets) {
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
  s.frames += chunk.frames;
}

void FilmWriter::finish() {
  if (state_->frames == 0) refuse_empty_film(state_->file.path());
  state_->file.finish();
}

}  // namespace chainreel
