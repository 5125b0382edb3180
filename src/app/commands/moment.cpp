#include "app/commands/moment.hpp"

#include <algorithm>
#include <optional>

#include "app/film/instants.hpp"
#include "app/report/alt_text.hpp"
#include "app/report/run_report.hpp"
#include "core/error.hpp"
#include "scene/run/fall.hpp"

namespace chainreel {
struct Moments::State {
  const PreparedFilm& film;
  std::vector<int> frames;
  Runs runs;
  Film pictures;
  FilmReport report;
  ClipMemory memory;
  std::vector<std::string> warnings;

  State(const PreparedFilm& of, FilmClock clock, Instants instants, const Fonts& fonts)
      : film(of),
        frames(std::move(instants.frames)),
        runs(film, std::move(clock), std::move(instants.times)),
        pictures(runs.pictures(frames_drawn(), fonts)),
        report(film_report(runs, pictures, frames_of_film(runs, instants.added))) {
    report.writes = Writes::pictures;
    memory = memory_of(report);
    warnings = warning_lines(report);
  }

  // Those that every run shows that must come to its end.
  int frames_drawn() const {
    for (const int frame : frames) runs.require_expected_ends(frame);
    const int all = int(runs.times().size());
    return runs.size() == 1 && film.scene.expect == Outcome::finish ? std::min(all, runs[0].size()) : all;
  }
};

Moments::Moments(const PreparedFilm& film, const std::vector<double>& at, const Fonts& fonts) {
  FilmClock clock = clock_of(film);
  Instants instants = instants_of(film, clock, at);
  state_ = std::make_unique<State>(film, std::move(clock), std::move(instants), fonts);
}

Moments::~Moments() = default;

Moment Moments::moment(std::size_t i) const {
  const State& state = *state_;
  const int frame = state.frames[i];
  Moment moment;
  moment.at = state.runs.times()[std::size_t(frame)];
  moment.picture = state.pictures.static_layer();
  moment.picture.append(state.pictures.frame(frame));
  moment.title = state.runs.size() == 1 ? title_of(state.film.panels.front().scene, state.runs[0])
                                        : state.film.scene.title;
  moment.memory = state.memory;
  moment.memory.audit["at"] = moment.at;
  moment.warnings = state.warnings;
  return moment;
}

Moment moment_at(const PreparedFilm& film, double at, const Fonts& fonts) {
  return Moments(film, {at}, fonts).moment(0);
}

Moment telling_moment(const PreparedFilm& film, const Fonts& fonts) {
  const FilmClock clock = clock_of(film);
  const Runs runs(film, clock, clock.frame_times());
  return moment_at(film, telling_instant(runs), fonts);
}

std::vector<double> instants_asked(const PreparedFilm& film, const std::vector<AskedInstant>& asked) {
  std::optional<Runs> runs;
  std::vector<double> instants;
  for (const AskedInstant& one : asked) {
    if (const std::string trouble = trouble_of_instant(one, film.scene); !trouble.empty())
      throw Error(ExitCode::usage, "--at " + one.text + ": " + trouble);
    if (one.event.empty()) {
      instants.push_back(one.at);
      continue;
    }
    if (!runs) runs.emplace(film);
    const std::optional<double> first = first_time_of(*runs, one.event);
    if (!first)
      throw Error(ExitCode::bad_input, "--at " + one.text + ": the event does not happen in this run",
                  {film.scene.file});
    instants.push_back(*first);
  }
  return instants;
}

}  // namespace chainreel
