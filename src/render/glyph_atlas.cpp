#include "render/glyph_atlas.hpp"

#include <ft2build.h>
#include FT_FREETYPE_H
#include FT_OUTLINE_H

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>

#include "core/error.hpp"

namespace chainreel {

// Faces of its own: FreeType's are not to be shared between threads, and every thread has its canvas.
struct GlyphAtlas::Rasteriser {
  FT_Library library = nullptr;
  std::array<FT_Face, 3> faces{};
  std::array<int, 3> sizes{};
  const Fonts& fonts;

  explicit Rasteriser(const Fonts& opened) : fonts(opened) {
    if (FT_Init_FreeType(&library) != 0) throw Error(ExitCode::no_renderer, "FreeType does not start");
  }
  Rasteriser(const Rasteriser&) = delete;
  Rasteriser& operator=(const Rasteriser&) = delete;
  ~Rasteriser() { FT_Done_FreeType(library); }

  const FT_Bitmap& draw(Face face, std::uint32_t index, int size, int step, AtlasGlyph& glyph) {
    FT_Face& ft_face = faces[std::size_t(face)];
    errno = 0;
    if (ft_face == nullptr && FT_New_Face(library, fonts.file(face).c_str(), 0, &ft_face) != 0)
      throw Error(ExitCode::no_renderer, "font file " + fonts.file(face) + " cannot be opened" +
                                             (errno != 0 ? std::string(": ") + std::strerror(errno) : ""));
    bool good = true;
    if (sizes[std::size_t(face)] != size) good = FT_Set_Char_Size(ft_face, 0, size, 72, 72) == 0;
    sizes[std::size_t(face)] = size;
    good = good && FT_Load_Glyph(ft_face, index, FT_LOAD_NO_HINTING | FT_LOAD_NO_BITMAP) == 0;
    if (good) FT_Outline_Translate(&ft_face->glyph->outline, step * 64 / kSteps, 0);
    good = good && FT_Render_Glyph(ft_face->glyph, FT_RENDER_MODE_NORMAL) == 0;
    if (!good)
      throw Error(ExitCode::no_renderer, "glyph " + std::to_string(index) + " of " + fonts.file(face) +
                                             " cannot be drawn at " + std::to_string(size / 64) + " px");
    glyph.offset_x = ft_face->glyph->bitmap_left;
    glyph.offset_y = -ft_face->glyph->bitmap_top;
    glyph.width = int(ft_face->glyph->bitmap.width);
    glyph.height = int(ft_face->glyph->bitmap.rows);
    return ft_face->glyph->bitmap;
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

const AtlasGlyph& GlyphAtlas::glyph(Face face, std::uint32_t index, int size, int step) {
  const Key key{face, index, size, step};
  if (const auto known = glyphs_.find(key); known != glyphs_.end()) return known->second;

  AtlasGlyph glyph;
  const FT_Bitmap& bitmap = rasteriser_->draw(face, index, size, step, glyph);
  place(glyph);
  for (int row = 0; row < glyph.height; ++row) {
    const std::uint8_t* source = bitmap.buffer + row * bitmap.pitch;
    std::copy_n(source, glyph.width,
                sheet_.begin() + std::ptrdiff_t(glyph.top + row) * width_ + std::ptrdiff_t(glyph.left));
  }
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
