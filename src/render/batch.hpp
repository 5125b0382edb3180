// A picture's shapes as numbers for the shaders: each primitive has one stream of instances, and runs of
// equal primitives keep the painter's order. Needs no OpenGL.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>
#include <vector>

#include "picture/picture.hpp"
#include "render/glyph_atlas.hpp"
#include "render/tile_mask.hpp"

namespace chainreel {

enum class Primitive { capsule, ellipse, arc, polygon, glyph, trail, layer, cells, solids };

struct PrimitiveRow {
  std::string_view name;  // of the shader pair
  int vectors;            // vec4 per instance; their meaning stands at the head of the vertex shader
};

inline constexpr std::array<PrimitiveRow, 9> kPrimitives = {{{"capsule", 5},
                                                             {"ellipse", 4},
                                                             {"arc", 3},
                                                             {"polygon", 7},
                                                             {"glyph", 3},
                                                             {"trail", 2},
                                                             {"layer", 2},
                                                             {"cells", 2},
                                                             {"solids", 3}}};

// The colours of one Cells as a texture wants them: multiplied by their opacity, top row first.
struct CellSheet {
  int width = 0, height = 0;
  std::vector<std::uint8_t> rgba;
};

// `clip` of a trail's pieces is also the part of the layer to be cleared before; the next run colours it.
struct Run {
  Primitive primitive;
  int first = 0, count = 0;  // instances
  PixelBox clip;
};

class Batch {
 public:
  Batch(int width, int height, GlyphAtlas& atlas);

  // Replaces what was there. Shapes that are not finite or not on the page are left out. Bodies stay the picture's,
  // which must live until they are drawn.
  void set(const Picture& picture);

  const std::vector<Run>& runs() const { return runs_; }
  const std::vector<float>& instances(Primitive primitive) const { return streams_[std::size_t(primitive)]; }
  // The sheet of each instance of Primitive::cells; each is a run by itself.
  const std::vector<CellSheet>& cell_sheets() const { return cell_sheets_; }
  // The bodies of each instance of Primitive::solids, which are those of the picture; each is a run by itself.
  const std::vector<const Solids*>& solids() const { return solids_; }

 private:
  struct Vector;
  struct Pixels;  // a point in page pixels, y down

  Pixels to_pixels(Point p) const;
  PixelBox to_pixels(const Rect& rect) const;
  bool is_visible(double left, double top, double right, double bottom) const;
  bool set_paint(const Paint& paint, double& half_stroke, Vector& fill, Vector& stroke) const;
  void append(Primitive primitive, std::initializer_list<Vector> vectors);

  void add(const Capsule& capsule);
  void add(const Ellipse& ellipse);
  void add(const Arc& arc);
  void add(const Polygon& polygon);
  void add(const Trail& trail);
  void add(const GlyphRun& run);
  void add(const Cells& cells);
  void add(const Solids& solids);

  int width_, height_;
  GlyphAtlas& atlas_;
  TileMask touched_;  // by the trail being added
  std::vector<PixelBox> trail_boxes_;
  PixelBox clip_;  // of the shape being added
  std::vector<Run> runs_;
  std::vector<CellSheet> cell_sheets_;
  std::vector<const Solids*> solids_;
  std::array<std::vector<float>, kPrimitives.size()> streams_;
};

}  // namespace chainreel
