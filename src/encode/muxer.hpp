// Files that packets of encoders go to. Internal to this floor.
#pragma once

#include <cstdint>
#include <string>

#include "encode/film_file.hpp"
#include "encode/frame_sink.hpp"
#include "encode/libav.hpp"

namespace chainreel {

struct CloseFormat {
  void operator()(AVFormatContext* format) const { libav().avformat_free_context(format); }
};
using FormatPtr = std::unique_ptr<AVFormatContext, CloseFormat>;

// A kind of file: FFmpeg's name of it, and ours for errors.
struct Container {
  const char* format;
  const char* name;
  bool keeps_ticks = false;  // MP4 and MOV: the track counts in ticks that we choose, and holds any tag
};

inline constexpr Container kMp4{"mp4", "MP4", true}, kMov{"mov", "QuickTime", true}, kWebm{"webm", "WebM"},
    kGif{"gif", "GIF"}, kApng{"apng", "APNG"};

// A film's or clip's file, which takes packets that are ready.
class PacketFile {
 public:
  // Of the track that such an encoder, whose time base is one frame, writes. Throws Error (exit 4, 6).
  PacketFile(std::string path, const Container& container, const AVCodecContext& encoder, const Tags& tags);
  ~PacketFile();  // a file without its end cannot be played, so an unfinished one is taken away
  PacketFile(const PacketFile&) = delete;
  PacketFile& operator=(const PacketFile&) = delete;

  const std::string& path() const { return path_; }
  // In decoding order; a frame each, its times in frames. The packet is left with those of the file.
  void write(AVPacket& packet);
  void finish();

 private:
  void check_file(int code) const {
    check_libav(code, ExitCode::file, "the film could not be written", path_);
  }
  void open(const Container& container, const AVCodecContext& encoder, const Tags& tags);

  std::string path_;
  std::unique_ptr<FilmFile> file_;  // outlives the format that writes there
  FormatPtr format_;
  AVStream* stream_ = nullptr;
  AVRational frame_time_;
  bool finished_ = false;
  bool ended_ = false;  // libavformat was told of the end, whether the file has it or not
};

// Throws Error (exit 3) that the film has no frame.
[[noreturn]] void refuse_empty_film(const std::string& path);

// One encoder and the file that its packets go to.
class Muxer {
 public:
  // Takes an open encoder whose time base is one frame. Throws Error (exit 4, 6).
  Muxer(std::string path, const Container& container, CodecContextPtr encoder, const Tags& tags);

  const AVCodecContext& encoder() const { return *encoder_; }
  void encode(AVFrame& frame);  // its pts is set here
  void finish();                // throws Error (exit 3) where there was no frame

 private:
  void send(const AVFrame* frame);

  CodecContextPtr encoder_;
  PacketFile file_;
  std::int64_t frames_ = 0;
  bool finished_ = false;
};

}  // namespace chainreel
