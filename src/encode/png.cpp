// libpng reports errors by longjmp, which must not pass over an object with a destructor: the functions that
// call setjmp hold plain numbers and pointers only, and what needs a destructor lives in their callers.
#include "encode/png.hpp"

#include <png.h>
#include <zlib.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <csetjmp>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "core/error.hpp"
#include "encode/usual_png.hpp"

namespace chainreel {
namespace {

// Drawn pictures are flat: without a filter they compress as well as with libpng's choice of one per row, in
// half of the time (32 ms against 65 ms for a frame of 1920x1080).
constexpr int kCompressionLevel = 6;
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

std::vector<png_text> text_chunks(const std::map<std::string, std::string>& text, const std::string& path) {
  std::vector<png_text> chunks;
  for (const auto& [keyword, value] : text) {
    if (keyword.empty() || keyword.size() > kLongestKeyword || !is_ascii(keyword))
      throw Error(ExitCode::usage, "'" + keyword + "' cannot name a text in a PNG: 1 to 79 ASCII letters",
                  {path});
    png_text chunk{};
    chunk.compression =
        is_ascii(value) ? PNG_TEXT_COMPRESSION_NONE : PNG_ITXT_COMPRESSION_NONE;  // tEXt is Latin-1
    chunk.key = const_cast<png_charp>(keyword.c_str());                           // libpng only reads them
    chunk.text = const_cast<png_charp>(value.c_str());
    chunks.push_back(chunk);
  }
  return chunks;
}

bool write_chunks(png_structp png, png_infop info, std::FILE* file, const Image& image, bool opaque,
                  const std::vector<png_text>& text) {
  if (setjmp(png_jmpbuf(png))) return false;
  png_init_io(png, file);
  png_set_compression_level(png, kCompressionLevel);
  png_set_filter(png, PNG_FILTER_TYPE_BASE, PNG_FILTER_NONE);
  png_set_IHDR(png, info, png_uint_32(image.width), png_uint_32(image.height), 8,
               opaque ? PNG_COLOR_TYPE_RGB : PNG_COLOR_TYPE_RGBA, PNG_INTERLACE_NONE,
               PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
  if (!text.empty()) png_set_text(png, info, text.data(), int(text.size()));
  png_write_info(png, info);
  png_set_bgr(png);
  if (opaque) png_set_filler(png, 0, PNG_FILLER_AFTER);
  for (int y = 0; y < image.height; ++y)
    png_write_row(png, &image.bgra[std::size_t(4) * std::size_t(image.width) * std::size_t(y)]);
  png_write_end(png, nullptr);
  return true;
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

void write_png(const std::string& path, const Image& image, const std::map<std::string, std::string>& text) {
  if (image.width <= 0 || image.height <= 0) throw Error(ExitCode::usage, "a picture without pixels", {path});
  const std::vector<png_text> chunks = text_chunks(text, path);
  FilePtr file(std::fopen(path.c_str(), "wb"));
  if (!file)
    throw Error(ExitCode::file, std::string("cannot be written here (") + std::strerror(errno) + ")", {path});

  Message message;
  png_structp png =
      png_create_write_struct(PNG_LIBPNG_VER_STRING, &message, keep_message_and_jump, ignore_warning);
  png_infop info = png == nullptr ? nullptr : png_create_info_struct(png);
  const bool written =
      info != nullptr && write_chunks(png, info, file.get(), image, image.is_opaque(), chunks);
  png_destroy_write_struct(&png, &info);

  // A full disk may show itself only when the last buffer is handed over.
  const bool closed = std::fclose(file.release()) == 0;
  if (written && closed) return;
  const std::string reason = written ? std::strerror(errno) : message.text.data();
  throw Error(ExitCode::file, "could not be written whole (" + reason + "): is the disk full?", {path});
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
  const auto number = [](unsigned long value) {
    std::string bytes;
    for (int shift = 24; shift >= 0; shift -= 8) bytes += char((value >> shift) & 0xff);
    return bytes;
  };
  std::string chunks;
  for (const auto& [keyword, value] : text) {
    const std::string data = keyword + '\0' + value, named = "tEXt" + data;
    chunks += number(data.size()) + named +
              number(crc32(0, reinterpret_cast<const Bytef*>(named.data()), uInt(named.size())));
  }
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
