// The file that a muxer writes. FFmpeg's own asks the system to move a file's position and, where that fails,
// goes on writing at the wrong place; here every piece is written at its place, and the first failure stays.
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "encode/libav.hpp"

namespace chainreel {

class FilmFile {
 public:
  // Makes or empties the file. Throws Error (exit 6) where it cannot be written, (exit 7) where memory is
  // short.
  explicit FilmFile(const std::string& path);
  ~FilmFile();
  FilmFile(const FilmFile&) = delete;
  FilmFile& operator=(const FilmFile&) = delete;

  // From now on the muxer writes here, and reads here where it moves what it wrote. This outlives it.
  void attach(AVFormatContext& format);
  // All has been handed over, and the file is closed. A negative code of FFmpeg's where something failed on
  // the way.
  int close();

 private:
  // FFmpeg 7 hands over constant bytes, those before it did not.
  template <class Byte>
  static int write(void* self, Byte* bytes, int count);
  static std::int64_t seek(void* self, std::int64_t offset, int whence);

  std::string path_;
  int file_ = -1;
  std::int64_t position_ = 0;
  int trouble_ = 0;  // errno of the first failure
  AVIOContext* stream_ = nullptr;
};

}  // namespace chainreel
