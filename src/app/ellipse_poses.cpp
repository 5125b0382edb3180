#include "app/ellipse_poses.hpp"

#include <algorithm>

#include "app/automatic.hpp"
#include "app/pipeline.hpp"
#include "core/error.hpp"
#include "core/format.hpp"
#include "dynamics/inverse_kinematics.hpp"
#include "dynamics/kinematics.hpp"
#include "scene/quantity.hpp"
#include "scene/sweep.hpp"

namespace chainreel {
namespace {

constexpr int kPosesAlong = 6, kPointsAcross = 12;
constexpr int kPathPoints = 400;  // at least, of a motion

// q1, q2, ... or the name of a coordinate.
std::size_t coordinate_of(const Chain& chain, const std::string& key) {
  const std::vector<std::string> names = position_names(chain);
  for (std::size_t i = 0; i < names.size(); ++i)
    if (key == names[i] || key == "q" + std::to_string(i + 1)) return i;
  throw Error(ExitCode::usage, "--sweep " + key + ": " + chain.name + " has no such coordinate; it has q1 to q" +
                                   std::to_string(names.size()));
}

GatheredPoses swept(const Chain& chain, const PoseSources& sources) {
  if (sources.poses.size() > 1)
    throw Error(ExitCode::usage, "--sweep starts from one --pose, not from several");
  const std::vector<double> from =
      sources.poses.empty() ? zero_configuration(chain) : parse_pose(chain, sources.poses[0], "--pose");
  const Sweep sweep = parse_sweep(sources.sweep, "--sweep");
  const std::size_t at = coordinate_of(chain, sweep.key);
  GatheredPoses gathered;
  for (const std::string& value : sweep.values) {
    std::vector<double> q = from;
    try {
      q[at] = parse_quantity(value, {});
    } catch (const Error& error) {
      throw Error(ExitCode::usage, "--sweep " + sources.sweep + ": " + error.problems().front().message);
    }
    gathered.q.push_back(std::move(q));
  }
  return gathered;
}

GatheredPoses field_of(const Chain& chain, const PoseSources& sources) {
  PointSolver solver(chain, sources.elbow == "down" ? Elbow::down : Elbow::up);
  const int across = sources.samples > 0 ? sources.samples : kPointsAcross;
  GatheredPoses gathered;
  gathered.cell = 2 * solver.reach() / across;
  for (int j = 0; j < across; ++j)
    for (int i = 0; i < across; ++i) {
      const auto place = [&](int k) { return gathered.cell * (k + 0.5) - solver.reach(); };
      const auto q = solver.pose_at(solver.middle() + place(i) * solver.ex() + place(j) * solver.ey());
      if (q) gathered.q.push_back(*q);
    }
  if (gathered.q.empty())
    throw Error(ExitCode::usage, "--field found no point that " + chain.name +
                                     " reaches within its joints' limits: take more --samples or the other --elbow");
  return gathered;
}

}  // namespace

GatheredPoses gather_poses(const Chain& chain, const PoseSources& sources) {
  if (sources.field) {
    if (!sources.sweep.empty() || !sources.poses.empty())
      throw Error(ExitCode::usage, "--field finds its poses itself: leave out --pose and --sweep");
    return field_of(chain, sources);
  }
  if (!sources.sweep.empty()) return swept(chain, sources);
  if (sources.poses.empty())
    throw Error(ExitCode::usage, "which poses? Give --pose 0,90deg, --sweep q2=0:180deg:9, --along SCENE or --field");
  GatheredPoses gathered;
  gathered.q = parse_poses(chain, sources.poses, "--pose");
  return gathered;
}

Motion motion_of(const PoseSources& sources, const CommonOptions& common) {
  if (!sources.sweep.empty() || !sources.poses.empty() || sources.field)
    throw Error(ExitCode::usage, "--along takes its poses from the motion: leave out --pose, --sweep and --field");
  const PreparedFilm film = load_film(sources.along, overrides_of(common), true, common.quiet);
  require_single_run(film.scene);
  say_notices(film.panels.front(), common.quiet);
  const int count = sources.samples > 0 ? sources.samples : kPosesAlong;
  if (count < 2) throw Error(ExitCode::usage, "--samples: a motion has at least two poses, its ends");
  const int between = std::max(1, kPathPoints / (count - 1)), intervals = between * (count - 1);
  std::vector<double> times;
  for (int k = 0; k <= intervals; ++k) times.push_back(film.scene.duration * k / intervals);
  const std::vector<Trajectory> runs = simulate_film(film, times);
  require_expected_ends(film, runs);

  const Trajectory& run = runs.front();
  Motion motion{film.panels.front().simulation.chain, {}, film.scene.theme, film.scene.text_scale,
                film.scene.camera, film.scene.ellipse, film.panels.front().shapes,
                film.panels.front().simulation.constraints, film.scene.video};
  const Chain& chain = motion.chain;
  require_end_effector(chain);
  Workspace ws(chain);
  for (int k = 0; k < run.size(); ++k) {
    compute_kinematics(chain, ws, run.q_at(k), run.qd_at(k));
    motion.poses.path.push_back(frame_position(chain, ws, chain.end_effector));
  }
  for (int i = 0; i < count; ++i) {
    const int k = int(std::int64_t(i) * (run.size() - 1) / (count - 1));
    const auto q = run.q_at(k);
    motion.poses.q.emplace_back(q.begin(), q.end());
    motion.poses.t.push_back(run.t[std::size_t(k)]);
    motion.poses.labels.push_back("t = " + format_significant(run.t[std::size_t(k)], 3) + " s");
  }
  return motion;
}

}  // namespace chainreel
