// Clips for pages of text: GIF with one palette, APNG. Every n-th frame, at most 25 a second, at most 800
// pixels wide, played for ever. Their texts are read by read_gif_comment and read_png_text.
#pragma once

#include <memory>
#include <string>

#include "core/frame_rate.hpp"
#include "encode/frame_sink.hpp"

namespace chainreel {

struct SmallClipSettings {
  int width = 1920;  // of the frames that come
  int height = 1080;
  FrameRate fps{};
  bool alpha = false;  // APNG alone
  Tags tags{};
};

// Keeps the frames, compressed, until finish(): the palette is known then.
class GifWriter final : public FrameSink {
 public:
  GifWriter(const std::string& path, const SmallClipSettings& settings);
  ~GifWriter() override;
  void write(const Image& frame) override;
  void finish() override;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

class ApngWriter final : public FrameSink {
 public:
  ApngWriter(const std::string& path, const SmallClipSettings& settings);
  ~ApngWriter() override;
  void write(const Image& frame) override;
  void finish() override;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace chainreel
