// One encoder and the file that its packets go to. Internal to this floor.
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

class Muxer {
 public:
  // Takes an open encoder whose time base is one frame. Throws Error (exit 4, 6).
  Muxer(std::string path, const Container& container, CodecContextPtr encoder, const Tags& tags);
  ~Muxer();  // a file without its end cannot be played, so an unfinished one is taken away
  Muxer(const Muxer&) = delete;
  Muxer& operator=(const Muxer&) = delete;

  const AVCodecContext& encoder() const { return *encoder_; }
  std::int64_t frames() const { return frames_; }
  void encode(AVFrame& frame);  // its pts is set here
  void finish();                // throws Error (exit 3) where there was no frame

 private:
  void check_file(int code) const {
    check_libav(code, ExitCode::file, "the film could not be written", path_);
  }
  void open_file(const Container& container, const Tags& tags);
  void send(const AVFrame* frame);

  std::string path_;
  CodecContextPtr encoder_;
  std::unique_ptr<FilmFile> file_;  // outlives the format that writes there
  FormatPtr format_;
  PacketPtr packet_;
  AVStream* stream_ = nullptr;
  std::int64_t frames_ = 0;
  bool finished_ = false;
  bool ended_ = false;  // libavformat was told of the end, whether the file has it or not
};

}  // namespace chainreel
