// Where the words of marks stand in each panel of a film, at each of its frames.
#pragma once

#include <vector>

#include "draw/film/film_view.hpp"
#include "draw/page/word_plan.hpp"

namespace chainreel {

class FilmWords {
 public:
  // Draws all frames once, without pixels, where a layer has words.
  FilmWords(const Stage& stage, const Layers& layers, const FilmSheet& sheet, const FilmView& view,
            const std::vector<Panel>& panels);

  // For the words of a panel at the frame that it shows, which are added in the order in which they were planned.
  MarkLabels labels(std::size_t panel, int frame) const;

  // Where they stand; empty where the panel has none. With what the film was planned with.
  std::vector<StandingWord> standing(const Stage& stage, const Layers& layers, const FilmView& view, const std::vector<Panel>& panels,
                                     std::size_t panel, int frame) const;

  // The same for a picture by itself, in which nothing runs: words that fade stand whole, and those that the film leaves out there,
  // since they would run faster than can be read, stand where there is room.
  std::vector<StandingWord> still(const Stage& stage, const Layers& layers, const FilmSheet& sheet, const FilmView& view,
                                  const std::vector<Panel>& panels, std::size_t panel, int frame) const;

 private:
  struct OfPanel {
    Rect area;
    PlannedWords words;
  };
  std::vector<OfPanel> panels_;
};

}  // namespace chainreel
