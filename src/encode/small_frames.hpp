// The frames of a film that a small clip shows: every n-th, at most 25 a second, at most 800 pixels wide.
#pragma once

#include <memory>
#include <string>

#include "core/frame_rate.hpp"
#include "core/image.hpp"
#include "encode/frame_sink.hpp"

struct SwsContext;

namespace chainreel {

// What becomes of a film of this size and rate.
struct SmallSize {
  int width = 0, height = 0;  // pixels
  FrameRate fps{};
  long every = 1;  // of so many frames the first is shown

  long frames(long of_film) const { return (of_film + every - 1) / every; }
};
SmallSize small_size_of(int width, int height, FrameRate fps);

class SmallFrames {
 public:
  SmallFrames(int width, int height, FrameRate fps);
  ~SmallFrames();
  SmallFrames(const SmallFrames&) = delete;
  SmallFrames& operator=(const SmallFrames&) = delete;

  int width() const { return size_.width; }
  int height() const { return size_.height; }
  FrameRate fps() const { return size_.fps; }

  // Whether the next frame is shown.
  bool takes_next() const { return count_ % size_.every == 0; }
  void count() { ++count_; }
  // The frame at the clip's size, by the mean of the pixels that fall into one; valid until the next call.
  const Image& shrink(const Image& frame);

 private:
  int full_width_, full_height_;
  SmallSize size_;
  long count_ = 0;
  SwsContext* scaler_ = nullptr;  // none where the size stays
  Image bled_, small_;
};

// Clips for pages of text: GIF with one palette, APNG. Every n-th frame, at most 25 a second, at most 800
// pixels wide, played for ever. Their texts are read by read_gif_comment and read_png_text.

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
  using FrameSink::write;
  void write(const Image& frame, const std::vector<PixelBox>& changed) override;
  bool takes_next() const override;
  void skip() override;
  void finish() override;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

class ApngWriter final : public FrameSink {
 public:
  ApngWriter(const std::string& path, const SmallClipSettings& settings);
  ~ApngWriter() override;
  using FrameSink::write;
  void write(const Image& frame, const std::vector<PixelBox>& changed) override;
  bool takes_next() const override;
  void skip() override;
  void finish() override;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace chainreel
