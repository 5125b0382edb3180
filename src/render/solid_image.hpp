// Bodies in space for vector pages: as a small picture in its place, since their light has no vector form.
#pragma once

#include <optional>
#include <string>

#include "core/image.hpp"
#include "picture/picture.hpp"
#include "picture/text.hpp"

typedef struct _cairo_surface cairo_surface_t;  // of <cairo.h>

namespace chainreel {

struct SolidImage {
  Image pixels;  // transparent around the bodies
  Rect place;    // on the page
};

// As the canvas draws them on a page of this aspect, 2160 px high: finer than paper shows. Nothing where
// nothing is seen. Throws Error (exit 4) where there is no renderer.
std::optional<SolidImage> solid_image(const Solids& solids, double aspect, const Fonts& fonts);

// The caller destroys it.
cairo_surface_t* image_surface(const Image& image);
// The bytes of a PNG file.
std::string png_text(const Image& image);

}  // namespace chainreel
