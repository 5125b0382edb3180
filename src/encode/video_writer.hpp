// Frames to MP4: H.264 High, yuv420p, BT.709 limited range and tagged, x264 veryfast CRF 18, closed GOPs of 2
// s, constant frame rate, index first. The stream does not depend on the processor or its number of cores.
#pragma once

#include <memory>
#include <string>

#include "core/frame_rate.hpp"
#include "core/image.hpp"

namespace chainreel {

struct VideoSettings {
  int width = 1920;
  int height = 1080;
  FrameRate fps{};
  double crf = 18;
};

// Throws Error (usage) with the two nearest legal sizes where a side is odd: 4:2:0 needs even sides.
void require_even_sides(int width, int height);

class VideoWriter {
 public:
  // Writes to `path` as given; the caller renames it when finish() has returned. Throws Error (exit 4: no
  // encoder, 6: cannot be written).
  VideoWriter(const std::string& path, const VideoSettings& settings);
  ~VideoWriter();
  VideoWriter(const VideoWriter&) = delete;
  VideoWriter& operator=(const VideoWriter&) = delete;

  void write(const Image& frame);  // of exactly the size in the settings
  void finish();                   // flushes the encoder and closes the file

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace chainreel
