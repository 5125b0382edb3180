// libpng reports errors by longjmp, which must not pass over an object with a destructor: the functions that
// call setjmp hold plain numbers and pointers only, and what needs a destructor lives in their callers.
#include "encode/png.hpp"

#include <libdeflate.h>
#include <png.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cmath>
#include <csetjmp>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <memory>
#include <new>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include "core/error.hpp"
#include "core/large_memory.hpp"
#include "encode/usual_png.hpp"

namespace chainreel {
namespace {

// Drawn pictures are flat: without a filter they compress as well as with a choice of one per row, in less time. libdeflate
// takes 11 and 14 ms for two pictures of 1920x1080 at this level (in a plane, in space) and writes 24.3 and 155.6 kB; zlib
// took 21 and 31 ms for 25.6 and 157.6 kB at its level 6.
constexpr int kCompressionLevel = 5;
constexpr std::size_t kLongestKeyword = 79;  // PNG specification, 11.3.4.2
constexpr png_uint_32 kLargestPng = 32768;

struct CloseFile {
  void operator()(std::FILE* file) const { std::fclose(file); }
};
using FilePtr = std::unique_ptr<std::FILE, CloseFile>;

struct Message {
  std::array<char, 256> text{};
};

[[noreturn]] void keep_message_and_jump(png_structp png, png_const_charp text) {
  Message* message = static_cast<Message*>(png_get_error_ptr(png));
  std::strncpy(message->text.data(), text, message->text.size() - 1);
  png_longjmp(png, 1);
}

void ignore_warning(png_structp, png_const_charp) {}

bool is_ascii(const std::string& text) {
  return std::all_of(text.begin(), text.end(), [](char c) { return static_cast<unsigned char>(c) < 128; });
}

std::string big_endian(std::size_t value) {
  std::string bytes;
  for (int shift = 24; shift >= 0; shift -= 8) bytes += char((value >> shift) & 0xff);
  return bytes;
}

void append_chunk(std::string& png, const std::string& type, std::string_view data) {
  png += big_endian(data.size()) + type;
  png += data;
  const auto named = libdeflate_crc32(0, type.data(), type.size());
  // Of no bytes at a null pointer, libdeflate would give the start of a checksum instead.
  png += big_endian(data.empty() ? named : libdeflate_crc32(named, data.data(), data.size()));
}

void append_text_chunks(std::string& png, const std::map<std::string, std::string>& text, const std::string& path) {
  for (const auto& [keyword, value] : text) {
    if (keyword.empty() || keyword.size() > kLongestKeyword || !is_ascii(keyword))
      throw Error(ExitCode::usage, "'" + keyword + "' cannot name a text in a PNG: 1 to 79 ASCII letters",
                  {path});
    const std::string behind_keyword(1, '\0');
    if (is_ascii(value))
      append_chunk(png, "tEXt", keyword + behind_keyword + value);  // that is Latin-1
    else  // not compressed, of no language
      append_chunk(png, "iTXt", keyword + behind_keyword + std::string(4, '\0') + value);
  }
}

// Rows as PNG has them: no filter, then red, green, blue and, unless all is opaque, opacity.
struct Rows {
  RawBytes bytes;
  std::size_t size;
};

Rows rows_of(const Image& image, bool opaque) {
  const std::size_t width = std::size_t(image.width), height = std::size_t(image.height), channels = opaque ? 3 : 4;
  const std::size_t size = height * (1 + channels * width);
  Rows rows{RawBytes(size + 1), size};  // one byte behind it is written, too
  std::uint8_t* to = rows.bytes.get();
  const std::uint8_t* from = image.bgra.data();
  for (std::size_t y = 0; y < height; ++y) {
    *to++ = 0;
    // Four bytes at once; of three channels the next pixel is written over the last one.
    for (std::size_t x = 0; x < width; ++x, from += 4, to += channels) {
      std::uint32_t bgra;
      std::memcpy(&bgra, from, 4);
      const std::uint32_t rgba = (bgra & 0xff00ff00u) | ((bgra >> 16) & 0xffu) | ((bgra & 0xffu) << 16);
      std::memcpy(to, &rgba, 4);
    }
  }
  return rows;
}

std::string compressed(const Rows& rows) {
  const std::unique_ptr<libdeflate_compressor, decltype(&libdeflate_free_compressor)> compressor(
      libdeflate_alloc_compressor(kCompressionLevel), libdeflate_free_compressor);
  if (!compressor) throw std::bad_alloc();
  const std::size_t most = libdeflate_zlib_compress_bound(compressor.get(), rows.size);
  const std::unique_ptr<char[]> room(new char[most]);  // what is not written takes no memory
  return {room.get(), libdeflate_zlib_compress(compressor.get(), rows.bytes.get(), rows.size, room.get(), most)};
}

std::string file_of(const Image& image, const std::map<std::string, std::string>& text, const std::string& path,
                    double per_metre) {
  const bool opaque = image.is_opaque();
  std::string png = "\x89PNG\r\n\x1a\n";
  const std::string depth_and_kind = {8, char(opaque ? PNG_COLOR_TYPE_RGB : PNG_COLOR_TYPE_RGBA), 0, 0, 0};
  append_chunk(png, "IHDR", big_endian(std::size_t(image.width)) + big_endian(std::size_t(image.height)) + depth_and_kind);
  if (per_metre > 0) {
    const std::string both = big_endian(std::size_t(std::lround(per_metre)));
    append_chunk(png, "pHYs", both + both + '\x01');
  }
  append_text_chunks(png, text, path);
  if (!text.empty()) append_text_chunks(png, {{kPixels, pixels_checksum(image)}}, path);
  // Chunks of 2^31 bytes and more are not allowed.
  const std::string pixels = compressed(rows_of(image, opaque));
  constexpr std::size_t kLargestChunk = std::size_t(1) << 30;
  for (std::size_t at = 0; at < pixels.size(); at += kLargestChunk)
    append_chunk(png, "IDAT", std::string_view(pixels).substr(at, kLargestChunk));
  append_chunk(png, "IEND", {});
  return png;
}

struct PngHandles {
  png_structp png = nullptr;
  png_infop info = nullptr;
  ~PngHandles() { png_destroy_read_struct(&png, &info, nullptr); }
};

bool read_until_pixels(png_structp png, png_infop info, std::FILE* file) {
  if (setjmp(png_jmpbuf(png))) return false;
  png_init_io(png, file);
  png_read_info(png, info);
  return true;
}

FilePtr open_for_reading(const std::string& path) {
  FilePtr file(std::fopen(path.c_str(), "rb"));
  if (!file) throw Error(ExitCode::bad_input, std::string("cannot be read: ") + std::strerror(errno), {path});
  return file;
}

}  // namespace

std::string pixels_checksum(const Image& image) {
  const std::string size = big_endian(std::size_t(image.width)) + big_endian(std::size_t(image.height));
  const auto of_size = libdeflate_crc32(0, size.data(), size.size());
  std::array<char, 9> digits{};
  std::snprintf(digits.data(), digits.size(), "%08x", unsigned(libdeflate_crc32(of_size, image.bgra.data(), image.bgra.size())));
  return digits.data();
}

void write_png(const std::string& path, const Image& image, const std::map<std::string, std::string>& text,
               double per_metre) {
  if (image.width <= 0 || image.height <= 0) throw Error(ExitCode::usage, "a picture without pixels", {path});
  const std::string png = file_of(image, text, path, per_metre);
  FilePtr file(std::fopen(path.c_str(), "wb"));
  if (!file)
    throw Error(ExitCode::file, std::string("cannot be written here (") + std::strerror(errno) + ")", {path});
  const bool written = std::fwrite(png.data(), 1, png.size(), file.get()) == png.size();
  const int refused = errno;
  // A full disk may show itself only when the last buffer is handed over.
  const bool closed = std::fclose(file.release()) == 0;
  if (written && closed) return;
  throw Error(ExitCode::file,
              std::string("could not be written whole (") + std::strerror(written ? errno : refused) + "): is the disk full?",
              {path});
}

// libpng's simplified writer keeps its errors in `png.message`; nothing jumps.
std::string png_bytes(const Image& image) {
  png_image png{};
  png.version = PNG_IMAGE_VERSION;
  png.width = png_uint_32(image.width);
  png.height = png_uint_32(image.height);
  png.format = PNG_FORMAT_BGRA;
  png_alloc_size_t size = 0;
  std::string bytes;
  // Asked for its size first, then for the bytes.
  for (int round = 0; round < 2; ++round) {
    bytes.resize(size);
    if (png_image_write_to_memory(&png, round == 0 ? nullptr : bytes.data(), &size, 0, image.bgra.data(), 0,
                                  nullptr) == 0)
      throw Error(ExitCode::limit, std::string("a picture cannot be written as PNG: ") + png.message);
  }
  bytes.resize(size);
  return bytes;
}

std::string with_png_text(std::string png, const std::map<std::string, std::string>& text) {
  constexpr std::size_t kBehindHeader = 8 + 25;  // the signature and IHDR, which is the first chunk
  std::string chunks;
  for (const auto& [keyword, value] : text) append_chunk(chunks, "tEXt", keyword + '\0' + value);
  return png.insert(std::min(kBehindHeader, png.size()), chunks);
}

Image decode_png(std::string_view bytes, const std::string& path) {
  if (std::optional<Image> usual = decode_usual_png(bytes)) return std::move(*usual);
  // libpng's simplified reader keeps its errors in `png.message`; nothing jumps.
  png_image png{};
  png.version = PNG_IMAGE_VERSION;
  const auto fail = [&] {
    const std::string reason = png.message;
    png_image_free(&png);
    throw Error(ExitCode::bad_input, "is not a PNG that can be read: " + reason, {path});
  };
  if (png_image_begin_read_from_memory(&png, bytes.data(), bytes.size()) == 0) fail();
  if (png.width > kLargestPng || png.height > kLargestPng) {
    png_image_free(&png);
    throw Error(ExitCode::limit, "is larger than 32768 pixels a side", {path});
  }
  png.format = PNG_FORMAT_BGRA;
  // Without this libpng takes 16 bits for light, not for what a screen is given, and the same picture becomes another one.
  png.flags |= PNG_IMAGE_FLAG_16BIT_sRGB;
  Image image(int(png.width), int(png.height));
  if (png_image_finish_read(&png, nullptr, image.bgra.data(), 0, nullptr) == 0) fail();
  return image;
}

Image read_png(const std::string& path) {
  const FilePtr file = open_for_reading(path);
  std::string bytes;
  std::array<char, 1 << 16> block;
  while (const std::size_t count = std::fread(block.data(), 1, block.size(), file.get()))
    bytes.append(block.data(), count);
  if (std::ferror(file.get()) != 0)
    throw Error(ExitCode::bad_input, std::string("cannot be read: ") + std::strerror(errno), {path});
  return decode_png(bytes, path);
}

std::map<std::string, std::string> read_png_text(const std::string& path) {
  const FilePtr file = open_for_reading(path);
  Message message;
  PngHandles reader;
  reader.png = png_create_read_struct(PNG_LIBPNG_VER_STRING, &message, keep_message_and_jump, ignore_warning);
  reader.info = reader.png == nullptr ? nullptr : png_create_info_struct(reader.png);
  if (reader.info == nullptr || !read_until_pixels(reader.png, reader.info, file.get()))
    throw Error(ExitCode::bad_input, std::string("is not a PNG that can be read: ") + message.text.data(),
                {path});
  std::map<std::string, std::string> text;
  png_textp chunks = nullptr;
  int count = 0;
  png_get_text(reader.png, reader.info, &chunks, &count);
  for (int i = 0; i < count; ++i) text[chunks[i].key] = chunks[i].text;
  return text;
}

PngSequence::PngSequence(std::string folder, std::string stem, Tags tags, int first)
    : folder_(std::move(folder)), stem_(std::move(stem)), tags_(std::move(tags)), next_(first) {}

std::string PngSequence::file_name(const std::string& stem, int frame) {
  const std::string digits = std::to_string(frame);
  return stem + std::string(digits.size() < 6 ? 6 - digits.size() : 0, '0') + digits + ".png";
}

void PngSequence::write(const Image& frame, const std::vector<PixelBox>&) {
  const std::string path = (std::filesystem::path(folder_) / file_name(stem_, next_)).string();
  write_png(path, frame, next_ == 0 ? tags_ : Tags{});
  ++next_;
}

}  // namespace chainreel
