// Bodies in space drawn into a layer of their own: several samples a pixel, with depth. Needs a current
// context.
#pragma once

#include <map>
#include <memory>
#include <optional>

#include "render/gl_context.hpp"
#include "render/solid_bounds.hpp"
#include "render/tile_mask.hpp"

namespace chainreel {

class SolidLayer {
 public:
  // For pages of this size. `largest`: the longest side of a texture.
  SolidLayer(const GlFunctions& gl, int width, int height, int largest);
  ~SolidLayer();
  SolidLayer(const SolidLayer&) = delete;
  SolidLayer& operator=(const SolidLayer&) = delete;

  // Draws what falls into `clip` and tells its pixels; nothing where there is none. Leaves its own
  // framebuffer bound, and the viewport and the state of blending as they are for flat shapes.
  std::optional<PixelBox> draw(const Solids& solids, const PixelBox& clip);

  GLuint texture() const;
  int samples() const { return samples_; }  // along a pixel's side

 private:
  struct Buffers;  // of one mesh
  struct Program;
  struct Target;

  const Buffers& buffers_of(const std::shared_ptr<const TriangleMesh>& mesh);
  void draw_part(const Solid& solid, const Buffers& buffers, const Solids& solids, const SolidBounds& bounds);

  const GlFunctions& gl_;
  int width_, height_, samples_;
  std::unique_ptr<Program> program_;
  std::unique_ptr<Target> target_;
  std::map<const TriangleMesh*, std::unique_ptr<Buffers>> meshes_;
};

}  // namespace chainreel
