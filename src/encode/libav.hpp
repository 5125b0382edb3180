// FFmpeg's libraries behind a fence: owners for their handles, their return codes as Errors, their log as the
// reason inside an Error. Only writers of films and readers of films in the tests include this.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "core/error.hpp"
#include "encode/libav_functions.hpp"

namespace chainreel {

struct FreeCodecContext {
  void operator()(AVCodecContext* p) const { libav().avcodec_free_context(&p); }
};
struct FreeFrame {
  void operator()(AVFrame* p) const { libav().av_frame_free(&p); }
};
struct FreePacket {
  void operator()(AVPacket* p) const { libav().av_packet_free(&p); }
};
using CodecContextPtr = std::unique_ptr<AVCodecContext, FreeCodecContext>;
using FramePtr = std::unique_ptr<AVFrame, FreeFrame>;
using PacketPtr = std::unique_ptr<AVPacket, FreePacket>;

// Nothing that FFmpeg or x264 says reaches the terminal: lines of level error are kept for check_libav.
void capture_libav_log();

// The code itself where it is not negative; else throws Error "what: reason" with the lines logged since.
int check_libav(int code, ExitCode exit_code, const std::string& what, const std::string& path = {});

// An allocation of FFmpeg's that came back empty.
template <class T>
T* check_allocated(T* pointer, const char* what) {
  if (pointer == nullptr) throw Error(ExitCode::limit, std::string("no memory left for ") + what);
  return pointer;
}

}  // namespace chainreel
