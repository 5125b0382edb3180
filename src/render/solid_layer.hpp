// Bodies in space drawn into a layer of their own: several samples a pixel, with depth. Needs a current
// context.
#pragma once

#include <map>
#include <memory>
#include <vector>

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

  // Marks the tiles that the bodies may touch.
  void touch(const Solids& solids, TileMask& tiles);

  // Draws what falls into the boxes, which must not be empty, and their surroundings. Leaves its own framebuffer bound,
  // and the viewport and the state of blending as they are for flat shapes.
  void draw(const Solids& solids, const std::vector<PixelBox>& boxes);

  GLuint texture() const;
  int samples() const { return samples_; }  // along a pixel's side

 private:
  struct Buffers;  // of one mesh
  struct Program;
  struct Target;

  const Buffers& buffers_of(const std::shared_ptr<const TriangleMesh>& mesh);
  std::vector<MeshBounds> bounds_of_parts(const Solids& solids);
  void clear(const std::vector<PixelBox>& boxes) const;
  enum class Pass { opaque, translucent };
  void draw_part(const Solid& solid, const Buffers& buffers, const Solids& solids, const SolidBounds& bounds,
                 Pass pass);
  static double depth_of(const Solid& solid, const Buffers& buffers);

  const GlFunctions& gl_;
  int width_, height_, samples_;
  std::unique_ptr<Program> program_;
  std::unique_ptr<Target> target_;
  std::map<const TriangleMesh*, std::unique_ptr<Buffers>> meshes_;
};

}  // namespace chainreel
