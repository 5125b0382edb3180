// Where frames go: films, small clips, sequences of pictures. Each frame is rasterised once and given to all.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "core/image.hpp"
#include "core/pixel_box.hpp"

namespace chainreel {

// What a file says of itself, keyword to UTF-8 text: "title", "chainreel_scene", ...
using Tags = std::map<std::string, std::string>;

class FrameSink {
 public:
  FrameSink() = default;
  virtual ~FrameSink() = default;
  FrameSink(const FrameSink&) = delete;
  FrameSink& operator=(const FrameSink&) = delete;

  // Frames in order, all of one size. `changed`: boxes without which the frame is as the one before, all within it.
  virtual void write(const Image& frame, const std::vector<PixelBox>& changed) = 0;
  // A frame that may differ everywhere.
  void write(const Image& frame) { write(frame, {{0, 0, frame.width, frame.height}}); }
  // Of small clips: whether the next frame is among those that they show; one that is not need not be drawn.
  virtual bool takes_next() const { return true; }
  virtual void skip() {}  // in the place of write() of such a frame
  virtual void finish() = 0;                   // the file is whole when this has returned
};

}  // namespace chainreel
