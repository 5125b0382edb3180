// Prints the SHA-256 of the pixels of the test card and of bodies in space, to be compared between settings of the renderer,
// processors and, named as an argument, the library that brings it, or none.
#include <cstdio>
#include <memory>
#include <span>

#include "core/error.hpp"
#include "core/hash.hpp"
#include "mesh/primitives.hpp"
#include "render/canvas.hpp"
#include "render/gl_backend.hpp"
#include "render/test_card.hpp"

namespace {

using namespace chainreel;

// Round and flat, turned by odd angles, through one another and in perspective: vertices between pixels, colours between
// vertices and depths nearly the same are what processors may round apart.
Picture bodies(const Theme& theme) {
  const auto shared = [](TriangleMesh mesh) { return std::make_shared<const TriangleMesh>(std::move(mesh)); };
  const double c = 0.8253356149096783, s = 0.5646424733950354;  // of 0.6 rad
  Solids solids;
  solids.origin = {0.89, 0.5};
  solids.scale = 0.5;
  solids.nearing = {0, 0.02, 0.11};
  solids.outline = theme.ink;
  solids.outline_width = 0.004;
  solids.parts = {{shared(sphere_mesh(0.61)), {1, 0, 0, -0.7, 0, 1, 0, 0.1, 0, 0, 1, 0.03}, theme.link[0]},
                  {shared(cylinder_mesh(0.33, 2.9)), {0, s, c, 0.1, c, 0, 0, 0.05, 0, c, -s, 0.1}, theme.link[1]},
                  {shared(box_mesh({0.9, 1.1, 0.7})), {c, -s, 0, 0.8, s, c, 0, -0.1, 0, 0, 1, 0}, theme.link[2]},
                  {shared(box_mesh({0.9, 1.1, 0.7})), {c, 0, s, 0.9, 0, 1, 0, 0.2, -s, 0, c, 0.2}, theme.link[3].faded(0.5)}};
  Picture picture;
  picture.background = theme.background;
  picture.add(solids);
  return picture;
}

}  // namespace

int main(int count, char** words) try {
  if (count > 1) choose_gl_backend(require_named<GlBackend>("the library", words[1]));
  const Fonts fonts;
  Canvas canvas(320, 180, fonts), over_a_layer(320, 180, fonts);
  Image image;
  Sha256 hash;
  for (const Theme* theme : {&light_theme(), &dark_theme()}) {
    for (const Picture& picture : {test_card(fonts, *theme), bodies(*theme)}) {
      canvas.draw(picture, image);
      hash.add(std::as_bytes(std::span(image.bgra)));
      Picture below;
      below.background = picture.background;
      over_a_layer.set_static_layer(below);
      over_a_layer.draw(picture, image);
      hash.add(std::as_bytes(std::span(image.bgra)));
    }
  }
  std::printf("%s\n", hash.finish().c_str());
} catch (const chainreel::Error& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return int(error.code());
}
