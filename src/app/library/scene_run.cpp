#include "app/library/scene_run.hpp"

#include <atomic>
#include <mutex>
#include <thread>

#include "core/data_folder.hpp"
#include "app/film/automatic.hpp"
#include "app/cli/streams.hpp"
#include "app/film/prepared.hpp"
#include "app/film/runs.hpp"
#include "app/film/target.hpp"
#include "app/report/motion_table.hpp"
#include "app/report/run_report.hpp"
#include "app/works/moment.hpp"
#include "app/works/render_film.hpp"
#include "core/format.hpp"
#include "core/plain_numbers.hpp"
#include "draw/page/house_style.hpp"
#include "scene/text/read_scene.hpp"
#include "scene/text/write_scene.hpp"
#include "sim/torques_along.hpp"

namespace chainreel {
namespace {

// Numbers of one panel that are computed when they are first asked for.
struct Courses {
  std::optional<std::vector<double>> torques;
  std::optional<EnergyCourse> energy;
};

Scene scene_of(const SceneRequest& request) {
  if (request.text) return read_scene_text(*request.text, request.path, request.overrides);
  return read_scene(found_file(request.path), request.overrides);
}

void require_rising(const std::vector<double>& times, double duration) {
  for (std::size_t i = 0; i < times.size(); ++i)
    if (!(times[i] >= 0 && times[i] <= duration) || (i > 0 && !(times[i] > times[i - 1])))
      throw Error(ExitCode::usage, "times must rise within the duration of " + format_shortest(duration) + " s; entry " +
                                       std::to_string(i) + " is " + format_shortest(times[i]));
}

}  // namespace

struct SceneRun::State {
  std::shared_ptr<std::exception_ptr> failure;  // of the scene's torque function
  bool has_times = false;                       // of the run, which are not the film's
  PreparedFilm film{};
  std::optional<Runs> runs{};
  std::vector<Courses> courses{};
  std::optional<Fonts> fonts{};
  std::optional<Moments> moments{};
  std::mutex lock{};
  std::atomic<std::thread::id> holder{};  // of the lock

  // What asks the torque function: its own failure is the cause of any that comes of it.
  template <class Work>
  auto watched(Work&& work) {
    const PlainNumbers plain;
    if (failure) *failure = nullptr;
    try {
      if constexpr (std::is_void_v<decltype(work())>) {
        work();
        throw_failure();
      } else {
        auto result = work();
        throw_failure();
        return result;
      }
    } catch (...) {
      throw_failure();
      throw;
    }
  }
  void throw_failure() const {
    if (failure && *failure) std::rethrow_exception(*failure);
  }

  const Fonts& own_fonts() {
    if (!fonts) fonts.emplace(families_of(film.scene));
    return *fonts;
  }
  Moment moment(double at) {
    if (!moments) moments.emplace(film, own_fonts());
    return moments->moment(at);
  }
  void note(const Moment& shown, std::vector<std::string>* notes) const {
    if (notes != nullptr) std::ranges::move(left_out_words(shown.left_out, shown.held_text_scale, film.scene), std::back_inserter(*notes));
  }
  void require_within(double at) const {
    if (!(at >= 0 && at <= film.scene.duration))
      throw Error(ExitCode::usage, "the instant " + format_shortest(at) + " s lies outside the scene's duration of " +
                                       format_shortest(film.scene.duration) + " s");
  }
};

// One thread at a time asks a run; its torque function, which it asks itself, cannot.
class SceneRun::Asked {
 public:
  explicit Asked(State& state) : state_(state) {
    if (state_.holder == std::this_thread::get_id())
      throw Error(ExitCode::usage, "a torque function asks the run that it drives, which waits for it");
    state_.lock.lock();
    state_.holder = std::this_thread::get_id();
  }
  ~Asked() {
    state_.holder = std::thread::id();
    state_.lock.unlock();
  }
  Asked(const Asked&) = delete;
  Asked& operator=(const Asked&) = delete;

 private:
  State& state_;
};

SceneRun::SceneRun(SceneRequest request, std::vector<double> times) : state_(std::make_unique<State>()) {
  State& state = *state_;
  if (request.torque) state.failure = request.torque->failure;
  state.has_times = !times.empty();
  state.watched([&] {
    state.film = film_of(scene_of(request), true, true, std::move(request.torque));
    require_rising(times, state.film.scene.duration);
    if (state.has_times)
      state.runs.emplace(state.film, FilmClock(state.film.scene.duration, state.film.scene.video.fps), std::move(times));
    else  // slow motion by a rule is the film's, no part of the motion
      state.runs.emplace(state.film, Runs::OwnSlowMotion::left_out);
    state.has_times = state.has_times || state.runs->leaves_slow_motion_out();
    state.throw_failure();
    state.runs->require_expected_ends();
  });
  state.courses.resize(state.runs->size());
}

SceneRun::~SceneRun() = default;
SceneRun::SceneRun(SceneRun&&) noexcept = default;
SceneRun& SceneRun::operator=(SceneRun&&) noexcept = default;

int SceneRun::panels() const {
  return int(state_->film.panels.size());
}

const std::string& SceneRun::title(int panel) const {
  return state_->film.panels.at(std::size_t(panel)).scene.title;
}

const Chain& SceneRun::chain(int panel) const {
  return state_->film.panels.at(std::size_t(panel)).simulation.chain;
}

const Trajectory& SceneRun::trajectory(int panel) const {
  return state_->runs->list().at(std::size_t(panel));
}

std::vector<std::string> SceneRun::event_names(int panel) const {
  std::vector<std::string> names;
  for (const EventEntry& event : state_->film.panels.at(std::size_t(panel)).scene.events) names.push_back(event.title());
  return names;
}

const std::vector<double>& SceneRun::torques(int panel) const {
  const Asked asked(*state_);
  std::optional<std::vector<double>>& torques = state_->courses.at(std::size_t(panel)).torques;
  if (!torques)
    torques = state_->watched(
        [&] { return torques_along(state_->film.panels[std::size_t(panel)].simulation, trajectory(panel)); });
  return *torques;
}

const EnergyCourse& SceneRun::energy(int panel) const {
  const Asked asked(*state_);
  std::optional<EnergyCourse>& energy = state_->courses.at(std::size_t(panel)).energy;
  if (energy) return *energy;
  const Trajectory& run = trajectory(panel);
  const Simulation& simulation = state_->film.panels[std::size_t(panel)].simulation;
  EnergyBalance balance(simulation);
  const SpringEnergy springs(simulation);
  energy.emplace();
  for (int k = 0; k < run.size(); ++k) {
    const EnergyBalance::State now = balance.at(run.q_at(k), run.qd_at(k), run.work[std::size_t(k)]);
    energy->kinetic.push_back(now.kinetic);
    energy->potential.push_back(now.potential);
    energy->total.push_back(now.kinetic + now.potential + springs.at(run.q_at(k)));
    energy->error.push_back(now.error);
  }
  return *energy;
}

std::vector<RunArray> SceneRun::table(const std::string& columns, int panel) const {
  const std::vector<MotionColumn> chosen = parse_columns(columns, "columns");
  const Asked asked(*state_);
  return state_->watched([&] {
    const Simulation& simulation = state_->film.panels.at(std::size_t(panel)).simulation;
    require_columns(simulation, chosen, "columns");
    std::vector<RunArray> arrays;
    for (DataArray& one : motion_table(simulation, trajectory(panel), chosen).arrays)
      arrays.push_back({std::move(one.name), std::move(one.shape), std::move(one.values)});
    return arrays;
  });
}

std::string SceneRun::name() const {
  return state_->film.scene.name;
}

std::string SceneRun::effective_scene() const {
  return scene_text(state_->film.scene);
}

std::string SceneRun::report(int panel) const {
  const Asked asked(*state_);
  return state_->watched([&] {
    return to_json(run_report(state_->film.panels.at(std::size_t(panel)), trajectory(panel))).dump(2);
  });
}

std::vector<std::string> SceneRun::warnings() const {
  const Asked asked(*state_);
  return state_->watched([&] {
    std::vector<std::string> lines = doubt_lines(state_->film.panels);
    for (std::string& line : notice_lines(state_->film.panels)) lines.push_back(std::move(line));
    for (int panel = 0; panel < panels(); ++panel) {
      const PreparedScene& prepared = state_->film.panels[std::size_t(panel)];
      const std::string named = prepared.scene.name + (panels() > 1 ? ", '" + prepared.scene.title + "'" : "");
      for (const std::string& line : warning_lines(named, run_report(prepared, trajectory(panel)))) lines.push_back(line);
    }
    return lines;
  });
}

FilmFiles SceneRun::film(const FilmRequest& request) const {
  const Asked asked(*state_);
  state_->require_within(request.at);
  if (request.jobs < 0) throw Error(ExitCode::usage, "jobs are threads, 0 for all processors, not " + std::to_string(request.jobs));
  check_outputs(request.files, 1);
  RenderJob job;
  job.targets = targets_of(request.files, 1, state_->film.scene);
  job.at = request.at;
  job.jobs = request.jobs;
  job.overwrite = request.overwrite;
  job.quiet = true;
  job.tells = false;
  const Runs* runs = state_->has_times ? nullptr : &*state_->runs;
  RenderResult result = state_->watched([&] { return render_film(state_->film, job, runs); });
  return {std::move(result.files), std::move(result.sidecars), std::move(result.notes), result.frames, result.film_seconds};
}

Image SceneRun::frame(double at, int width, int height, std::vector<std::string>* notes) const {
  const Asked asked(*state_);
  state_->require_within(at);
  Video& video = state_->film.scene.video;
  constexpr int kMostPixels = 16384;
  for (const int side : {width, height})
    if (side != 0 && (side < 16 || side > kMostPixels))
      throw Error(ExitCode::usage, "a picture is 16 to 16384 pixels wide and high, not " + std::to_string(side));
  // Of another size the page is composed anew.
  const Video usual = video;
  const bool is_usual = (width == 0 || width == usual.width) && (height == 0 || height == usual.height);
  struct Restored {
    Video& video;
    const Video& usual;
    ~Restored() { video = usual; }
  } restored{video, usual};
  if (width > 0) video.width = width;
  if (height > 0) video.height = height;
  return state_->watched([&] {
    const Moment shown = is_usual ? state_->moment(at) : moment_at(state_->film, at, state_->own_fonts());
    state_->note(shown, notes);
    return rasterise(shown.picture, video.width, video.height, state_->own_fonts());
  });
}

void SceneRun::picture(double at, const std::string& path, bool overwrite, std::vector<std::string>* notes) const {
  const Asked asked(*state_);
  state_->require_within(at);
  const Video& video = state_->film.scene.video;
  state_->watched([&] {
    Moment shown = state_->moment(at);
    shown.memory.audit.update(told_alone(state_->film));
    state_->note(shown, notes);
    write_picture(shown.picture, video.width, video.height, state_->own_fonts(), path, overwrite, shown.memory);
  });
}

}  // namespace chainreel
