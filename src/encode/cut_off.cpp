#include "encode/cut_off.hpp"

#include <bit>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <optional>

#include "core/format.hpp"

namespace chainreel {
namespace {

class Reader {
 public:
  explicit Reader(const std::string& path) : stream_(path, std::ios::binary) {
    std::error_code code;
    size_ = std::filesystem::file_size(path, code);
    if (code) size_ = 0;
  }
  std::uintmax_t size() const { return size_; }

  // A whole number with its highest byte first; none behind the end.
  std::optional<std::uint64_t> number(std::uintmax_t at, int bytes) {
    if (at + std::uintmax_t(bytes) > size_ || !stream_.seekg(std::streamoff(at))) return std::nullopt;
    std::uint64_t number = 0;
    for (int k = 0; k < bytes; ++k) number = number << 8 | std::uint64_t(stream_.get() & 0xFF);
    return stream_ ? std::optional(number) : std::nullopt;
  }

  bool ends_with(const std::string& text) {
    std::string end(text.size(), '\0');
    return size_ >= text.size() && stream_.seekg(std::streamoff(size_ - text.size())) &&
           stream_.read(end.data(), std::streamsize(end.size())) && end == text;
  }

 private:
  std::ifstream stream_;
  std::uintmax_t size_ = 0;
};

// ISO 14496-12, 4.2: each box tells its length, which 1 in its place puts behind its name.
bool ends_with_a_box(Reader& file) {
  std::uintmax_t at = 0;
  while (at < file.size()) {
    std::optional<std::uint64_t> length = file.number(at, 4);
    if (length && *length == 1) length = file.number(at + 8, 8);
    if (length && *length == 0) return true;  // up to the end
    if (!length || *length < 8 || *length > file.size() - at) return false;
    at += *length;
  }
  return at > 0;
}

// RFC 8794, 4: a name and a length, of as many bytes as their first one has zeros before its first one bit, and one more.
bool ends_with_an_element(Reader& file) {
  const auto bytes_at = [&](std::uintmax_t place) -> int {
    const auto first = file.number(place, 1);
    return first && *first != 0 ? std::countl_zero(std::uint8_t(*first)) + 1 : 0;
  };
  std::uintmax_t at = 0;
  while (at < file.size()) {
    const int name = bytes_at(at), count = name == 0 ? 0 : bytes_at(at + std::uintmax_t(name));
    const auto raw = count == 0 ? std::nullopt : file.number(at + std::uintmax_t(name), count);
    if (!raw) return false;
    const std::uint64_t unknown = (std::uint64_t(1) << (7 * count)) - 1, length = *raw & unknown;
    if (length == unknown) return true;
    at += std::uintmax_t(name + count);
    if (length > file.size() - at) return false;
    at += length;
  }
  return at > 0;
}

}  // namespace

bool is_cut_off(const std::string& path) {
  Reader file(path);
  const std::string ending = lower_case_ending(path);
  if (ending == ".mp4" || ending == ".mov") return file.size() > 0 && !ends_with_a_box(file);
  if (ending == ".webm") return file.size() > 0 && !ends_with_an_element(file);
  if (ending == ".png" || ending == ".apng") return file.size() > 0 && !file.ends_with(std::string("IEND\xAE\x42\x60\x82"));
  if (ending == ".svg") return file.size() > 0 && !file.ends_with("</svg>\n");
  return false;
}

}  // namespace chainreel
