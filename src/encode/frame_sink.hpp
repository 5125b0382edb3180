// Where frames go: films, small clips, sequences of pictures. Each frame is rasterised once and given to all.
#pragma once

#include <map>
#include <string>

#include "core/image.hpp"

namespace chainreel {

// What a file says of itself, keyword to UTF-8 text: "title", "chainreel_scene", ...
using Tags = std::map<std::string, std::string>;

class FrameSink {
 public:
  FrameSink() = default;
  virtual ~FrameSink() = default;
  FrameSink(const FrameSink&) = delete;
  FrameSink& operator=(const FrameSink&) = delete;

  virtual void write(const Image& frame) = 0;  // frames in order, all of one size
  // Of small clips: whether the next frame is among those that they show; one that is not need not be drawn.
  virtual bool takes_next() const { return true; }
  virtual void skip() {}  // in the place of write() of such a frame
  virtual void finish() = 0;                   // the file is whole when this has returned
};

}  // namespace chainreel
