#include "encode/libav_functions.hpp"

#include <dlfcn.h>

#include <string>

#include "core/error.hpp"

namespace chainreel {

void* open_film_library(const std::string& name, int version, const std::string& package) {
  const std::string file = "lib" + name + ".so." + std::to_string(version);
  void* const library = dlopen(file.c_str(), RTLD_LAZY | RTLD_LOCAL);
  if (library != nullptr) return library;
  const std::string reason = dlerror();
  // It is there, but has no room: it brings a hundred others along.
  if (reason.find("map segment") != std::string::npos || reason.find("llocate memory") != std::string::npos)
    throw Error(ExitCode::limit, "no films: out of memory (" + reason + "): raise the limit of address space (ulimit -v)");
  throw Error(ExitCode::no_renderer,
              "no films: " + reason + "; install the Debian package " + package + std::to_string(version));
}

namespace {

void* open_library(const std::string& name, int version) {
  return open_film_library(name, version, "lib" + name);
}

LibavFunctions load_functions() {
  LibavFunctions functions;
  void* library = nullptr;
#define CHAINREEL_LIBAV_LOAD(name)                                                    \
  functions.name = reinterpret_cast<decltype(functions.name)>(dlsym(library, #name)); \
  if (functions.name == nullptr)                                                      \
    throw Error(ExitCode::no_renderer,                                                \
                "FFmpeg's libraries have no function " #name ": install Debian's ffmpeg 5 or newer");
  library = open_library("avutil", LIBAVUTIL_VERSION_MAJOR);
  CHAINREEL_LIBAV_UTIL(CHAINREEL_LIBAV_LOAD)
  library = open_library("avcodec", LIBAVCODEC_VERSION_MAJOR);
  CHAINREEL_LIBAV_CODEC(CHAINREEL_LIBAV_LOAD)
  library = open_library("avformat", LIBAVFORMAT_VERSION_MAJOR);
  CHAINREEL_LIBAV_FORMAT(CHAINREEL_LIBAV_LOAD)
  library = open_library("swscale", LIBSWSCALE_VERSION_MAJOR);
  CHAINREEL_LIBAV_SCALE(CHAINREEL_LIBAV_LOAD)
#undef CHAINREEL_LIBAV_LOAD
  return functions;
}

}  // namespace

const LibavFunctions& libav() {
  static const LibavFunctions functions = load_functions();
  return functions;
}

}  // namespace chainreel
