#include "app/paper/paper_film.hpp"

#include <cmath>
#include <cstdio>
#include <optional>

#include "app/film/runs.hpp"
#include "core/error.hpp"
#include "core/format.hpp"
#include "draw/film/room.hpp"

namespace chainreel {
namespace {

constexpr double kTaller = 1.08, kWider = 1.1;  // from one page that is tried to the next
constexpr double kWidestTried = 420;            // mm: a sheet of A3

// What a page of some size has no room for, and in which words that is told.
struct Tried {
  Lack lack;
  std::optional<Error> error;

  bool has_room() const { return !error && lack.what.empty(); }
  std::string words(double page_mm) const {
    return error ? error->problems().front().message : lack.what + " is " + format_significant(lack.size * page_mm, 2) + (lack.is_narrow ? " mm wide" : " mm high");
  }
};

class PaperFilm {
 public:
  PaperFilm(const PreparedFilm& film, const Fonts& fonts)
      : film_(film), fonts_(fonts), runs_(film), aspect_(double(film.scene.video.height) / film.scene.video.width) {}

  double usual_height(double width_mm) const { return width_mm * aspect_; }

  Tried tried(double width_mm, double height_mm) const {
    try {
      return {lack_of_room(runs_.composition(page(width_mm, height_mm), runs_.frames_shown(int(runs_.times().size())), fonts_)), {}};
    } catch (const Error& error) {
      if (error.code() != ExitCode::bad_input) throw;
      return {{}, error};
    }
  }

  // The first height that has room, from the film's own shape on.
  std::optional<double> height_with_room(double width_mm) const {
    const double most = std::max(kHighestPage * width_mm, usual_height(width_mm));
    for (double height = usual_height(width_mm); height <= most; height = std::ceil(kTaller * height))
      if (tried(width_mm, height).has_room()) return height;
    return std::nullopt;
  }

 private:
  Scene page(double width_mm, double height_mm) const {
    Scene page = film_.scene;
    PaperOptions options;
    options.width_mm = width_mm;
    give_size(page.video, paper_page(options, height_mm));
    return page;
  }

  const PreparedFilm& film_;
  const Fonts& fonts_;
  Runs runs_;
  double aspect_;
};

[[noreturn]] void refuse(const PaperFilm& paper, const PreparedFilm& film, const PaperOptions& options) {
  const double usual = paper.usual_height(options.width_mm);
  const Tried tried = paper.tried(options.width_mm, usual);
  std::string remedy;
  for (double width = std::ceil(kWider * options.width_mm); width <= kWidestTried && remedy.empty(); width = std::ceil(kWider * width))
    if (paper.height_with_room(width)) remedy = ": take --width-mm " + format_shortest(width);
  throw Error(ExitCode::bad_input,
              "a page " + format_shortest(options.width_mm) + " mm wide has no room for this beside words of 7 pt, however high it is (" +
                  tried.words(usual) + ")" + (remedy.empty() ? ": compare or plot less" : remedy),
              {film.scene.file});
}

}  // namespace

void set_paper_page(PreparedFilm& film, const PaperOptions& options, const Fonts& fonts, bool quiet) {
  const PaperFilm paper(film, fonts);
  const auto note = [&](const std::string& words) {
    if (!quiet) std::fprintf(stderr, "note: %s: %s\n", film.scene.name.c_str(), words.c_str());
  };
  double height = options.height_mm;
  if (height != PaperOptions::kNotGiven) {
    const Tried tried = paper.tried(options.width_mm, height);
    if (!tried.has_room()) {
      const std::optional<double> better = paper.height_with_room(options.width_mm);
      const std::string remedy = better ? "take --height-mm " + format_significant(*better, 3) + ", or leave it out" : "take a larger --width-mm";
      if (tried.error) throw Error(ExitCode::bad_input, tried.words(height) + ", or " + remedy, tried.error->problems().front().place);
      note(tried.words(height) + " on a page of this size: " + remedy);
    }
  } else {
    const std::optional<double> enough = paper.height_with_room(options.width_mm);
    if (!enough) refuse(paper, film, options);
    height = *enough;
    if (height > paper.usual_height(options.width_mm))
      note("the page is " + format_shortest(height) + " mm high, so that plots and panels have room beside words of 7 pt; --height-mm says otherwise");
  }
  give_size(film.scene.video, paper_page(options, height));
}

}  // namespace chainreel
