// What a gallery shows of each film: the film itself, and what it and the files beside it say of it.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/image.hpp"
#include "core/json.hpp"
#include "encode/film_start.hpp"
#include "picture/point.hpp"

namespace chainreel {

// Films lie in the page as data: URLs, whose length browsers limit, each in its own way; as text they are a third longer, and browsers
// hold 512 MiB of it. Bytes of one that is told of, and of one that is refused.
inline constexpr std::uintmax_t kLongClip = 20'000'000, kLargestClip = 300'000'000;

struct GalleryChart {
  std::string path;
  std::string title;  // "Speed against accuracy"
};

struct GalleryClip {
  std::string path;
  std::string name;  // of the file, without its ending
  std::string type;  // "video/mp4"
  FilmStart start;
  std::string title;
  std::string words;  // one sentence for those who cannot see it
  std::string scene;  // YAML; "" where the film remembers none
  std::string why_no_scene;
  Json audit;  // null where there is none
  std::vector<GalleryChart> charts;
};

// Whether a file of this name is a chart of a film whose name it begins with: pen_chart.png.
bool is_chart_name(const std::string& name);

// ".mp4, .webm, .gif and .apng": films that browsers play.
std::string played_endings(const std::string& last_word);

// Films named, and those in folders named (of NAME.mp4, .webm, .apng and .gif that show the same the first), in the order in which they are named, those of a folder by their names.
// Throws Error (exit 3) where a path is no film, no picture and no folder, and where there is none of them at all.
struct FoundClips {
  std::vector<std::string> paths;
  std::vector<std::string> pictures;  // see gallery_pictures; named, or in those folders
  std::vector<std::string> shown_once;  // what shows the same as one of those under another ending
  std::vector<std::string> left_out;  // clips and pictures in those folders of kinds that browsers do not play or show
};
FoundClips find_clips(const std::vector<std::string>& paths);

// Throws Error (exit 3) with the problems of all that cannot be played.
std::vector<GalleryClip> read_clips(const std::vector<std::string>& paths);

// Where a button about the middle of a poster covers least of what is drawn there; of its width and its height, from the upper left.
Point button_place(const Image& poster);

// The instant of the film, s, that its poster shows: its last event, else where it first stands still to point at something, else 40 % of the
// film.
double poster_time(const Json& audit, double film_seconds);

}  // namespace chainreel
