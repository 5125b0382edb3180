// Bodies in space drawn into a layer of their own, no larger than they are: several samples a pixel, with depth, which
// then become pixels of the page. Needs a current context.
#pragma once

#include <map>
#include <memory>
#include <vector>

#include "render/body_pixels.hpp"
#include "render/gl_objects.hpp"
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

  // Draws them and gives those of the boxes' tiles that show something. Leaves its own framebuffer bound, and the viewport
  // and the state of blending as they are for flat shapes.
  const std::vector<PixelBox>& draw(const Solids& solids, const BodyPaint& paint, const std::vector<PixelBox>& boxes);

  // What draw() has made, premultiplied, at its places on the page; elsewhere it is what was there before.
  GLuint texture() const;

 private:
  struct Buffers;  // of one mesh
  struct Program;
  struct SampleTarget;

  const Buffers& buffers_of(const std::shared_ptr<const TriangleMesh>& mesh);
  std::vector<MeshBounds> bounds_of_parts(const Solids& solids);
  PixelBox pixels_of(const SolidBounds& bounds) const;
  PixelBox frame_of(const SolidBounds& bounds) const;
  void begin(const PixelBox& frame);
  void read(const PixelBox& frame, const PixelBox& wanted);
  void put(const PixelBox& box, const BodyPixels& pixels, BoxJoiner& shown);
  enum class Pass { opaque, translucent };
  void draw_part(const Solid& solid, const Buffers& buffers, const Solids& solids, const SolidBounds& bounds,
                 const PixelBox& frame, Pass pass);
  void draw_parts(const Solids& solids, const SolidBounds& bounds, const PixelBox& frame);
  static double depth_of(const Solid& solid, const Buffers& buffers);

  const GlFunctions& gl_;
  int width_, height_, samples_, largest_;
  std::unique_ptr<Program> program_;
  std::unique_ptr<SampleTarget> target_;             // grows with the bodies
  Target page_;                     // what is put down
  BodySamples read_;
  std::vector<std::uint8_t> rgba_;
  std::vector<PixelBox> shown_;
  std::map<const TriangleMesh*, std::unique_ptr<Buffers>> meshes_;
};

}  // namespace chainreel
