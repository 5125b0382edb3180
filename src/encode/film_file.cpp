#include "encode/film_file.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>

namespace chainreel {
namespace {

constexpr int kBuffer = 65536;  // bytes

// Where a seek leads; negative codes as FFmpeg's.
std::int64_t moved(int file, std::int64_t position, std::int64_t offset, int whence) {
  struct stat facts = {};
  if (fstat(file, &facts) != 0) return AVERROR(errno);
  whence &= ~AVSEEK_FORCE;
  if (whence == AVSEEK_SIZE) return facts.st_size;
  const std::int64_t from = whence == SEEK_SET   ? 0
                            : whence == SEEK_CUR ? position
                                                 : std::int64_t(facts.st_size);
  return from + offset >= 0 ? from + offset : AVERROR(EINVAL);
}

// Reads what has been written so far.
struct FileReader {
  int file;
  std::int64_t position = 0;

  static int read(void* self, std::uint8_t* bytes, int count) {
    FileReader& reader = *static_cast<FileReader*>(self);
    ssize_t got = 0;
    do got = pread(reader.file, bytes, std::size_t(count), reader.position);
    while (got < 0 && errno == EINTR);
    if (got < 0) return AVERROR(errno);
    reader.position += got;
    return got == 0 ? AVERROR_EOF : int(got);
  }
  static std::int64_t seek(void* self, std::int64_t offset, int whence) {
    FileReader& reader = *static_cast<FileReader*>(self);
    const std::int64_t to = moved(reader.file, reader.position, offset, whence);
    if (to >= 0 && (whence & ~AVSEEK_FORCE) != AVSEEK_SIZE) reader.position = to;
    return to;
  }
};

void free_stream(AVIOContext* stream) {
  if (stream == nullptr) return;
  libav().av_freep(&stream->buffer);
  libav().avio_context_free(&stream);
}

// Muxers open the file a second time to move the index before the frames.
int open_reader(AVFormatContext* format, AVIOContext** stream, const char*, int flags, AVDictionary**) {
  if ((flags & AVIO_FLAG_WRITE) != 0) return AVERROR(ENOSYS);
  auto* buffer = static_cast<unsigned char*>(libav().av_malloc(kBuffer));
  auto reader = std::make_unique<FileReader>(FileReader{*static_cast<const int*>(format->opaque)});
  *stream = buffer == nullptr ? nullptr
                              : libav().avio_alloc_context(buffer, kBuffer, 0, reader.get(),
                                                           &FileReader::read, nullptr, &FileReader::seek);
  if (*stream == nullptr) {
    libav().av_free(buffer);
    return AVERROR(ENOMEM);
  }
  reader.release();  // close_reader takes it back
  return 0;
}

int close_reader(AVFormatContext*, AVIOContext* stream) {
  if (stream == nullptr) return 0;
  delete static_cast<FileReader*>(stream->opaque);
  free_stream(stream);
  return 0;
}

}  // namespace

FilmFile::FilmFile(const std::string& path)
    : path_(path), file_(open(path.c_str(), O_RDWR | O_CREAT | O_TRUNC | O_CLOEXEC, 0666)) {
  if (file_ < 0)
    throw Error(ExitCode::file,
                std::string("the film cannot be written here (") + std::strerror(errno) +
                    "); choose another place with -o",
                {path});
  auto* buffer = static_cast<unsigned char*>(libav().av_malloc(kBuffer));
  if (buffer != nullptr)
    stream_ = libav().avio_alloc_context(buffer, kBuffer, 1, this, nullptr, &write, &seek);
  if (stream_ != nullptr) return;
  libav().av_free(buffer);
  ::close(file_);
  throw Error(ExitCode::limit, "no memory left for the film's file");
}

FilmFile::~FilmFile() {
  free_stream(stream_);
  if (file_ >= 0) ::close(file_);
}

void FilmFile::attach(AVFormatContext& format) {
  format.pb = stream_;
  format.flags |= AVFMT_FLAG_CUSTOM_IO;
  format.opaque = &file_;
  format.io_open = &open_reader;
  format.io_close2 = &close_reader;
}

template <class Byte>
int FilmFile::write(void* self, Byte* bytes, int count) {
  FilmFile& film = *static_cast<FilmFile*>(self);
  for (int done = 0; done < count;) {
    const ssize_t written = pwrite(film.file_, bytes + done, std::size_t(count - done), film.position_);
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) {
      if (film.trouble_ == 0) film.trouble_ = written < 0 ? errno : EIO;
      return AVERROR(film.trouble_);
    }
    done += int(written);
    film.position_ += written;
  }
  return count;
}

std::int64_t FilmFile::seek(void* self, std::int64_t offset, int whence) {
  FilmFile& film = *static_cast<FilmFile*>(self);
  const std::int64_t to = moved(film.file_, film.position_, offset, whence);
  if (to < 0 && film.trouble_ == 0) film.trouble_ = int(-to);
  if (to >= 0 && (whence & ~AVSEEK_FORCE) != AVSEEK_SIZE) film.position_ = to;
  return to;
}

int FilmFile::close() {
  libav().avio_flush(stream_);
  if (trouble_ == 0 && stream_->error < 0) trouble_ = -stream_->error;
  const int file = file_;
  file_ = -1;
  if (::close(file) != 0 && trouble_ == 0) trouble_ = errno;
  return -trouble_;
}

}  // namespace chainreel
