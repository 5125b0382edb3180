// Bodies where they stand on the page: their vertices placed and lit, their triangles sorted by the tiles that they meet. Needs
// no OpenGL.
#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "picture/picture.hpp"
#include "render/solid_mesh.hpp"
#include "render/tile_mask.hpp"
#include "render/tile_samples.hpp"

namespace chainreel {

// How finely a page is sampled.
struct SampleGrid {
  int width = 0, height = 0;  // of the page, px
  int cells = 1;              // along a pixel's side, each of 2 x 2 samples
  int pixels = 1;             // along a cell's side: more than one where there is one cell a pixel

  SampleGrid(int page_width, int page_height);
  // Of the same page, with cells of so many pixels: a power of two. With one it is as fine as this.
  SampleGrid coarser(int pixels) const;
  int tile_side() const { return kTileCells * pixels / cells; }  // px
  double units(double px) const { return px * cells * kCellUnits / pixels; }
  int columns() const { return (width + tile_side() - 1) / tile_side(); }
  int rows() const { return (height + tile_side() - 1) / tile_side(); }
};

// What a group of bodies has coloured, part by part, so that the next picture's can be held against it.
struct SolidTraces {
  Solids solids;
  double rim = 0;               // px
  std::vector<TileMask> tiles;  // of the page, that each part may have coloured, its line and its fringe included
};

// Marks the tiles in which two groups may differ; null stands for none.
void mark_difference(const SolidTraces* before, const SolidTraces* now, TileMask& changed);

class PlacedSolids {
 public:
  using MeshOf = std::function<const SolidMesh&(const std::shared_ptr<const TriangleMesh>&)>;

  // Replaces what was there. `rim`: how far, in px, bodies colour the page around them.
  void set(const Solids& solids, double rim, const SampleGrid& grid, const MeshOf& mesh_of);

  SolidTraces& traces() { return traces_; }
  const SolidTraces& traces() const { return traces_; }
  const SampleGrid& grid() const { return grid_; }
  // Whether a tile of the grid holds anything, and its samples.
  bool is_empty(int column, int row) const;
  void draw(int column, int row, TileSamples& samples) const;

 private:
  struct Part;
  using Triangle = std::array<std::uint32_t, 3>;  // into the vertices, clockwise

  std::size_t place(int column, int row) const { return std::size_t(row) * std::size_t(columns_) + std::size_t(column); }
  void place_vertices(const Part& part);
  // In the order in which they are drawn.
  enum Group { facing, averted, translucent };
  void add_triangles(const Part& part, std::size_t first, std::size_t end, bool is_culled);
  void add_creases(const Part& part);
  void add_clipped(const Part& part, const Triangle& corners, bool is_culled);
  void add(Triangle corners, bool is_culled, TileMask& touched);
  void add_to_tiles(const Triangle& corners, Group group, TileMask& touched);
  void mark_touched(const Triangle& corners, const PlaceRange& range, TileMask& touched);

  SolidTraces traces_;
  SampleGrid grid_{1, 1};
  int columns_ = 0, rows_ = 0;
  int rim_ = 0;  // in which pixels may be touched, in units of a cell
  int touched_side_ = 1, touched_shift_ = 0;  // of a tile of the page, in units of a cell, and its logarithm
  TileRange touched_last_;                    // of the triangle before, all marked
  std::vector<PageVertex> vertices_;
  std::vector<Triangle> triangles_;
  bool are_translucent_ = false;       // those that are added
  std::array<std::vector<std::vector<std::uint32_t>>, 3> bins_;  // of each group and tile its triangles
};

}  // namespace chainreel
