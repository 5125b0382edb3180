// What must hold of a page with films, whatever it looks like.
#pragma once

#include <string>
#include <vector>

#include "browser/browser.hpp"

namespace chainreel {

struct ExpectedFilm {
  double seconds = 0;
  double frame = 0;  // s, how long each frame stands: the tolerance of the duration
  int width = 0, height = 0;
};

// Opens the page and says all that is wrong with it: a film that does not load, has another size or duration
// or does not play; anything that the console says; anything that is asked of a network or of other files.
std::vector<std::string> problems_of_page(Browser& browser, const std::string& file,
                                          const std::vector<ExpectedFilm>& films);

}  // namespace chainreel
