// What a scene's `style` makes of the theme, the faces and the corner of a page.
#pragma once

#include <string>
#include <vector>

#include "picture/picture.hpp"
#include "picture/text.hpp"
#include "picture/theme.hpp"
#include "scene/scene.hpp"

namespace chainreel {

// The scene's theme with what its style changes. It lives as long as the program.
const Theme& page_theme(const Scene& scene);

FontFamilies families_of(const Scene& scene);

// A line for each colour that the style sets, that the scene's pictures may show, and that one cannot read: words need a contrast
// of 4.5 with the background (WCAG 2), marks, the logo and the outlines of links 3. `links`: how many bars are drawn in colours of the theme.
std::vector<std::string> low_contrasts(const Scene& scene, std::size_t links = kMostLinkColors);

// (L1 + 0.05) / (L2 + 0.05), of the relative luminances of WCAG 2.
double contrast(Color a, Color b);

// The logo in `box`, whose sides lie on whole pixels of a page `height` px high: averaged over the pixels' squares.
void draw_logo(Picture& picture, const Image& image, const Rect& box, int height);

}  // namespace chainreel
