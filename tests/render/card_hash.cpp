// Prints the SHA-256 of the test card's pixels, to be compared between settings of the renderer.
#include <cstdio>
#include <span>

#include "core/error.hpp"
#include "core/hash.hpp"
#include "render/canvas.hpp"
#include "render/test_card.hpp"

int main() try {
  using namespace chainreel;
  const Fonts fonts;
  Canvas canvas(640, 360, fonts);
  Image image;
  Sha256 hash;
  for (const Theme* theme : {&light_theme(), &dark_theme()}) {
    canvas.draw(test_card(fonts, *theme), image);
    hash.add(std::as_bytes(std::span(image.bgra)));
  }
  std::printf("%s\n", hash.finish().c_str());
} catch (const chainreel::Error& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return int(error.code());
}
