// Frames as PNG files name000000.png, name000001.png, ..; opacity is straight.
#pragma once

#include <string>

#include "encode/frame_sink.hpp"

namespace chainreel {

class PngSequence final : public FrameSink {
 public:
  // Files are `stem` and six digits in `folder`, which is there. Tags go into the first.
  PngSequence(std::string folder, std::string stem, Tags tags);
  void write(const Image& frame) override;
  void finish() override {}

  static std::string file_name(const std::string& stem, int frame);

 private:
  std::string folder_, stem_;
  Tags tags_;
  int count_ = 0;
};

}  // namespace chainreel
