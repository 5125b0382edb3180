// Pictures that a gallery shows below its films: figures, sheets, stills.
#pragma once

#include <string>
#include <vector>

namespace chainreel {

struct GalleryPicture {
  std::string path;
  std::string type;   // "image/png"
  std::string title;  // in plain words
};

// ".png and .svg": pictures that browsers show.
std::string shown_endings(const std::string& last_word);

// "image/png", or "" of what is no picture or none that browsers show.
std::string picture_type_of(const std::string& path);

// Those of a folder that this program made and that belong to none of its films: no poster, no chart and no still of one. By
// their names. `left_out` gets those of kinds that browsers do not show and that lie beside none that they do,
// `shown_once` those that have a film's name.
std::vector<std::string> pictures_in(const std::string& folder, std::vector<std::string>& left_out, std::vector<std::string>& shown_once);

// Throws Error (exit 3) with the problems of all that cannot be shown.
std::vector<GalleryPicture> read_pictures(const std::vector<std::string>& paths);

}  // namespace chainreel
