#include "encode/libraries.hpp"

#include <png.h>

extern "C" {
#include <libavcodec/avcodec.h>
#include <libavformat/avformat.h>
#include <libavutil/avutil.h>
}

#include <array>

namespace chainreel {
namespace {

std::string version_text(unsigned version) {
  return std::to_string(AV_VERSION_MAJOR(version)) + "." + std::to_string(AV_VERSION_MINOR(version)) + "." +
         std::to_string(AV_VERSION_MICRO(version));
}

constexpr std::array kEncoders = {"libx264", "libvpx-vp9", "prores_ks", "gif", "apng", "png"};

}  // namespace

std::vector<LibraryVersion> encode_library_versions() {
  return {{"FFmpeg", av_version_info()},
          {"libavcodec", version_text(avcodec_version())},
          {"libavformat", version_text(avformat_version())},
          {"libavutil", version_text(avutil_version())},
          {"libpng", png_get_libpng_ver(nullptr)}};
}

std::vector<std::string> available_encoders() {
  std::vector<std::string> found;
  for (const char* name : kEncoders)
    if (avcodec_find_encoder_by_name(name) != nullptr) found.emplace_back(name);
  return found;
}

}  // namespace chainreel
