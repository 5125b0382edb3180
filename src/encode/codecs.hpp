// Encoders opened with the settings that this program stands for. Internal to this floor.
#pragma once

#include "encode/libav.hpp"
#include "encode/video_writer.hpp"

namespace chainreel {

// The encoder of a film; settings are checked. Throws Error (exit 4) where FFmpeg has none or refuses.
CodecContextPtr open_encoder(const VideoSettings& settings);

// GIF (pal8) and APNG (bgra or rgb24) of one small size.
CodecContextPtr open_small_encoder(const char* name, AVPixelFormat format, int width, int height,
                                   AVRational frame_time);

// A frame of the encoder's size, pixel format and colours.
FramePtr allocate_frame(const AVCodecContext& encoder);

}  // namespace chainreel
