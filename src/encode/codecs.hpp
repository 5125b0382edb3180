// Encoders opened with the settings that this program stands for. Internal to this floor.
#pragma once

#include "encode/libav.hpp"
#include "encode/muxer.hpp"
#include "encode/video_writer.hpp"

namespace chainreel {

// What a film's codec is made of: to add one, its row.
struct CodecRow {
  const char* encoder;  // FFmpeg's name
  const Container* container;
  std::optional<double> crf, worst_crf;  // the usual quality and the worst; none of a codec of fixed quality
  bool alpha;                            // can keep opacity
  bool every_pixel;                      // 4:4:4 at 10 bits; else 4:2:0 at 8
  AVDictionary* (*options)(AVCodecContext&, const VideoSettings&);
};
const CodecRow& row_of(VideoCodec codec);

// The encoder of a film; settings are checked. Throws Error (exit 4) where FFmpeg has none or refuses.
CodecContextPtr open_encoder(const VideoSettings& settings);

// GIF (pal8) and APNG (bgra or rgb24) of one small size.
CodecContextPtr open_small_encoder(const char* name, AVPixelFormat format, int width, int height,
                                   AVRational frame_time);

// A frame of the encoder's size, pixel format and colours.
FramePtr allocate_frame(const AVCodecContext& encoder);

}  // namespace chainreel
