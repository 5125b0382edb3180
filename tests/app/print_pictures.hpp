// How GoogleTest prints the parameter of a test over all pictures: by its name.
#pragma once

#include <ostream>

#include "app/all_pictures.hpp"

namespace chainreel::test {

inline void PrintTo(const AnyPicture& picture, std::ostream* out) {
  *out << picture.name;
}

}  // namespace chainreel::test
