// One picture out of the film of a scene: same camera, same scales, whatever the instant.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "app/film/clip_memory.hpp"
#include "app/film/prepared.hpp"
#include "app/film/runs.hpp"
#include "core/json.hpp"
#include "scene/text/asked_instant.hpp"

namespace chainreel {

// What a picture remembers besides, in its audit, where an event was asked for: its name.
inline constexpr const char* kAtEvent = "at_event";

struct Moment {
  double at = 0;  // s
  Picture picture;
  std::string title;  // of the page, with what it says of the run
  ClipMemory memory;
  std::vector<std::string> warnings;  // what speaks against the runs
  std::vector<std::string> left_out;  // layers that a page this small has no room for
  double held_text_scale = 0;         // as of FilmReport
  Json numbers;                       // {"at", "panels": [what each shows]}
};

// What a picture by itself remembers besides, in its audit, as none lies beside it: what the command line changed, its mechanisms and meshes, and whether its
// scene came with the program.
Json told_alone(const PreparedFilm& film);

// Several of one film, each as it is alone, whichever others there are: those at its frames share one run; an instant
// between two frames is a sample more, which camera, trails and plots hold, too, and has a run of its own. The film
// and fonts must outlive them.
class Moments {
 public:
  Moments(const PreparedFilm& film, const Fonts& fonts);
  ~Moments();

  // Throws Error (exit 5) where a run does not come that far or does not end as the scene expects; what fails
  // later does not spoil the picture.
  Moment moment(double at);
  // Those of one run, which one camera sees.
  std::vector<Moment> together(const std::vector<double>& at);
  // The one that says most: when the last event happened, else the middle of the longest run.
  Moment telling();

 private:
  struct State;
  const PreparedFilm& film_;
  const Fonts& fonts_;
  FilmClock clock_;
  std::unique_ptr<State> of_frames_;
};

// One alone.
Moment moment_at(const PreparedFilm& film, double at, const Fonts& fonts);

Moment telling_moment(const PreparedFilm& film, const Fonts& fonts);

// One of --at, of which `text` is the whole. Throws Error (usage) naming that.
AskedInstant asked_at(const std::string& part, const std::string& text);

// The instants in seconds: events by their first time in any panel. Throws Error where the scene has none
// such (usage), or the event does not come (bad input).
std::vector<double> instants_asked(const PreparedFilm& film, const std::vector<AskedInstant>& asked);

}  // namespace chainreel
