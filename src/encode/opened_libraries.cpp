// The functions of FFmpeg and x264 that the program opens by name, linked: for the tool that finds what a package depends on. Part
// of no program.
#include "encode/libav_functions.hpp"
#include "encode/x264_functions.hpp"

#define CHAINREEL_ADDRESS(name) reinterpret_cast<const void*>(&::name),
extern "C" const void* const chainreel_opened_libav[];
extern "C" const void* const chainreel_opened_libav[] = {CHAINREEL_LIBAV_UTIL(CHAINREEL_ADDRESS) CHAINREEL_LIBAV_CODEC(
    CHAINREEL_ADDRESS) CHAINREEL_LIBAV_FORMAT(CHAINREEL_ADDRESS) CHAINREEL_LIBAV_SCALE(CHAINREEL_ADDRESS)};
extern "C" const void* const chainreel_opened_x264[];
extern "C" const void* const chainreel_opened_x264[] = {CHAINREEL_X264(CHAINREEL_ADDRESS)};
