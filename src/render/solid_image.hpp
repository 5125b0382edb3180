// Bodies in space for vector pages: as a small picture in its place, since their light has no vector form.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "core/image.hpp"
#include "picture/picture.hpp"
#include "picture/text.hpp"
#include "render/canvas.hpp"

typedef struct _cairo_surface cairo_surface_t;  // of <cairo.h>

namespace chainreel {

struct SolidImage {
  Image pixels;  // transparent around the bodies
  Rect place;    // on the page
};

class SolidImages {
 public:
  // For a page of this aspect.
  SolidImages(double aspect, const Fonts& fonts);
  ~SolidImages();

  // As a canvas 2160 px high draws them: finer than paper shows. Nothing where nothing is seen. Throws Error
  // (exit 4) where there is no renderer.
  std::optional<SolidImage> draw(const Solids& solids);

 private:
  double aspect_;
  const Fonts& fonts_;
  std::unique_ptr<Canvas> canvas_;  // made for the first ones
};

// The caller destroys it.
cairo_surface_t* image_surface(const Image& image);
// The bytes of a PNG file.
std::string png_text(const Image& image);

}  // namespace chainreel
