// Shapes to pixels: what lies under a film by an off-screen OpenGL context and the shader pairs of shaders/, what moves over
// it, and a picture by itself, in memory, with the same bytes. Not shared between threads.
#pragma once

#include <functional>
#include <future>
#include <memory>
#include <string>
#include <vector>

#include "core/image.hpp"
#include "core/pixel_box.hpp"
#include "picture/picture.hpp"
#include "picture/text.hpp"
#include "render/gl_backend.hpp"

namespace chainreel {

struct RendererInfo {
  std::string backend;   // "OSMesa"; "none" where pages are filled in memory
  std::string renderer;  // GL_RENDERER, alike on all processors
  std::string version;   // GL_VERSION; "none"
};

// While no canvas draws by OpenGL: its libraries' code, some 60 MB, need not lie in memory.
void give_renderer_back();

// What a canvas has drawn, and where it may differ from what it had drawn before.
struct CanvasFrame {
  Image image;
  std::vector<PixelBox> changed;  // boxes that do not overlap; the whole at first
};

// What does not change between frames, drawn once: for canvases of several threads.
struct StaticLayer {
  Image pixels;      // premultiplied by their opacity
  double alpha = 1;  // of the background
};

class GlPainter;

// The renderer of pages of a size, which a thread of its own makes while other work goes on: its library takes as long to
// open as a page to be planned. Where no thread is to be had it is made by who draws with it.
class ComingRenderer {
 public:
  // Throws Error (exit 7) where no page is so large, or memory is too short for it.
  // `before`: what the thread does first, since both together would take too much address space; what it throws is thrown later.
  ComingRenderer(int width, int height, PageUse use = PageUse::film, const std::function<void()>& before = {});
  ComingRenderer(ComingRenderer&&) noexcept;
  ComingRenderer& operator=(ComingRenderer&&) noexcept;
  ~ComingRenderer();  // waits for it

  // Once; throws what made it fail. Not where pages of this use are filled in memory.
  std::unique_ptr<GlPainter> arrived();

 private:
  friend class Canvas;
  std::future<std::unique_ptr<GlPainter>> painter_;
  int width_, height_;
  PageUse use_;
};

class Canvas {
 public:
  // The first drawing throws Error (exit 4) where there is no OpenGL 3.3 core context, exit 7 where the size is beyond its
  // limits.
  Canvas(int width, int height, const Fonts& fonts, PageUse use = PageUse::film);
  Canvas(ComingRenderer renderer, const Fonts& fonts);
  // Of the layer's size, over it. Needs no OpenGL.
  Canvas(std::shared_ptr<const StaticLayer> layer, const Fonts& fonts);
  ~Canvas();
  Canvas(const Canvas&) = delete;
  Canvas& operator=(const Canvas&) = delete;

  RendererInfo info() const;

  // What does not change between frames: drawn once, copied under every later draw(). The picture's
  // background fills the page. Without a call the page is the drawn picture's own background.
  void set_static_layer(const Picture& picture);
  std::shared_ptr<const StaticLayer> static_layer() const;
  // Draws over the static layer. Only those tiles are drawn in which the picture's
  // shapes differ from those of the picture before: the bytes are the same as if all were. Without a static layer the
  // picture's own fixed items are one, and all is drawn. The frame stays the canvas's, until the next call.
  const CanvasFrame& draw(const Picture& picture);
  // The same into an image of one's own.
  void draw(const Picture& picture, Image& image);
  // The same of a canvas that is used no more: its own image, not a copy.
  Image drawn(const Picture& picture) &&;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace chainreel
