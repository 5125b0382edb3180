// What of a batch is drawn where only some tiles of the page are to change: each instance has a window, a rectangle of
// whole pixels, and the shaders fill that. Needs no OpenGL.
#pragma once

#include <array>
#include <vector>

#include "render/batch.hpp"
#include "render/tile_mask.hpp"

namespace chainreel {

// Neighbours of one kind in painter's order.
struct Run {
  Primitive primitive = Primitive::capsule;
  int first = 0, count = 0;  // instances in the stream of windows
  int piece = 0;             // the first of them
  // Of Primitive::trail: instances of Primitive::flat that clear the trail's layer before.
  int first_to_clear = 0, count_to_clear = 0;
};

class Windows {
 public:
  static int floats_of(Primitive primitive) { return 4 + 4 * kPrimitives[std::size_t(primitive)].vectors; }

  // Replaces what was there. Of bodies there is a run without instances: where they are is known when they are drawn.
  void set(const Batch& batch, const TileMask& tiles);

  const std::vector<Run>& runs() const { return runs_; }
  // Each instance is its window (left, top, right, bottom) and then its piece's numbers.
  const std::vector<float>& instances(Primitive primitive) const { return streams_[std::size_t(primitive)]; }

 private:
  void add(int index, Primitive primitive, const float* numbers, const std::vector<PixelBox>& boxes);
  void add_inside(int index, const Piece& piece, const float* fill);
  void add_shape(const Batch& batch, int index, const TileMask& tiles);
  void find_path_area(const PixelBox& within);
  void add_path(const Batch& batch, int layer, const TileMask& tiles);

  std::vector<Run> runs_;
  std::array<std::vector<float>, kPrimitives.size()> streams_;

  std::vector<PixelBox> some_, inner_, even_, faded_;
  std::vector<PixelBox> path_windows_, path_;  // of the pieces of a path; what they fill together
};

}  // namespace chainreel
