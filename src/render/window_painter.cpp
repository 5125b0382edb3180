#include "render/window_painter.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "render/lanes.hpp"

namespace chainreel {
namespace {

// A colour, red first, at a level, as a pixel: blue lowest, opacity highest.
std::uint32_t bytes_of(const float* color, float level) {
  const Float4 numbers = {color[2], color[1], color[0], color[3]};
  const Int4 bytes = rounded_to_even(255.0F * least(most(numbers * level, all4(0.0F)), all4(1.0F)));
  return std::uint32_t(bytes[0] | bytes[1] << 8 | bytes[2] << 16 | bytes[3] << 24);
}

std::uint32_t put_one(std::uint32_t above, std::uint32_t below) {
  return std::uint32_t(put_over(all4(std::int32_t(above)), all4(std::int32_t(below)))[0]);
}

PixelBox window_of(const float* instance) {
  return box_between(int(instance[0]), int(instance[1]), int(instance[2]), int(instance[3]));
}

}  // namespace

WindowPainter::WindowPainter(int width, int height, const WindowFillers& fillers)
    : width_(width), height_(height), fillers_(&fillers) {}

void WindowPainter::draw_flat(const PixelBox& box, const float* fill, std::uint32_t* page) const {
  const std::uint32_t color = bytes_of(fill, 1);
  if (color == 0) return;
  const Int4 above = all4(std::int32_t(color));
  for (int y = box.y; y < box.bottom(); ++y) {
    std::uint32_t* row = at(page, 0, y);
    int x = box.x;
    if (color >> 24 == 255) {
      std::fill(row + x, row + box.right(), color);
      continue;
    }
    for (; x + 4 <= box.right(); x += 4) store4(row + x, put_over(above, load4<Int4>(row + x)));
    for (; x < box.right(); ++x) row[x] = put_one(color, row[x]);
  }
}

void WindowPainter::set_levels(const float* fill) {
  if (std::equal(color_of_levels_.begin(), color_of_levels_.end(), fill)) return;
  std::copy(fill, fill + 4, color_of_levels_.begin());
  for (std::size_t level = 0; level < levels_.size(); ++level)
    levels_[level] = bytes_of(fill, float(level) * (1.0F / 255));
}

// The levels of the box's first pixel and what is right of it, and below it `stride` further each.
void WindowPainter::draw_levels(const PixelBox& box, const std::uint8_t* levels, std::ptrdiff_t stride,
                                std::uint32_t* page) const {
  for (int y = box.y; y < box.bottom(); ++y, levels += stride) {
    std::uint32_t* row = at(page, box.x, y);
    for (int x = 0; x < box.width; ++x)
      if (const std::uint32_t above = levels_[levels[x]]; above != 0) row[x] = put_one(above, row[x]);
  }
}

void WindowPainter::draw_glyph(const PixelBox& box, const float* numbers, const GlyphAtlas& atlas,
                               std::uint32_t* page) {
  set_levels(numbers + 8);
  const int left = box.x + int(numbers[0]) - int(numbers[4]), top = box.y + int(numbers[1]) - int(numbers[5]);
  draw_levels(box, atlas.sheet().data() + std::ptrdiff_t(top) * atlas.width() + left, atlas.width(), page);
}

void WindowPainter::draw_layer(const PixelBox& box, const float* fill, std::uint32_t* page) {
  set_levels(fill);
  draw_levels(box, trail_.data() + std::ptrdiff_t(box.y) * width_ + box.x, width_, page);
}

void WindowPainter::draw_trail(const Run& run, const Windows& windows) {
  if (trail_.empty()) trail_ = PixelBytes(std::size_t(width_) * std::size_t(height_));
  const auto row_of = [this](int y) { return trail_.data() + std::ptrdiff_t(y) * width_; };
  const int flat_floats = Windows::floats_of(Primitive::flat), floats = Windows::floats_of(Primitive::trail);
  const float* instance =
      windows.instances(Primitive::flat).data() + std::ptrdiff_t(run.first_to_clear) * flat_floats;
  for (int i = 0; i < run.count_to_clear; ++i, instance += flat_floats) {
    const PixelBox box = window_of(instance);
    for (int y = box.y; y < box.bottom(); ++y)
      std::fill(row_of(y) + box.x, row_of(y) + box.right(), std::uint8_t(0));
  }
  instance = windows.instances(Primitive::trail).data() + std::ptrdiff_t(run.first) * floats;
  for (int i = 0; i < run.count; ++i, instance += floats)
    fillers_->fill_trail(window_of(instance), instance + 4, trail_.data(), width_);
}

void WindowPainter::draw_cells(const PixelBox& box, const float* n, const CellSheet& sheet,
                               std::uint32_t* page) const {
  const float left = n[0], top = n[1], right = n[2], bottom = n[3], across = n[4], down = n[5];
  const auto cover = [](float low, float high) { return std::clamp(0.5F + std::min(low, high), 0.0F, 1.0F); };
  const auto cell = [](float place, float count) {
    return std::size_t(std::clamp(std::floor(place), 0.0F, count - 1));
  };
  for (int y = box.y; y < box.bottom(); ++y) {
    const float py = float(y) + 0.5F;
    const std::size_t row = cell(down * (py - top) / (bottom - top), down);
    for (int x = box.x; x < box.right(); ++x) {
      const float px = float(x) + 0.5F;
      const std::size_t place =
          row * std::size_t(sheet.width) + cell(across * (px - left) / (right - left), across);
      const float inside = cover(px - left, right - px) * cover(py - top, bottom - py);
      const std::uint8_t* texel = &sheet.rgba[4 * place];
      const auto level = [&](int k) { return float(texel[k]) * (1.0F / 255); };
      const float color[] = {level(0), level(1), level(2), level(3)};
      if (const std::uint32_t above = bytes_of(color, inside); above != 0)
        *at(page, x, y) = put_one(above, *at(page, x, y));
    }
  }
}

void WindowPainter::draw(const Run& run, const Windows& windows, const Batch& batch, const GlyphAtlas& atlas,
                         std::uint32_t* page) {
  if (run.primitive == Primitive::trail) return draw_trail(run, windows);
  const int floats = Windows::floats_of(run.primitive);
  const float* instance = windows.instances(run.primitive).data() + std::ptrdiff_t(run.first) * floats;
  for (int i = 0; i < run.count; ++i, instance += floats) {
    const PixelBox box = window_of(instance);
    const float* numbers = instance + 4;
    switch (run.primitive) {
      case Primitive::flat:
        draw_flat(box, numbers, page);
        break;
      case Primitive::glyph:
        draw_glyph(box, numbers, atlas, page);
        break;
      case Primitive::layer:
        draw_layer(box, numbers, page);
        break;
      case Primitive::cells:
        draw_cells(box, numbers,
                   batch.cell_sheets()[std::size_t(batch.pieces()[std::size_t(run.piece)].instance)], page);
        break;
      default:
        fillers_->fill(run.primitive, box, numbers, page, width_);
    }
  }
}

}  // namespace chainreel
