// How a film, picture or table is made again: by which command, with which changes of its scene.
#pragma once

#include <string>
#include <vector>

#include "app/cli/command.hpp"
#include "app/film/prepared.hpp"
#include "app/today/asked_films.hpp"
#include "core/json.hpp"

namespace chainreel {

struct Remaking {
  bool knows_set = true;               // what the command line changed when it was made
  std::vector<std::string> set{};      // that, and what is given now
  std::vector<std::string> command{};  // a shell's words: they make all that its audit tells of; none where that is not known
};

// `shown`: which instant or event a picture is of, and on which paper, as it remembers it.
Remaking remaking_of(const AskedFilm& asked, const PreparedFilm& film, const Json& shown, const CommonOptions& common);

// Whether a PNG has others than it says itself, or an SVG another text: no audit lies beside a still. Throws Error (bad input) where it cannot be read.
bool has_other_pixels(const std::string& path);

// Files that such a command would replace, as it overwrites, though they are not ours, or were changed since: what it writes itself, and what lies beside it.
std::vector<std::string> foreign_beside(const std::vector<std::string>& command);

// The words with their files by where these lie, however they are named: of two commands that are one.
std::vector<std::string> placed_words(std::vector<std::string> command);

// Those whose files others read come first; else in their order.
void put_in_order(std::vector<std::vector<std::string>>& commands);

// What the command line changed when it was made, as far as that is known, and what is given now: "duration=2".
std::vector<std::string> changes_of(const AskedFilm& asked, const CommonOptions& common);

// The table of a panel, f.2.csv, is made with all others of its page, by -o f.csv: this.
std::string page_of_table(const std::string& path);

// As a command takes it: a name that begins with - would be a flag.
std::string typed_path(const std::string& path);

}  // namespace chainreel
