#include "encode/x264_functions.hpp"

#include <dlfcn.h>

#include "core/error.hpp"
#include "encode/libav_functions.hpp"

namespace chainreel {
namespace {

// The header names functions by the version of the library, as x264_encoder_open_164.
#define CHAINREEL_QUOTED(name) #name
#define CHAINREEL_EXPANDED(name) CHAINREEL_QUOTED(name)

X264Functions load_x264() {
  void* const library = open_film_library("x264", X264_BUILD, "libx264-");
  X264Functions functions;
#define CHAINREEL_X264_LOAD(name)                                                                         \
  functions.name = reinterpret_cast<decltype(functions.name)>(dlsym(library, CHAINREEL_EXPANDED(name))); \
  if (functions.name == nullptr)                                                                          \
    throw Error(ExitCode::no_renderer, "x264 has no function " CHAINREEL_EXPANDED(name) ": install Debian's libx264");
  CHAINREEL_X264(CHAINREEL_X264_LOAD)
#undef CHAINREEL_X264_LOAD
  return functions;
}

}  // namespace

const X264Functions& x264() {
  static const X264Functions functions = load_x264();
  return functions;
}

bool has_x264() {
  try {
    x264();
    return true;
  } catch (const Error&) {
    return false;
  }
}

}  // namespace chainreel
