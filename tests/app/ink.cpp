#include "app/ink.hpp"

#include <ft2build.h>
#include FT_FREETYPE_H
#include FT_BBOX_H

#include <algorithm>
#include <optional>

namespace chainreel::test {
namespace {

std::optional<Rect> ink_of(const Glyph& glyph, const GlyphRun& run, FT_Face face) {
  if (FT_Load_Glyph(face, glyph.index, FT_LOAD_NO_SCALE) != 0) return {};
  FT_BBox box;
  if (face->glyph->outline.n_points == 0 || FT_Outline_Get_BBox(&face->glyph->outline, &box) != 0) return {};
  const double unit = run.size / face->units_per_EM;
  const Point pen = run.origin + Point{glyph.x, glyph.y};
  return Rect{pen.x + unit * double(box.xMin), pen.y + unit * double(box.yMin),
              pen.x + unit * double(box.xMax), pen.y + unit * double(box.yMax)};
}

}  // namespace

std::vector<Written> written_on(const Picture& picture, const Fonts& fonts) {
  std::vector<Written> all;
  for (std::size_t i = 0; i < picture.items.size(); ++i) {
    const auto* run = std::get_if<GlyphRun>(&picture.items[i].shape);
    if (!run || run->color.a == 0 || run->stroke_width > 0) continue;  // a halo is below its word
    std::optional<Rect> whole;
    for (const Glyph& glyph : run->glyphs) {
      const auto ink = ink_of(glyph, *run, fonts.ft_face(run->face));
      if (!ink) continue;
      whole = !whole ? *ink
                     : Rect{std::min(whole->x0, ink->x0), std::min(whole->y0, ink->y0),
                            std::max(whole->x1, ink->x1), std::max(whole->y1, ink->y1)};
    }
    if (whole) all.push_back({*run, *whole, picture.items[i].clip, i});
  }
  return all;
}

}  // namespace chainreel::test
