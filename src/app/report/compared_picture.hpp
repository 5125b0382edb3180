// Pictures that show what was compared: they say so in a text, by which a later run knows them from the
// user's own and takes those away that are no more true.
#pragma once

#include <map>
#include <string>

namespace chainreel {

// The text for write_png and with_png_text.
const std::map<std::string, std::string>& compared_picture_text();

// Whether a comparison of this program wrote the file at `path`.
bool is_compared_picture(const std::string& path);

// Removes the file where it bears that text and is no input of this run; anything else stays.
void remove_compared_picture(const std::string& path);

}  // namespace chainreel
