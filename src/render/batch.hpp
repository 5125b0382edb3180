// A picture's shapes as numbers for the shaders, one piece a shape that is drawn by itself, in painter's order. Needs
// no OpenGL.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>
#include <vector>

#include "picture/picture.hpp"
#include "render/glyph_atlas.hpp"
#include "render/outline.hpp"

namespace chainreel {

enum class Primitive { capsule, ellipse, arc, polygon, glyph, trail, layer, cells, solids, flat, faded };

struct PrimitiveRow {
  std::string_view name;  // of the shader pair; bodies in space have none
  int vectors;            // vec4 per instance; their meaning stands at the head of the vertex shader
};

inline constexpr std::array<PrimitiveRow, 11> kPrimitives = {{{"capsule", 5},
                                                              {"ellipse", 6},
                                                              {"arc", 3},
                                                              {"polygon", 9},
                                                              {"glyph", 3},
                                                              {"trail", 2},
                                                              {"layer", 1},
                                                              {"cells", 2},
                                                              {"solids", 2},
                                                              {"flat", 1},
                                                              {"faded", 3}}};

// Where among the numbers of a primitive that may fill evenly its fill stands, premultiplied, and behind it how that
// fades: the numbers of Primitive::flat and of Primitive::faded. 0 for all others.
constexpr int place_of_fill(Primitive primitive) {
  switch (primitive) {
    case Primitive::ellipse:
      return 12;
    case Primitive::polygon:
      return 24;
    default:
      return 0;
  }
}

// The colours of one Cells as a texture wants them: multiplied by their opacity, top row first.
struct CellSheet {
  int width = 0, height = 0;
  std::vector<std::uint8_t> rgba;
};

struct Piece {
  Primitive primitive = Primitive::capsule;
  int instance = 0;      // in the stream of its primitive
  int first_of_path = 0;  // of Primitive::layer: it colours what the pieces from this one on have drawn
  PixelBox unfaded{};    // of what may fill evenly: where it does
  Outline outline;       // of solids just its box: they are looked at when they are drawn
  std::uint64_t look = 0;  // equal for pieces that colour the page alike
};

class Batch {
 public:
  Batch(int width, int height, GlyphAtlas& atlas);

  // Replaces what was there. Shapes that are not finite or not on the page are left out. Bodies stay the picture's,
  // which must live until they are drawn.
  void set(const Picture& picture);

  const std::vector<Piece>& pieces() const { return pieces_; }
  // Its vectors, kPrimitives[..].vectors times four numbers.
  const float* numbers(const Piece& piece) const;
  // By instance.
  const std::vector<CellSheet>& cell_sheets() const { return cell_sheets_; }
  const std::vector<const Solids*>& solids() const { return solids_; }

 private:
  struct Vector;
  struct Pixels;  // a point in page pixels, y down
  struct Fading;

  Pixels to_pixels(Point p) const;
  PixelBox to_pixels(const Rect& rect) const;
  Fading to_pixels(const Fade& fade) const;
  PixelBox visible_box(double left, double top, double right, double bottom) const;
  bool set_paint(const Paint& paint, double& half_stroke, Vector& fill, Vector& stroke) const;
  Piece& append(Primitive primitive, const Outline& outline, std::initializer_list<Vector> vectors);

  void add(const Capsule& capsule);
  void add(const Ellipse& ellipse);
  void add(const Arc& arc);
  void add(const Polygon& polygon);
  void add(const Trail& trail);
  void add(const GlyphRun& run);
  void add(const Cells& cells);
  void add(const Solids& solids);

  int width_, height_;
  GlyphAtlas* atlas_;  // so that batches can be swapped
  PixelBox clip_;  // of the shape being added
  std::vector<Piece> pieces_;
  std::vector<CellSheet> cell_sheets_;
  std::vector<const Solids*> solids_;
  std::array<std::vector<float>, kPrimitives.size()> streams_;
};

}  // namespace chainreel
