// Encoders opened with the settings that this program stands for. Internal to this floor.
#pragma once

#include <functional>
#include <string>

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
  bool every_frame_is_key;
  AVDictionary* (*options)(AVCodecContext&, const VideoSettings&);
};
const CodecRow& row_of(VideoCodec codec);

// Frames from one key frame to the next, at most: two seconds.
int gop_of(FrameRate fps);

// The encoder of a film; settings are checked. Throws Error (exit 4) where FFmpeg has none or refuses. Of H.264 it is not open and
// tells what a track of X264Encoder's is, all but its head.
CodecContextPtr open_encoder(const VideoSettings& settings);

// x264 as programs have it that ask for its preset veryfast and this quality, with threads of its own.
CodecContextPtr open_preset_h264(const VideoSettings& settings, int threads);

// GIF (pal8) and APNG (bgra or rgb24) of one small size.
CodecContextPtr open_small_encoder(const char* name, AVPixelFormat format, int width, int height,
                                   AVRational frame_time);

// Gives the encoder a frame, or with nullptr the end, and hands on every packet that is ready. `path`: the film, for errors.
void encode_frame(AVCodecContext& encoder, const AVFrame* frame, const std::string& path,
                  const std::function<void(AVPacket&)>& take);

// A packet's bytes and what goes with them; its time as it stands.
struct FilmPacket;
FilmPacket kept_packet(const AVPacket& packet);

// A frame of the encoder's size, pixel format and colours.
FramePtr allocate_frame(const AVCodecContext& encoder);

}  // namespace chainreel
