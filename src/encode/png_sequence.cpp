#include "encode/png_sequence.hpp"

#include <filesystem>
#include <utility>

#include "encode/png.hpp"

namespace chainreel {

PngSequence::PngSequence(std::string folder, std::string stem, Tags tags)
    : folder_(std::move(folder)), stem_(std::move(stem)), tags_(std::move(tags)) {}

std::string PngSequence::file_name(const std::string& stem, int frame) {
  const std::string digits = std::to_string(frame);
  return stem + std::string(digits.size() < 6 ? 6 - digits.size() : 0, '0') + digits + ".png";
}

void PngSequence::write(const Image& frame) {
  const std::string path = (std::filesystem::path(folder_) / file_name(stem_, count_)).string();
  write_png(path, frame, count_ == 0 ? tags_ : Tags{});
  ++count_;
}

}  // namespace chainreel
