// x264 itself for films of H.264: what libavcodec of FFmpeg 5 does not hand on is which blocks of a frame are as they were.
// Internal to this floor.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "encode/film_chunk.hpp"
#include "encode/libav.hpp"
#include "encode/still_blocks.hpp"
#include "encode/video_writer.hpp"

namespace chainreel {

class X264Encoder {
 public:
  // Settings are checked. Throws Error (exit 4: no x264 or it refuses, 5: no memory).
  explicit X264Encoder(const VideoSettings& settings);
  ~X264Encoder();

  // What decoders are to know first (sequence and picture parameters).
  std::string head() const;

  // Frames of yuv420p in order, their pts set. `still`: empty, or of each block whether its pixels are those of the frame
  // before; such a block is passed over. Each comes out at once.
  FilmPacket encode(const AVFrame& frame, StillBlocks::Flags& still);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace chainreel
