// Shapes by Cairo: the same list as for the canvas, on any of Cairo's surfaces.
#pragma once

#include <string>

#include "picture/text.hpp"
#include "render/vector_shapes.hpp"

typedef struct _cairo cairo_t;  // of <cairo.h>, which no other floor sees

namespace chainreel {

// Background and shapes; `height` of the page in the units of the surface, upper left corner at the origin.
// Throws Error (exit 4) where Cairo fails.
void paint_with_cairo(cairo_t* cairo, const Picture& picture, const Fonts& fonts, double height);

// A page of one picture with selectable text; the bytes of a PDF file. Equal pictures give equal bytes: it
// bears no time.
std::string pdf_text(const Picture& picture, const Fonts& fonts, const VectorPage& page);

}  // namespace chainreel
