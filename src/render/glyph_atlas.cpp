#include "render/glyph_atlas.hpp"

#include <ft2build.h>
#include FT_FREETYPE_H
#include FT_GLYPH_H
#include FT_OUTLINE_H
#include FT_STROKER_H

#include <algorithm>
#include <cerrno>
#include <cstring>

#include "core/error.hpp"

namespace chainreel {

// Faces of its own: FreeType's are not to be shared between threads, and every thread has its canvas.
struct GlyphAtlas::Rasteriser {
  FT_Library library = nullptr;
  FT_Stroker stroker = nullptr;
  struct Opened {
    FT_Face face = nullptr;
    int size = 0;
  };
  std::map<Face, Opened> faces;
  const Fonts& fonts;

  explicit Rasteriser(const Fonts& opened) : fonts(opened) {
    if (FT_Init_FreeType(&library) != 0) throw Error(ExitCode::no_renderer, "FreeType does not start");
  }
  Rasteriser(const Rasteriser&) = delete;
  Rasteriser& operator=(const Rasteriser&) = delete;
  ~Rasteriser() {
    FT_Stroker_Done(stroker);
    FT_Done_FreeType(library);
  }

  // Row by row without gaps.
  std::vector<std::uint8_t> draw(Face face, std::uint32_t index, int size, int step, int stroke, AtlasGlyph& glyph) {
    auto& [ft_face, last_size] = faces[face];
    errno = 0;
    if (ft_face == nullptr && FT_New_Face(library, fonts.file(face).c_str(), fonts.index(face), &ft_face) != 0)
      throw Error(ExitCode::no_renderer, "font file " + fonts.file(face) + " cannot be opened" +
                                             (errno != 0 ? std::string(": ") + std::strerror(errno) : ""));
    bool good = true;
    if (last_size != size) good = FT_Set_Char_Size(ft_face, 0, size, 72, 72) == 0;
    last_size = size;
    good = good && FT_Load_Glyph(ft_face, index, FT_LOAD_NO_HINTING | FT_LOAD_NO_BITMAP) == 0;
    if (good) FT_Outline_Translate(&ft_face->glyph->outline, step * 64 / kSteps, 0);
    FT_Glyph shape = nullptr;
    good = good && FT_Get_Glyph(ft_face->glyph, &shape) == 0;
    if (good && stroke > 0) {
      good = stroker != nullptr || FT_Stroker_New(library, &stroker) == 0;
      if (good) FT_Stroker_Set(stroker, stroke / 2, FT_STROKER_LINECAP_ROUND, FT_STROKER_LINEJOIN_ROUND, 0);
      good = good && FT_Glyph_Stroke(&shape, stroker, 1) == 0;
    }
    good = good && FT_Glyph_To_Bitmap(&shape, FT_RENDER_MODE_NORMAL, nullptr, 1) == 0;
    const std::unique_ptr<FT_GlyphRec_, void (*)(FT_Glyph)> drawn(shape, FT_Done_Glyph);
    if (!good)
      throw Error(ExitCode::no_renderer, "glyph " + std::to_string(index) + " of " + fonts.file(face) +
                                             " cannot be drawn at " + std::to_string(size / 64) + " px");
    const auto* picture = reinterpret_cast<FT_BitmapGlyph>(drawn.get());
    glyph.offset_x = picture->left;
    glyph.offset_y = -picture->top;
    glyph.width = int(picture->bitmap.width);
    glyph.height = int(picture->bitmap.rows);
    std::vector<std::uint8_t> rows;
    for (int row = 0; row < glyph.height; ++row) {
      const std::uint8_t* source = picture->bitmap.buffer + row * picture->bitmap.pitch;
      rows.insert(rows.end(), source, source + glyph.width);
    }
    return rows;
  }
};

namespace {
constexpr int kFirstSide = 512;
constexpr int kTrimSide =
    4096;  // 16 MB: more than any film's text needs, unless its sizes change all the time
}  // namespace

GlyphAtlas::GlyphAtlas(const Fonts& fonts, int largest_side)
    : rasteriser_(std::make_unique<Rasteriser>(fonts)), largest_side_(largest_side) {
  grow(kFirstSide, kFirstSide);
}

GlyphAtlas::~GlyphAtlas() = default;

const AtlasGlyph& GlyphAtlas::glyph(Face face, std::uint32_t index, int size, int step, int stroke) {
  const Key key{face, index, size, step, stroke};
  if (const auto known = glyphs_.find(key); known != glyphs_.end()) return known->second;

  AtlasGlyph glyph;
  const std::vector<std::uint8_t> rows = rasteriser_->draw(face, index, size, step, stroke, glyph);
  place(glyph);
  for (int row = 0; row < glyph.height; ++row)
    std::copy_n(rows.begin() + std::ptrdiff_t(row) * glyph.width, glyph.width,
                sheet_.begin() + std::ptrdiff_t(glyph.top + row) * width_ + std::ptrdiff_t(glyph.left));
  ++version_;
  return glyphs_.emplace(key, glyph).first->second;
}

void GlyphAtlas::place(AtlasGlyph& glyph) {
  if (glyph.width > width_) grow(glyph.width, height_);
  if (shelf_x_ + glyph.width > width_) {
    shelf_y_ += shelf_height_;
    shelf_x_ = shelf_height_ = 0;
  }
  if (shelf_y_ + glyph.height > height_) grow(width_, std::max(2 * height_, shelf_y_ + glyph.height));
  glyph.left = shelf_x_;
  glyph.top = shelf_y_;
  shelf_x_ += glyph.width;
  shelf_height_ = std::max(shelf_height_, glyph.height);
}

void GlyphAtlas::grow(int width, int height) {
  if (width > largest_side_ || height > largest_side_)
    throw Error(ExitCode::limit, "the picture's text needs more than " + std::to_string(largest_side_) +
                                     " px of glyphs; use smaller or fewer sizes of text");
  std::vector<std::uint8_t> sheet(std::size_t(width) * std::size_t(height));
  for (int row = 0; row < height_; ++row)
    std::copy_n(sheet_.begin() + std::ptrdiff_t(row) * width_, width_,
                sheet.begin() + std::ptrdiff_t(row) * width);
  sheet_ = std::move(sheet);
  width_ = width;
  height_ = height;
  ++version_;
}

void GlyphAtlas::trim() {
  if (height_ < kTrimSide && width_ < kTrimSide) return;
  glyphs_.clear();
  shelf_x_ = shelf_y_ = shelf_height_ = 0;
  width_ = height_ = 0;
  grow(kFirstSide, kFirstSide);
}

}  // namespace chainreel
