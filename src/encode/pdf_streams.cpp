#include "encode/pdf_streams.hpp"

#include <zlib.h>

#include <algorithm>
#include <array>
#include <string_view>

namespace chainreel {
namespace {

constexpr std::size_t kMostText = std::size_t(256) << 20;  // bytes

// Adds what the data inflate to, up to the end of that stream.
void inflate_into(std::string_view data, std::string& text) {
  z_stream stream = {};
  if (inflateInit(&stream) != Z_OK) return;
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(data.data()));
  stream.avail_in = uInt(std::min<std::size_t>(data.size(), kMostText));
  std::array<char, 1 << 14> part;
  for (int status = Z_OK; status == Z_OK && text.size() < kMostText;) {
    stream.next_out = reinterpret_cast<Bytef*>(part.data());
    stream.avail_out = uInt(part.size());
    status = inflate(&stream, Z_NO_FLUSH);
    if (status == Z_OK || status == Z_STREAM_END) text.append(part.data(), part.size() - stream.avail_out);
    if (status == Z_OK && stream.avail_in == 0 && stream.avail_out > 0) break;  // cut off
  }
  inflateEnd(&stream);
}

}  // namespace

std::string objects_in_streams(const std::string& pdf) {
  constexpr std::string_view kType = "/ObjStm", kBegin = "stream\n";
  std::string text;
  for (std::size_t at = pdf.find(kType); at != std::string::npos && text.size() < kMostText; at = pdf.find(kType, at + kType.size())) {
    const std::size_t begin = pdf.find(kBegin, at);
    if (begin == std::string::npos) break;
    inflate_into(std::string_view(pdf).substr(begin + kBegin.size()), text);
    text += '\n';
  }
  return text;
}

}  // namespace chainreel
