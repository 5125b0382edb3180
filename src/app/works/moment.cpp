#include "app/works/moment.hpp"

#include <algorithm>
#include <optional>

#include "app/film/clip_origin.hpp"
#include "app/film/instants.hpp"
#include "app/report/alt_text.hpp"
#include "app/report/instant_report.hpp"
#include "app/report/run_report.hpp"
#include "app/report/sidecar.hpp"
#include "app/works/part.hpp"
#include "core/data_folder.hpp"
#include "core/error.hpp"
#include "core/format.hpp"
#include "scene/run/title.hpp"

namespace chainreel {
namespace {
constexpr double kSameInstant = 1e-9;  // s
}

namespace {

// As films have it: curves go on to the end of the last frame.
std::vector<double> with_end_of_motion(std::vector<double> times, const PreparedFilm& film) {
  if (const double end = plain_times(film).back(); end > times.back()) times.push_back(end);
  return times;
}

}  // namespace

// A film with its pictures, as far as they are asked for.
struct Moments::State {
  const PreparedFilm& film;
  int frames;
  Runs runs;
  Film pictures;
  FilmReport report;
  ClipMemory memory;
  std::vector<std::string> warnings;

  State(const PreparedFilm& of, FilmClock clock, Instants instants, const Fonts& fonts)
      : film(of),
        frames(int(instants.times.size())),
        runs(film, std::move(clock), with_end_of_motion(std::move(instants.times), film)),
        pictures(runs.pictures(frames_drawn(instants.frames.front()), fonts)),
        report(film_report(runs, pictures, frames_of_film(runs, instants.added))) {
    report.writes = Writes::pictures;
    memory = memory_of(report);
    warnings = warning_lines(report);
  }

  // Those that every run shows that must come to its end.
  int frames_drawn(int frame) const {
    runs.require_expected_ends(frame);
    return runs.size() == 1 && film.scene.expect != Outcome::diverge ? std::min(frames, runs[0].size()) : frames;
  }

  Moment moment(int frame) const {
    runs.require_expected_ends(frame);
    Moment moment;
    moment.at = runs.times()[std::size_t(frame)];
    moment.picture = pictures.still(frame);
    moment.title = runs.size() == 1 ? title_of(film.panels.front().scene, &film.panels.front().simulation, runs[0]) : title_of_page(film.scene);
    moment.memory = memory;
    moment.memory.audit["at"] = moment.at;
    moment.warnings = warnings;
    if (moment.at > last_end() + kSameInstant)
      moment.warnings.push_back(film.scene.name + ": every run had ended by t = " + format_significant(last_end(), 4) +
                                " s: the picture for t = " + format_significant(moment.at, 4) + " s shows how");
    // The picture is of before, and right; a film of the run would fail.
    for (std::size_t i = 0; i < runs.size(); ++i) {
      const Scene& scene = film.panels[i].scene;
      if (is_complete(runs[i].status) || scene.expect == Outcome::diverge) continue;
      const std::string failed = runs[i].trouble + " with " + method_text(scene) + ": what is shown is from before";
      moment.warnings.push_back(film.scene.name + ": " + (runs.size() == 1 ? failed : in_panel(scene, runs[i], i, failed)));
    }
    moment.left_out = report.left_out;
    moment.held_text_scale = report.held_text_scale;
    moment.numbers = numbers(frame);
    return moment;
  }

  // When the last run ended.
  double last_end() const {
    double end = 0;
    for (std::size_t i = 0; i < runs.size(); ++i) end = std::max(end, runs[i].end_time);
    return end;
  }

  // A panel whose run ended before stands still as it ended.
  Json numbers(int frame) const {
    Json panels = Json::array();
    for (std::size_t i = 0; i < runs.size(); ++i) {
      Json panel{{"title", title_of(film.panels[i].scene, &film.panels[i].simulation, runs[i])}, {"status", to_string(runs[i].status)}};
      if (runs[i].size() > 0) panel.update(sample_report(film.panels[i].simulation, runs[i], std::min(frame, runs[i].size() - 1)));
      panels.push_back(std::move(panel));
    }
    return {{"at", runs.times()[std::size_t(frame)]}, {"panels", panels}};
  }
};

Json told_alone(const PreparedFilm& film) {
  Json told{{kSet, film.scene.set}, {kMechanisms, Json::array()}};
  for (const PreparedScene& panel : film.panels) told[kMechanisms].push_back(mechanism_record(panel));
  if (const std::string meshes = meshes_hash(film); !meshes.empty()) told[kMeshesHash] = meshes;
  if (!name_of_shipped(film.scene.file).empty()) told[kShipped] = true;
  return told;
}

Moments::Moments(const PreparedFilm& film, const Fonts& fonts)
    : film_(film), fonts_(fonts), clock_(clock_of(film)) {}

Moments::~Moments() = default;

Moment Moments::moment(double at) {
  Instants instants = instants_of(film_, clock_, {at});
  const int frame = instants.frames.front();
  if (!instants.added.empty()) return State(film_, clock_, std::move(instants), fonts_).moment(frame);
  if (!of_frames_) of_frames_ = std::make_unique<State>(film_, clock_, std::move(instants), fonts_);
  return of_frames_->moment(frame);
}

std::vector<Moment> Moments::together(const std::vector<double>& at) {
  std::vector<Moment> moments;
  if (at.empty()) return moments;
  Instants instants = instants_of(film_, clock_, at);
  const std::vector<int> frames = instants.frames;
  const State state(film_, clock_, std::move(instants), fonts_);
  for (const int frame : frames) moments.push_back(state.moment(frame));
  return moments;
}

Moment Moments::telling() {
  return moment(telling_instant(Runs(film_, clock_, clock_.frame_times())));
}

Moment moment_at(const PreparedFilm& film, double at, const Fonts& fonts) {
  return Moments(film, fonts).moment(at);
}

Moment telling_moment(const PreparedFilm& film, const Fonts& fonts) {
  return Moments(film, fonts).telling();
}

AskedInstant asked_at(const std::string& part, const std::string& text) {
  try {
    return parse_asked_instant(part, {});
  } catch (const Error& error) {
    throw Error(ExitCode::usage, "--at " + text + ": " + error.problems().front().message);
  }
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
