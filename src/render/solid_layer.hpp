// Bodies in space, drawn tile by tile where they are: several samples a pixel, with depth, which then become pixels that are
// put down on the page.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <vector>

#include "render/body_pixels.hpp"
#include "render/placed_solids.hpp"
#include "render/tile_mask.hpp"

namespace chainreel {

class SolidLayer {
 public:
  // For pages of this size.
  SolidLayer(int width, int height);

  // Places the bodies, which are put down like this. Throws Error (exit 3) for a mesh that is none.
  void place(const Solids& solids, const BodyPaint& paint, PlacedSolids& placed);

  // Draws what of them lies in the boxes over the page, premultiplied, blue in the lowest byte.
  void draw(const PlacedSolids& placed, const BodyPaint& paint, const std::vector<PixelBox>& boxes, std::uint32_t* page);

 private:
  const SolidMesh& mesh_of(const std::shared_ptr<const TriangleMesh>& mesh);
  static PixelBox tiles_around(const PixelBox& box, double rim, const SampleGrid& grid);
  void fill(const PlacedSolids& placed, double rim, const std::vector<PixelBox>& boxes);
  void draw_bodies(const BodyPaint& paint, const std::vector<PixelBox>& boxes, std::uint32_t* page);
  void find_shown(const PixelBox& box, const BodyPixels& pixels, BoxJoiner& shown) const;

  SampleGrid grid_;
  TileSamples tile_;
  BodySamples samples_;
  std::vector<PixelBox> shown_;
  std::vector<std::uint8_t> is_wanted_;  // of the tiles of the samples
  std::map<const TriangleMesh*, std::unique_ptr<SolidMesh>> meshes_;
};

}  // namespace chainreel
