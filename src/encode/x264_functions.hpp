// x264's functions, opened by name when the first film of H.264 is written, as FFmpeg's are: see libav_functions.
#pragma once

#include <cstdint>

extern "C" {
#include <x264.h>
}

namespace chainreel {

#define CHAINREEL_X264(X)                                                                                  \
  X(x264_encoder_close) X(x264_encoder_encode) X(x264_encoder_headers) X(x264_encoder_open)                \
  X(x264_param_apply_profile) X(x264_param_default_preset) X(x264_picture_init)

struct X264Functions {
#define CHAINREEL_X264_MEMBER(name) decltype(&::name) name = nullptr;
  CHAINREEL_X264(CHAINREEL_X264_MEMBER)
#undef CHAINREEL_X264_MEMBER
};

// Opens the library at the first call; it stays. Throws Error (exit 4) naming the package where it is not there.
const X264Functions& x264();
bool has_x264();  // without throwing

}  // namespace chainreel
