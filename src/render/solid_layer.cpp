#include "render/solid_layer.hpp"

#include <algorithm>
#include <cmath>

#include "render/soft_shadow.hpp"

namespace chainreel {

SolidLayer::SolidLayer(int width, int height) : grid_(width, height) {}

const SolidMesh& SolidLayer::mesh_of(const std::shared_ptr<const TriangleMesh>& mesh) {
  std::unique_ptr<SolidMesh>& own = meshes_[mesh.get()];
  if (!own) own = std::make_unique<SolidMesh>(mesh);
  return *own;
}

void SolidLayer::place(const Solids& solids, const BodyPaint& paint, PlacedSolids& placed) {
  const ShadowBlur blur(paint.radius);
  placed.set(solids, paint.is_shadow ? blur.rim() : paint.radius, paint.is_shadow ? grid_.coarser(blur.pixels) : grid_,
             [this](const auto& mesh) -> const SolidMesh& { return mesh_of(mesh); });
}

// The whole tiles that meet a box, or what is near to it.
PixelBox SolidLayer::tiles_around(const PixelBox& box, double rim, const SampleGrid& grid) {
  const int side = grid.tile_side(), by = rim > 0 ? int(std::ceil(rim)) + 1 : 0;
  const auto first = [&](int pixel) { return std::max(0, pixel - by) / side * side; };
  const auto behind = [&](int pixel, int count) { return std::min((pixel + by + side - 1) / side, count) * side; };
  return box_between(first(box.x), first(box.y), behind(box.right(), grid.columns()), behind(box.bottom(), grid.rows()));
}

// Samples of the tiles whose bodies, or what is around them, may colour the boxes.
void SolidLayer::fill(const PlacedSolids& placed, double rim, const std::vector<PixelBox>& boxes) {
  const SampleGrid& grid = placed.grid();
  const int side = grid.tile_side(), side_there = side / grid.pixels;
  const bool is_shadow = placed.traces().solids.is_shadow;  // of which only how much is covered is asked
  const PixelBox all = tiles_around(box_around(boxes), rim, grid);
  samples_.reset({all.x / grid.pixels, all.y / grid.pixels, all.width / grid.pixels, all.height / grid.pixels}, 2 * grid.cells);
  const int columns = all.width / side;
  is_wanted_.assign(std::size_t(columns) * std::size_t(all.height / side), 0);
  for (const PixelBox& box : boxes) {
    const PixelBox around = tiles_around(box, rim, grid);
    for (int y = around.y; y < around.bottom(); y += side)
      for (int x = around.x; x < around.right(); x += side)
        is_wanted_[std::size_t((y - all.y) / side) * std::size_t(columns) + std::size_t((x - all.x) / side)] = 1;
  }
  for (int row = 0; row < all.height / side; ++row)
    for (int column = 0; column < columns; ++column) {
      const int x = all.x / side + column, y = all.y / side + row;
      if (is_wanted_[std::size_t(row) * std::size_t(columns) + std::size_t(column)] == 0 || placed.is_empty(x, y)) continue;
      tile_.clear();
      placed.draw(x, y, tile_);
      const int width = samples_.box.width;
      tile_.resolve(grid.cells, &samples_.pixels[std::size_t(row * side_there) * std::size_t(width) + std::size_t(column * side_there)], width,
                    is_shadow ? nullptr : &samples_.bits[std::size_t(row * 2 * kTileCells) * std::size_t(columns) + std::size_t(column)], columns);
    }
}

// The tiles of a box that show something.
void SolidLayer::find_shown(const PixelBox& box, const BodyPixels& pixels, BoxJoiner& shown) const {
  const int side = grid_.tile_side();
  for (int top = box.y / side * side; top < box.bottom(); top += side)
    for (int left = box.x / side * side; left < box.right(); left += side)
      if (const PixelBox tile{left, top, side, side}; !pixels.is_empty(tile)) shown.add(common_part(box, tile));
}

void SolidLayer::draw(const PlacedSolids& placed, const BodyPaint& paint, const std::vector<PixelBox>& boxes, std::uint32_t* page) {
  fill(placed, paint.is_shadow ? ShadowBlur(paint.radius).rim() : paint.radius, boxes);
  if (!paint.is_shadow) return draw_bodies(paint, boxes, page);
  const SoftShadow shadow(samples_, paint);
  for (const PixelBox& box : boxes)
    shadow.draw_over(box, page + std::ptrdiff_t(box.y) * grid_.width + box.x, grid_.width);
}

void SolidLayer::draw_bodies(const BodyPaint& paint, const std::vector<PixelBox>& boxes, std::uint32_t* page) {
  samples_.cut_at(grid_.width, grid_.height);
  const BodyPixels pixels(samples_, paint);
  shown_.clear();
  BoxJoiner shown(shown_);
  for (const PixelBox& box : boxes) find_shown(box, pixels, shown);
  for (const PixelBox& box : shown_)
    pixels.draw_over(box, page + std::ptrdiff_t(box.y) * grid_.width + box.x, grid_.width);
}

}  // namespace chainreel
