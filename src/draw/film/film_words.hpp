// Where the words of marks stand in each panel of a film, at each of its frames.
#pragma once

#include <span>
#include <vector>

#include "draw/film/film_view.hpp"
#include "draw/page/word_plan.hpp"

namespace chainreel {

class FilmWords {
 public:
  // Draws all frames once, without pixels, where a layer has words.
  FilmWords(const Stage& stage, const Layers& layers, const FilmSheet& sheet, const FilmView& view,
            const std::vector<Panel>& panels);

  // Of a panel at the frame that it shows; empty where it has no words.
  std::span<const StandingWord> at(std::size_t panel, int frame) const;

 private:
  std::vector<std::vector<std::vector<StandingWord>>> panels_;  // by panel and frame
};

}  // namespace chainreel
