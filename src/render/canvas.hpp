// Shapes to pixels: one off-screen OpenGL context and the shader pairs of shaders/. Not shared between
// threads.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "core/image.hpp"
#include "core/pixel_box.hpp"
#include "picture/picture.hpp"
#include "picture/text.hpp"

namespace chainreel {

struct RendererInfo {
  std::string backend;   // "OSMesa"
  std::string renderer;  // GL_RENDERER, alike on all processors
  std::string version;   // GL_VERSION
};

// Makes a context for a moment. Throws Error (exit 4) where there is none.
RendererInfo probe_renderer();

// What a canvas has drawn, and where it may differ from what it had drawn before.
struct CanvasFrame {
  Image image;
  std::vector<PixelBox> changed;  // boxes that do not overlap; the whole at first
};

class Canvas {
 public:
  // Throws Error (exit 4) where there is no OpenGL 3.3 core context, exit 7 where the size is beyond its
  // limits.
  Canvas(int width, int height, const Fonts& fonts);
  ~Canvas();
  Canvas(const Canvas&) = delete;
  Canvas& operator=(const Canvas&) = delete;

  RendererInfo info() const;

  // What does not change between frames: drawn once, copied under every later draw(). The picture's
  // background fills the page. Without a call the page is the drawn picture's own background.
  void set_static_layer(const Picture& picture);
  // Draws over the static layer and reads the pixels back. Only those tiles are drawn and read in which the picture's
  // shapes differ from those of the picture before: the bytes are the same as if all were. The frame stays the canvas's,
  // until the next call.
  const CanvasFrame& draw(const Picture& picture);
  // The same into an image of one's own.
  void draw(const Picture& picture, Image& image);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace chainreel
