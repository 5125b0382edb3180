// The frames of a film to its files, on several threads: each has a canvas and encoders of its own and takes the next chunk
// of the film, a small clip, which needs its frames in order, or the single pictures. Bytes do not depend on who took what.
#pragma once

#include <algorithm>
#include <optional>
#include <string>
#include <vector>

#include "app/film/clip_memory.hpp"
#include "app/film/progress.hpp"
#include "app/film/runs.hpp"
#include "app/works/outputs.hpp"
#include "app/works/part.hpp"
#include "core/stage_clock.hpp"
#include "draw/film/film.hpp"
#include "render/canvas.hpp"

namespace chainreel {

// How often each frame that is drawn is shown.
struct Schedule {
  int frames = 0, first = 0, last = 0;  // drawn; held longer, in frames

  int total() const { return frames + first + last; }
  int drawn(int shown) const { return std::clamp(shown - first, 0, frames - 1); }
};

Schedule schedule_of(const Runs& runs);

// Of all threads together: motion; shapes; pixels, drawn and read; pixels as encoders take them; films encoded, also clips
// and pictures; packets to the film's file.
struct StageTimes {
  StageTime simulate, draw, render, convert, encode, mux;
  double total = 0;  // s, by the clock

  StageTimes& operator+=(const StageTimes& other);  // the stages alone
};

struct FilmWork {
  const Film& film;
  const Scene& scene;
  const Fonts& fonts;
  Schedule schedule;
  int still = 0;  // frame that single pictures show
  double still_at = 0;  // instant of the motion that they show, s
  const ClipMemory& memory;
  FrameRange range;     // of the film, as it is shown: all of it or a part
  std::string part;     // what films say of themselves as one, or ""
  std::string film_key; // of what is shown, for chunks that were kept; "": none are
  int jobs = 1;         // threads, at most
  bool quiet = false;
  ComingRenderer* renderer = nullptr;  // of the scene's size, that draws what lies under all frames; none: one is made
  std::vector<ChunkTape>* tapes = nullptr;  // takes the frames of films, a tape a chunk; then these are not made
  const Picture* still_picture = nullptr;   // of `still_at`, where no frame stands there
};

// Where the chunks of a film begin, and behind them its number of frames; whether its files may be cut there only.
struct FilmCuts {
  std::vector<int> bounds;
  bool are_fixed = false;
};
FilmCuts cuts_of(const std::vector<Output>& outputs, int frames, FrameRate fps);

// The libraries that films need and the renderer, made ready beside what is worked out before: from cold they take a tenth of a
// second. None where no picture is asked for.
std::optional<ComingRenderer> renderer_ahead(const std::vector<Output>& outputs, const Scene& scene, std::size_t panels);

// How many threads are worth having where `wanted`, or all processors where it is 0, may be had: as many as there is memory
// for; fewer than wanted is told on standard error.
int affordable_jobs(int wanted, const Scene& scene, const std::vector<Output>& outputs);

// All that the outputs show, whole under their temporary names. The first error of a thread ends all of them and is thrown,
// as is the signal's. With a key, films and sequences of pictures are begun where a killed run of the program left them; what is
// kept for that, now or by earlier runs, goes by forget_chunks().
void draw_film(const FilmWork& work, std::vector<Output>& outputs, StageTimes& times);
void forget_chunks(const std::vector<Output>& outputs, FrameRange range, int frames);

VideoSettings settings_of(const OutputFormat& format, const Scene& scene, const Tags& tags);

}  // namespace chainreel
