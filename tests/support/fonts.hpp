// The fonts of all pictures, loaded once a test program.
#pragma once

#include "picture/text.hpp"

namespace chainreel {

inline const Fonts& fonts() {
  static const Fonts fonts;
  return fonts;
}

}  // namespace chainreel
