// The windows of a batch, drawn by OpenGL onto a page of its own and read back. Not shared between threads.
#pragma once

#include <array>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/image.hpp"
#include "render/batch.hpp"
#include "render/canvas.hpp"
#include "render/gl_context.hpp"
#include "render/gl_objects.hpp"
#include "render/glyph_atlas.hpp"
#include "render/windows.hpp"

namespace chainreel {

RendererInfo info_of(const GlContext& context);

// Throws Error (exit 7) where no page is so large, or memory is too short for it.
void require_page(int width, int height);

// Red, green, blue and opacity of a page that shows nothing but this: multiplied by its opacity.
std::array<float, 4> cleared_to(const Color& background);

class GlPainter {
 public:
  // Throws Error (exit 4) where there is no OpenGL 3.3 core context, exit 7 where the size is beyond its
  // limits.
  GlPainter(int width, int height);
  ~GlPainter();
  GlPainter(const GlPainter&) = delete;
  GlPainter& operator=(const GlPainter&) = delete;

  // Compiles what nearly every page needs, and leaves the thread: another one may draw then.
  void get_ready();

  RendererInfo info() const;

  // Draws the windows onto a page of this colour; `draw_solids` is called for runs of bodies, and may read
  // and write.
  void draw(const Color& background, const Windows& windows, const Batch& batch, const GlyphAtlas& atlas,
            const std::function<void(const Run&)>& draw_solids);
  // Boxes of the page into the same places of an image as large as it, and from there: premultiplied.
  void read(const std::vector<PixelBox>& boxes, Image& image) const;
  void write(const std::vector<PixelBox>& boxes, const Image& image) const;

 private:
  PrimitiveProgram& program(Primitive primitive);
  void upload(const Windows& windows, const GlyphAtlas& atlas);
  void upload_cells(const CellSheet& sheet) const;
  void draw_trail(const Run& run);

  template <class Byte>
  Byte* first_byte(Byte* bytes, const PixelBox& box) const {
    return bytes + 4 * (std::ptrdiff_t(box.y) * width_ + box.x);
  }

  int width_, height_;
  std::unique_ptr<GlContext> context_;
  const GlFunctions& gl_;
  Target page_;
  std::optional<Target> trail_layer_;  // made when first used
  std::array<std::optional<PrimitiveProgram>, kPrimitives.size()> programs_;
  GLuint atlas_texture_ = 0, cell_texture_ = 0;
  int atlas_version_ = 0;
};

}  // namespace chainreel
