// One film to all of its files: each frame is drawn and rasterised once and given to every sink.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/film/clip_memory.hpp"
#include "app/film/runs.hpp"
#include "app/film/target.hpp"
#include "app/report/run_report.hpp"
#include "app/works/draw_film.hpp"
#include "app/works/part.hpp"

namespace chainreel {

struct RenderResult;

struct RenderJob {
  std::vector<Target> targets;
  double at = 0;  // s, instant of the motion that stills show
  std::optional<PartRequest> part{};  // else all of the film
  bool resume = false;                // from the chunks that a killed run left
  int jobs = 0;   // threads that draw and encode; 0: all processors
  bool overwrite = false;
  bool quiet = false;
  bool tells = true;  // on standard error; false: the caller tells of the runs, their warnings and the notes
  RenderResult* unfinished = nullptr;  // is given what is known of a film whose run does not end as expected, before that is thrown
};

struct RenderResult {
  std::vector<std::string> files;     // of the targets, in their order
  std::vector<std::string> warnings;  // of runs that are not to be believed
  std::vector<std::string> notes;     // that its maker may want to know
  std::vector<std::string> sidecars;  // NAME.json, NAME.txt, and maybe NAME.srt and NAME.tex
  int frames = 0;                     // with those that are held; of the part
  std::optional<FrameRange> part;     // of a part: which they are
  double film_seconds = 0;
  int jobs = 1;                       // threads that it was drawn by, at most
  StageTimes times;
  Json audit;
};

// What the films of a scene remember, were they rendered now: without pixels.
ClipMemory memory_of_film(const PreparedFilm& film);

// `done`: the film's runs at its frames, where its caller has them. Nothing is begun before all files can be written; nothing bears its name before all are whole. A run that
// failed leaves films and tables as far as they came under a .partial name, and throws. A part of a film bears what it is
// in its name, and holds what stands beside the whole; a share that has no frames leaves no file.
RenderResult render_film(const PreparedFilm& film, const RenderJob& job, const Runs* done = nullptr);

}  // namespace chainreel
