// Bodies in space drawn into a layer of their own, tile by tile where they are: several samples a pixel, with depth, which
// then become pixels of the page. Needs a current context.
#pragma once

#include <map>
#include <memory>
#include <vector>

#include "render/body_pixels.hpp"
#include "render/gl_objects.hpp"
#include "render/placed_solids.hpp"

namespace chainreel {

class SolidLayer {
 public:
  // For pages of this size.
  SolidLayer(const GlFunctions& gl, int width, int height);

  // Places the bodies, which are put down like this. Throws Error (exit 3) for a mesh that is none.
  void place(const Solids& solids, const BodyPaint& paint, PlacedSolids& placed);

  // Draws them and gives those of the boxes' tiles that show something.
  const std::vector<PixelBox>& draw(const PlacedSolids& placed, const BodyPaint& paint, const std::vector<PixelBox>& boxes);

  // What draw() has made, premultiplied, at its places on the page; elsewhere it is what was there before.
  GLuint texture() const;

 private:
  const SolidMesh& mesh_of(const std::shared_ptr<const TriangleMesh>& mesh);
  PixelBox tiles_around(const PixelBox& box, double rim) const;
  void fill(const PlacedSolids& placed, double rim, const std::vector<PixelBox>& boxes);
  void put(const PixelBox& box, const BodyPixels& pixels, BoxJoiner& shown);

  const GlFunctions& gl_;
  SampleGrid grid_;
  Target page_;  // what is put down
  TileSamples tile_;
  BodySamples samples_;
  std::vector<std::uint32_t> pixels_;
  std::vector<PixelBox> shown_;
  std::vector<std::uint8_t> is_wanted_;  // of the tiles of the samples
  std::map<const TriangleMesh*, std::unique_ptr<SolidMesh>> meshes_;
};

}  // namespace chainreel
