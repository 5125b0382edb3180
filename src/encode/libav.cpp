#include "encode/libav.hpp"

#include <png.h>

#include <array>
#include <cstdarg>
#include <mutex>
#include <string_view>
#include <utility>

#include "core/loaded_libraries.hpp"
#include "encode/library_versions.hpp"
#include "encode/x264_functions.hpp"

namespace chainreel {
namespace {

// FFmpeg has one log for the whole process, so what it said is kept once for the whole process as well.
struct Log {
  std::mutex mutex;
  std::string lines;
};

Log& log() {
  static Log instance;
  return instance;
}

constexpr std::size_t kLongestLog = 4096;  // a flood of messages must not grow without end

void keep_error_lines(void* context, int level, const char* format, va_list arguments) {
  if (level > AV_LOG_ERROR) return;
  std::array<char, 1024> line{};
  int print_prefix = 0;  // it holds an address, which differs from run to run
  libav().av_log_format_line2(context, level, format, arguments, line.data(), static_cast<int>(line.size()),
                      &print_prefix);
  const std::lock_guard lock(log().mutex);
  if (log().lines.size() < kLongestLog) log().lines += line.data();
}

std::string take_log() {
  const std::lock_guard lock(log().mutex);
  std::string lines = std::exchange(log().lines, {});
  while (!lines.empty() && lines.back() == '\n') lines.pop_back();
  for (char& c : lines)
    if (c == '\n') c = ' ';
  return lines;
}

// Encoders tell it as their own fault. Where x264 gets no memory it says so on standard error alone, and FFmpeg nothing;
// of all else that it refuses it speaks to the log.
bool is_want_of_memory(int code, const std::string& said) {
  return code == AVERROR(ENOMEM) || said.find("llocat") != std::string::npos || (code == AVERROR_EXTERNAL && said.empty());
}

}  // namespace

void capture_libav_log() {
  static const bool installed = [] {
    libav().av_log_set_callback(keep_error_lines);
    return true;
  }();
  static_cast<void>(installed);
  take_log();
}

int check_libav(int code, ExitCode exit_code, const std::string& what, const std::string& path) {
  if (code >= 0) return code;
  std::array<char, AV_ERROR_MAX_STRING_SIZE> reason{};
  libav().av_strerror(code, reason.data(), reason.size());
  const std::string said = take_log();
  if (exit_code == ExitCode::no_renderer && is_want_of_memory(code, said))
    throw Error(ExitCode::limit, what + ": out of memory: take a smaller picture or fewer --jobs", {path});
  throw Error(exit_code, what + ": " + reason.data() + (said.empty() ? "" : " (" + said + ")"), {path});
}

namespace {

std::string version_text(unsigned version) {
  return std::to_string(AV_VERSION_MAJOR(version)) + "." + std::to_string(AV_VERSION_MINOR(version)) + "." +
         std::to_string(AV_VERSION_MICRO(version));
}

constexpr std::array kEncoders = {"libx264", "libvpx-vp9", "prores_ks", "gif", "apng", "png"};

}  // namespace

std::vector<LibraryVersion> encode_library_versions(Writes writes) {
  if (writes == Writes::pictures) return {{"libpng", png_get_libpng_ver(nullptr)}};
  return {{"FFmpeg", libav().av_version_info()},
          {"libavcodec", version_text(libav().avcodec_version())},
          {"libavformat", version_text(libav().avformat_version())},
          {"libavutil", version_text(libav().avutil_version())},
          {"libpng", png_get_libpng_ver(nullptr)}};
}

std::vector<std::string> encoder_builds() {
  constexpr std::array<std::string_view, 3> kBehind = {"libavcodec.so", "libvpx.so", "libx264.so"};
  libav();  // which loads them
  return loaded_libraries(kBehind);
}

std::vector<std::string> available_encoders() {
  std::vector<std::string> found;
  for (const std::string_view name : kEncoders)
    if (name == "libx264" ? has_x264() : libav().avcodec_find_encoder_by_name(name.data()) != nullptr) found.emplace_back(name);
  return found;
}

}  // namespace chainreel
