#include "encode/muxer.hpp"

#include <filesystem>
#include <utility>

#include "encode/codecs.hpp"

namespace chainreel {
namespace {

constexpr std::int64_t kFewestTicks = 10000;  // a second; what players are used to

// A multiple of the frame rate, so that nothing is rounded.
std::int64_t ticks_of(AVRational fps) {
  std::int64_t ticks = fps.num;
  while (ticks < kFewestTicks) ticks *= 2;
  return ticks;
}

}  // namespace

PacketFile::PacketFile(std::string path, const Container& container, const AVCodecContext& encoder, const Tags& tags)
    : path_(std::move(path)), frame_time_(encoder.time_base) {
  try {
    open(container, encoder, tags);
  } catch (...) {
    format_.reset();
    throw;
  }
}

void PacketFile::open(const Container& container, const AVCodecContext& encoder, const Tags& tags) {
  const std::string url = "file:" + path_;  // or "a:b.mp4" would be taken for a protocol
  AVFormatContext* raw = nullptr;
  check_libav(libav().avformat_alloc_output_context2(&raw, nullptr, container.format, url.c_str()),
              ExitCode::no_renderer, std::string("FFmpeg's libavformat cannot write ") + container.name);
  format_.reset(raw);
  raw->flags |= AVFMT_FLAG_BITEXACT;  // no creation time, no version of the library
  stream_ = check_allocated(libav().avformat_new_stream(raw, nullptr), "the film's track");
  stream_->time_base = encoder.time_base;
  stream_->avg_frame_rate = encoder.framerate;
  check_libav(libav().avcodec_parameters_from_context(stream_->codecpar, &encoder), ExitCode::limit,
              "no memory left for the film's track");
  // By this tag WebM's players find the opacity beside the pictures.
  if (encoder.pix_fmt == AV_PIX_FMT_YUVA420P) libav().av_dict_set(&stream_->metadata, "alpha_mode", "1", 0);
  for (const auto& [key, value] : tags) libav().av_dict_set(&raw->metadata, key.c_str(), value.c_str(), 0);
  file_ = std::make_unique<FilmFile>(path_);
  file_->attach(*raw);

  AVDictionary* options = nullptr;
  if (container.keeps_ticks) {
    // Times are exact: movie and track both count in the track's ticks. Tags of any name need the second
    // flag.
    const std::int64_t ticks = ticks_of(encoder.framerate);
    libav().av_dict_set(&options, "movflags", tags.empty() ? "+faststart" : "+faststart+use_metadata_tags", 0);
    libav().av_dict_set_int(&options, "video_track_timescale", ticks, 0);
    libav().av_dict_set_int(&options, "movie_timescale", ticks, 0);
  }
  if (std::string_view(container.format) == "apng") libav().av_dict_set(&options, "plays", "0", 0);  // for ever
  const int code = libav().avformat_write_header(raw, &options);
  libav().av_dict_free(&options);
  check_file(code);
}

PacketFile::~PacketFile() {
  if (finished_) return;
  // libavformat's GIF muxer lets go of the packet that it holds back at the end of the file only.
  if (!ended_ && stream_->codecpar->codec_id == AV_CODEC_ID_GIF) libav().av_write_trailer(format_.get());
  format_.reset();
  file_.reset();
  std::error_code ignored;
  if (std::filesystem::is_regular_file(path_, ignored)) std::filesystem::remove(path_, ignored);
}

void PacketFile::write(AVPacket& packet) {
  packet.duration = 1;  // encoders leave it open; without it the last frame would have no length
  packet.stream_index = stream_->index;
  libav().av_packet_rescale_ts(&packet, frame_time_, stream_->time_base);
  check_file(libav().av_write_frame(format_.get(), &packet));
}

void PacketFile::finish() {
  if (finished_) return;
  libav().avio_flush(format_->pb);
  check_file(format_->pb->error);  // before the index is moved to the front of data that is not there
  ended_ = true;
  check_file(libav().av_write_trailer(format_.get()));
  format_.reset();
  check_file(file_->close());
  finished_ = true;
}

void refuse_empty_film(const std::string& path) {
  throw Error(ExitCode::bad_input, "the film has no frame: its duration is shorter than half a frame", {path});
}

Muxer::Muxer(std::string path, const Container& container, CodecContextPtr encoder, const Tags& tags)
    : encoder_(std::move(encoder)), file_(std::move(path), container, *encoder_, tags) {}

void Muxer::send(const AVFrame* frame) {
  encode_frame(*encoder_, frame, file_.path(), [this](AVPacket& packet) { file_.write(packet); });
}

void Muxer::encode(AVFrame& frame) {
  frame.pts = frames_++;
  send(&frame);
}

void Muxer::finish() {
  if (finished_) return;
  if (frames_ == 0) refuse_empty_film(file_.path());
  send(nullptr);
  file_.finish();
  finished_ = true;
}

}  // namespace chainreel
