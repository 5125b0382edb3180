#include "scene/run/stability_cells.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <memory>
#include <mutex>

#include "core/error.hpp"
#include "core/format.hpp"
#include "core/parallel.hpp"
#include "integrate/stability_limit.hpp"
#include "scene/run/prepare.hpp"
#include "scene/text/unread.hpp"
#include "scene/text/read_scene.hpp"
#include "sim/audit.hpp"
#include "sim/batch.hpp"
#include "sim/cost_table.hpp"
#include "sim/linear_modes.hpp"
#include "sim/workload.hpp"

namespace chainreel {
namespace {

constexpr int kInstants = 100;
constexpr double kMostCells = 1e6;  // more than a page has room for
// A share of all energies that were added up: less than it is rounding, whatever the motion.
constexpr double kRounding = 1e-9;

// What was seen of a run's energy.
struct EnergySeen {
  double error = 0, size = 0;  // J

  void add(const EnergyBalance::State& state) {
    error = std::isfinite(state.error) ? std::max(error, std::abs(state.error))
                                       : std::numeric_limits<double>::infinity();
    size = std::max(size, state.kinetic + std::abs(state.potential));
  }
};

void judge(const EnergySeen& seen, double scale, StabilityCell& cell) {
  cell.energy_error = seen.error;
  cell.energy_scale = scale;
  const bool is_lost =
      seen.error > kFailedEnergy * scale + kRounding * seen.size;  // false where scale is NaN
  cell.failed = !std::isfinite(seen.error) || is_lost;
  if (is_lost && cell.trouble.empty())
    cell.trouble = "the energy is off by " + format_significant(seen.error, 3) + " J, the motion has " +
                   format_significant(scale, 3) + " J";
}

// Keys of the integration alone: the mechanism need not be made anew for them.
bool is_of_method(const std::string& key) {
  return key == "step" || key == "tolerance";
}

// Keys that let cells differ in the number of their steps.
bool is_of_time(const std::string& key) {
  return is_of_method(key) || key == "duration";
}

void set_of_method(Simulation& simulation, const std::string& key, double value) {
  if (key == "step") {
    simulation.step = value;
    simulation.options.tolerance = 0;
  } else {
    simulation.step = 0;
    simulation.options.tolerance = value;
  }
}

class CellRuns {
 public:
  CellRuns(const std::string& scene, const std::vector<std::string>& overrides, const Sweep& x,
           const Sweep& y, int threads, const StopRequest& stop)
      : scene_(scene), overrides_(overrides), threads_(threads), stop_(stop), done_(x.values.size() * y.values.size()) {
    result_.x = x;
    result_.y = y;
    result_.threads = threads;
    result_.cells.resize(x.values.size() * y.values.size());
  }

  StabilityCells run() {
    // The first cell alone: a scene that cannot be read says so once.
    Simulation first = simulation_of({0, 0});
    result_.method = first.method->name;
    require_all_possible(first);
    const bool same_step = !is_of_time(result_.x.key) && !is_of_time(result_.y.key);
    result_.in_batches = same_step && fits_a_batch(first);
    find_scales();
    if (result_.in_batches)
      run_batch();
    else
      for_each_index(result_.y.values.size(), threads_, [this](std::size_t iy) { run_row(iy); });
    find_boundary();
    return std::move(result_);
  }

 private:
  struct At {
    std::size_t x, y;
  };

  Simulation simulation_of(At at) const {
    std::vector<std::string> settings = overrides_;
    settings.push_back(result_.x.setting(at.x));
    settings.push_back(result_.y.setting(at.y));
    const auto reader = take_reader();
    Scene scene = reader->file.read(settings);
    require_single_run(scene);
    if (at.x == 0 && at.y == 0) {
      require_read(result_.x.key, scene, "--x");
      require_read(result_.y.key, scene, "--y");
    }
    if (scene.chooses_method())
      throw Error(ExitCode::bad_input,
                  "a stability map needs a method of its own: auto would choose another one in every cell; "
                  "name one, like --set method=rk4",
                  scene.place_of("method"));
    return prepare(scene, false, reader->last);
  }

  // A file and a model that are read already.
  struct Reader {
    SceneFile file;
    LastChain last{};
  };

  // Given back to the others when its holder lets go of it.
  std::shared_ptr<Reader> take_reader() const {
    const auto give_back = [this](Reader* reader) {
      const std::lock_guard lock(readers_lock_);
      readers_.emplace_back(reader);
    };
    const std::lock_guard lock(readers_lock_);
    if (readers_.empty()) return {new Reader{SceneFile(scene_)}, give_back};
    Reader* reader = readers_.back().release();
    readers_.pop_back();
    return {reader, give_back};
  }

  // All cells by the first one's mechanism, with the steps and tolerances of their own.
  void require_all_possible(Simulation& one) const {
    const double duration = one.duration;
    const double least = kInstants * forward_dynamics_cost(one.chain);  // of any run
    double work = 0;
    for (std::size_t iy = 0; iy < result_.y.values.size(); ++iy)
      for (std::size_t ix = 0; ix < result_.x.values.size(); ++ix) {
        if (is_of_method(result_.x.key)) set_of_method(one, result_.x.key, result_.x.numbers[ix]);
        if (is_of_method(result_.y.key)) set_of_method(one, result_.y.key, result_.y.numbers[iy]);
        lengthen(one);
        require_possible(one);
        work += std::max(least_work(one), least);
        one.duration = duration;
      }
    require_possible(work, double(result_.cells.size()));
  }

  static void lengthen(Simulation& simulation) {
    simulation.duration = std::max(simulation.duration, kLeastSteps * simulation.step);
  }

  // Once for all cells of one motion, over the longest of their runs.
  void find_scales() {
    const std::size_t nx = result_.x.values.size(), ny = result_.y.values.size();
    const bool one_of_x = is_of_method(result_.x.key), one_of_y = is_of_method(result_.y.key);
    const std::size_t columns = one_of_x ? 1 : nx, rows = one_of_y ? 1 : ny;
    std::vector<double> scales(columns * rows);
    for_each_index(scales.size(), threads_, [&](std::size_t i) {
      Simulation simulation = simulation_of({i % columns, i / columns});
      for (const Sweep* sweep : {&result_.x, &result_.y})
        if (sweep->key == "step")
          simulation.step = *std::max_element(sweep->numbers.begin(), sweep->numbers.end());
      lengthen(simulation);
      scales[i] = energy_scale(simulation, [&](double) { return stop_ && stop_(0); }).value_or(std::numeric_limits<double>::quiet_NaN());
    });
    for (std::size_t iy = 0; iy < ny; ++iy)
      for (std::size_t ix = 0; ix < nx; ++ix)
        cell({ix, iy}).energy_scale = scales[(one_of_y ? 0 : iy) * columns + (one_of_x ? 0 : ix)];
  }

  static bool fits_a_batch(const Simulation& simulation) {
    return simulation.method->name == "semi_implicit_euler" && simulation.torque->is_constant() &&
           !simulation.events && simulation.constraints.empty() && simulation.limit == LimitPolicy::report &&
           !simulation.chain.has_dissipation && simulation.chain.nq == simulation.chain.nv;
  }

  StabilityCell& cell(At at) { return result_.cells[at.y * result_.x.values.size() + at.x]; }

  void run_row(std::size_t iy) {
    const std::string& key = result_.x.key;
    std::optional<Simulation> simulation;
    for (std::size_t ix = 0; ix < result_.x.values.size(); ++ix) {
      if (!simulation || !is_of_method(key)) simulation.emplace(simulation_of({ix, iy}));
      const double duration = simulation->duration;
      if (is_of_method(key)) set_of_method(*simulation, key, result_.x.numbers[ix]);
      lengthen(*simulation);
      run_one(*simulation, cell({ix, iy}));
      simulation->duration = duration;
      done_.add();
      if (stop_ && stop_(done_.with())) return;
    }
  }

  void run_one(Simulation& simulation, StabilityCell& cell) {
    EnergyBalance balance(simulation);
    EnergySeen seen;
    const Trajectory trajectory =
        simulate(simulation, {}, [&](double t) { return stop_ && stop_(done_.with(part_done(simulation, t))); },
                 [&](double, ConstVec q, ConstVec qd, double work) { seen.add(balance.at(q, qd, work)); });
    cell.status = trajectory.status;
    cell.trouble = trajectory.trouble;
    if (!is_complete(trajectory.status)) seen.error = std::numeric_limits<double>::infinity();
    judge(seen, cell.energy_scale, cell);
  }

  void run_batch() {
    const std::size_t count = result_.cells.size(), row = result_.x.values.size();
    std::vector<std::optional<Simulation>> all(count);
    for_each_index(count, threads_, [&](std::size_t i) {
      all[i].emplace(simulation_of({i % row, i / row}));
    });
    lengthen(*all[0]);  // all have its duration and step
    BatchSimulator batch(all[0]->chain, int(count));
    std::vector<EnergySeen> seen(count);
    std::vector<double> tau(std::size_t(all[0]->chain.nv));
    for (std::size_t i = 0; i < count; ++i) {
      Simulation& one = *all[i];
      Workspace ws(one.chain);
      one.torque->evaluate(one.chain, ws, 0, one.q0, one.qd0, tau);
      batch.set_chain(int(i), one.chain);
      batch.set_state(int(i), one.q0, one.qd0);
      batch.set_torque(int(i), tau);
      batch.set_step(int(i), one.step);
    }
    const long steps = std::llround(all[0]->duration / all[0]->step);
    for (int k = 1; k <= kInstants; ++k) {
      batch.run(steps * k / kInstants - steps * (k - 1) / kInstants, threads_);
      for_each_index(count, threads_, [&](std::size_t i) { look_at(batch, int(i), *all[i], seen[i]); });
      if (stop_ && stop_(double(k) / kInstants)) return;
    }
    for (std::size_t i = 0; i < count; ++i) {
      StabilityCell& cell = result_.cells[i];
      if (!std::isfinite(seen[i].error)) cell.status = RunStatus::diverged, cell.trouble = "diverged";
      judge(seen[i], cell.energy_scale, cell);
    }
  }

  static void look_at(const BatchSimulator& batch, int i, Simulation& one, EnergySeen& seen) {
    std::vector<double> q(one.q0.size()), qd(one.qd0.size()), tau(one.qd0.size());
    batch.read_state(i, q, qd);
    Workspace ws(one.chain);
    one.torque->evaluate(one.chain, ws, 0, one.q0, one.qd0, tau);
    double work = 0;
    for (std::size_t k = 0; k < q.size(); ++k) work += tau[k] * (q[k] - one.q0[k]);
    seen.add(EnergyBalance(one).at(q, qd, work));
  }

  // Theory: where one key is the step, for each value of the other; else for each cell at its step.
  void find_boundary() {
    const bool along_x = result_.x.key == "step";
    if (!along_x && result_.y.key != "step") return find_stable_cells();
    const std::size_t count = (along_x ? result_.y : result_.x).values.size();
    for (std::size_t i = 0; i < count; ++i) {
      Simulation simulation = simulation_of(along_x ? At{0, i} : At{i, 0});
      const Linearisation about = linearise_along(simulation);
      result_.about_rest += about.about_target;
      result_.about_motion += about.motion && !about.is_equilibrium && about.along.empty();
      result_.along_runs += !about.along.empty();
      result_.boundary.push_back(longest_stable_step(*simulation.method, about));
      if (!about.motion) continue;
      const std::vector<double>& steps = (along_x ? result_.x : result_.y).numbers;
      const std::size_t row = result_.x.values.size();
      for (std::size_t k = 0; k < steps.size(); ++k)
        if (steps[k] > 0) result_.cells[along_x ? i * row + k : k * row + i].stable = is_stable_step(*simulation.method, about, steps[k]);
    }
    result_.linearised = int(count);
  }

  void find_stable_cells() {
    const std::size_t row = result_.x.values.size();
    std::atomic<int> about_rest = 0, about_motion = 0, along_runs = 0;
    for_each_index(result_.cells.size(), threads_, [&](std::size_t i) {
      Simulation simulation = simulation_of({i % row, i / row});
      const Linearisation start = linearise_along(simulation);
      about_rest += start.about_target;
      about_motion += start.motion && !start.is_equilibrium && start.along.empty();
      along_runs += !start.along.empty();
      if (start.motion && simulation.step > 0)
        result_.cells[i].stable = is_stable_step(*simulation.method, start, simulation.step);
    });
    result_.linearised = int(result_.cells.size());
    result_.about_rest = about_rest;
    result_.about_motion = about_motion;
    result_.along_runs = along_runs;
  }

  std::string scene_;
  std::vector<std::string> overrides_;
  mutable std::mutex readers_lock_;
  mutable std::vector<std::unique_ptr<Reader>> readers_;
  int threads_;
  StopRequest stop_;
  DoneShare done_;  // of the cells
  StabilityCells result_;
};

}  // namespace

StabilityCells run_stability_cells(const std::string& scene, const std::vector<std::string>& overrides,
                                   const Sweep& x, const Sweep& y, int threads, const StopRequest& stop) {
  const double cells = double(x.values.size()) * double(y.values.size());
  if (cells > kMostCells)
    throw Error(ExitCode::limit, "a map of " + std::to_string(x.values.size()) + " times " +
                                     std::to_string(y.values.size()) + " cells takes " + format_significant(cells, 3) +
                                     " runs; the most is " + format_shortest(kMostCells));
  return CellRuns(scene, overrides, x, y, threads, stop).run();
}

}  // namespace chainreel
