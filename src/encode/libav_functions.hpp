// FFmpeg's functions, found when the first film is written or read: its libraries bring a hundred others along, which took
// longer to load than a picture takes to make, and pictures need none of them.
#pragma once

extern "C" {
#include <libavcodec/avcodec.h>
#include <libavformat/avformat.h>
#include <libavutil/opt.h>
#include <libavutil/pixdesc.h>
#include <libswscale/swscale.h>
}

#include <string>

namespace chainreel {

#define CHAINREEL_LIBAV_UTIL(X)                                                                       \
  X(av_dict_free) X(av_dict_get) X(av_dict_set) X(av_dict_set_int) X(av_frame_alloc) X(av_frame_clone) X(av_frame_free) \
  X(av_frame_get_buffer) X(av_frame_make_writable) X(av_free) X(av_freep) X(av_log_format_line2)      \
  X(av_log_set_callback) X(av_malloc) X(av_strerror) X(av_version_info) X(avutil_version)
#define CHAINREEL_LIBAV_CODEC(X)                                                                            \
  X(av_packet_alloc) X(av_packet_free) X(av_packet_get_side_data) X(av_packet_new_side_data)                 \
  X(av_packet_rescale_ts) X(av_packet_unref) X(avcodec_alloc_context3) \
  X(avcodec_find_decoder) X(avcodec_find_decoder_by_name) X(avcodec_find_encoder_by_name)                   \
  X(avcodec_flush_buffers) X(avcodec_free_context) X(avcodec_open2)                                                                  \
  X(avcodec_parameters_from_context) X(avcodec_parameters_to_context) X(avcodec_receive_frame)              \
  X(avcodec_receive_packet) X(avcodec_send_frame) X(avcodec_send_packet) X(avcodec_version)
#define CHAINREEL_LIBAV_FORMAT(X)                                                            \
  X(av_find_best_stream) X(av_read_frame) X(av_seek_frame) X(av_write_frame) X(av_write_trailer) \
  X(avformat_alloc_output_context2) X(avformat_close_input) X(avformat_find_stream_info)     \
  X(avformat_free_context) X(avformat_new_stream) X(avformat_open_input) X(av_find_input_format) X(avformat_version) \
  X(avformat_write_header) X(avio_alloc_context) X(avio_context_free) X(avio_flush)
#define CHAINREEL_LIBAV_SCALE(X)                                                                       \
  X(sws_freeContext) X(sws_getCoefficients) X(sws_getContext) X(sws_scale) X(sws_setColorspaceDetails)

struct LibavFunctions {
#define CHAINREEL_LIBAV_MEMBER(name) decltype(&::name) name = nullptr;
  CHAINREEL_LIBAV_UTIL(CHAINREEL_LIBAV_MEMBER)
  CHAINREEL_LIBAV_CODEC(CHAINREEL_LIBAV_MEMBER)
  CHAINREEL_LIBAV_FORMAT(CHAINREEL_LIBAV_MEMBER)
  CHAINREEL_LIBAV_SCALE(CHAINREEL_LIBAV_MEMBER)
#undef CHAINREEL_LIBAV_MEMBER
};

// Opens the libraries at the first call; they stay. Throws Error (exit 4) naming the package where one is not there.
const LibavFunctions& libav();

// lib`name`.so of the version whose headers the program was compiled with: structures differ between them. Throws Error (exit 4
// naming the package, whose name ends with the version; 5 where there is no room for it).
void* open_film_library(const std::string& name, int version, const std::string& package);

}  // namespace chainreel
