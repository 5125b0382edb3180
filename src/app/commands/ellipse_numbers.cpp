#include "app/commands/ellipse_numbers.hpp"

#include <algorithm>

#include "app/film/automatic.hpp"
#include "app/film/house_logo.hpp"
#include "app/film/prepared.hpp"
#include "app/film/runs.hpp"
#include "app/report/report.hpp"
#include "app/report/run_report.hpp"
#include "core/error.hpp"
#include "core/format.hpp"
#include "draw/layers/ellipse.hpp"
#include "draw/page/house_style.hpp"
#include "draw/robot/chain.hpp"
#include "dynamics/equation_of_motion.hpp"
#include "dynamics/inverse_kinematics.hpp"
#include "dynamics/kinematics.hpp"
#include "model/model_description.hpp"
#include "scene/quantity.hpp"
#include "scene/run/pose_doubts.hpp"
#include "scene/run/sweep.hpp"
#include "table/data_table.hpp"

namespace chainreel {
namespace {

Eigen::Vector3d point_of(const Chain& chain, Workspace& ws, const std::vector<double>& q) {
  const std::vector<double> at_rest(std::size_t(chain.nv), 0.0);
  compute_kinematics(chain, ws, q, at_rest);
  return frame_position(chain, ws, chain.end_effector);
}

std::string number_or_inf(const std::optional<double>& value) {
  return value ? format_shortest(*value) : "inf";
}

// At the pose at which `mass` was taken.
std::vector<MassAxis> drawn_axes(const Chain& chain, Workspace& ws, const std::vector<double>& q,
                                 const EffectiveMass& mass, const EllipseForm& form) {
  if (!form.section) return mass_axes(mass);
  const std::vector<double> at_rest(std::size_t(chain.nv), 0.0);
  compute_kinematics(chain, ws, q, at_rest);
  return section_axes(mass, tip_plane(chain, ws), form.reading);
}

// What a force along each axis of the basis moves, as if nothing else held the end effector: 1 / Lambda_inv_ii, kg; nothing
// where it moves nothing.
std::vector<std::optional<double>> masses_along(const EffectiveMass& mass) {
  std::vector<std::optional<double>> masses;
  for (Eigen::Index i = 0; i < mass.Lambda_inv.rows(); ++i) {
    const double mobility = mass.Lambda_inv(i, i);
    constexpr double kRounding = 1e-13;  // of the sum over all axes: what is left of a zero
    const bool is_infinite = !(mobility > kRounding * mass.Lambda_inv.trace());
    masses.push_back(is_infinite ? std::nullopt : std::optional(1 / mobility));
  }
  return masses;
}

}  // namespace

Json ellipse_json(const TipMass& tip, const GatheredPoses& poses, const EllipseForm& form) {
  const Chain& chain = tip.chain();
  Workspace ws(chain);
  Json list = Json::array();
  for (std::size_t i = 0; i < poses.q.size(); ++i) {
    Json entry;
    entry["t"] = i < poses.t.size() ? Json(poses.t[i]) : Json(nullptr);
    entry["q"] = to_json(std::span<const double>(poses.q[i]));
    const EffectiveMass mass = tip.at(ws, poses.q[i]);
    entry["point"] = to_json(point_of(chain, ws, poses.q[i]));
    add_effective_mass(entry, mass);
    entry["mass_along"] = Json::array();
    for (const std::optional<double>& along : masses_along(mass)) entry["mass_along"].push_back(or_null(along));
    entry["eigenvalues"] = entry["semi_axes"] = Json::array();
    for (const MassAxis& axis : mass_axes(mass)) entry["eigenvalues"].push_back(or_null(axis.mass));
    for (const MassAxis& axis : drawn_axes(chain, ws, poses.q[i], mass, form))
      entry["semi_axes"].push_back(or_null(semi_axis(axis, form.reading)));
    list.push_back(entry);
  }
  return list;
}

std::string ellipse_csv(const TipMass& tip, const GatheredPoses& poses, const EllipseForm& form) {
  const Chain& chain = tip.chain();
  Workspace ws(chain);
  const TaskBasis basis = task_basis(chain, Task::linear);
  const std::size_t rows = basis.names.size();
  std::string text = poses.t.empty() ? "" : "t,";
  for (const DescribedCoordinate& one : coordinates_of(chain)) text += with_unit("q." + one.name, one.unit) + ",";
  text += "x [m],y [m],z [m]";
  for (const auto& [symbol, unit] : {std::pair("Lambda_inv_", "1/kg"), std::pair("Lambda_", "kg")})
    for (std::size_t i = 0; i < rows; ++i)
      for (std::size_t j = i; j < rows; ++j) text += "," + with_unit(symbol + basis.names[i] + basis.names[j], unit);
  for (const std::string& name : basis.names) text += "," + with_unit("mass_along_" + name, "kg");
  for (std::size_t i = 1; i <= rows; ++i) {
    text += "," + with_unit("eigenvalue" + std::to_string(i), "kg");
    for (const std::string& name : basis.names) text += ",direction" + std::to_string(i) + "_" + name;
  }
  for (std::size_t i = 0; i < (form.section ? std::min<std::size_t>(rows, 2) : rows); ++i)
    text += "," + with_unit("semi_axis" + std::to_string(i + 1) + "_" + to_string(form.reading), form.reading == EllipseReading::energy ? "m/s" : "kg");
  text += "\n";
  for (std::size_t k = 0; k < poses.q.size(); ++k) {
    if (k < poses.t.size()) text += format_shortest(poses.t[k]) + ",";
    for (const double q : poses.q[k]) text += format_shortest(q) + ",";
    const EffectiveMass mass = tip.at(ws, poses.q[k]);
    const Eigen::Vector3d point = point_of(chain, ws, poses.q[k]);
    text += format_shortest(point.x()) + "," + format_shortest(point.y()) + "," + format_shortest(point.z());
    for (Eigen::Index i = 0; i < Eigen::Index(rows); ++i)
      for (Eigen::Index j = i; j < Eigen::Index(rows); ++j) text += "," + format_shortest(mass.Lambda_inv(i, j));
    for (Eigen::Index i = 0; i < Eigen::Index(rows); ++i)
      for (Eigen::Index j = i; j < Eigen::Index(rows); ++j) text += "," + (mass.Lambda ? format_shortest((*mass.Lambda)(i, j)) : "nan");
    for (const std::optional<double>& along : masses_along(mass)) text += "," + number_or_inf(along);
    for (const MassAxis& axis : mass_axes(mass)) {
      text += "," + number_or_inf(axis.mass);
      for (const Eigen::Vector3d& along : basis.directions) text += "," + format_shortest(axis.direction.dot(along));
    }
    for (const MassAxis& axis : drawn_axes(chain, ws, poses.q[k], mass, form))
      text += "," + number_or_inf(semi_axis(axis, form.reading));
    text += "\n";
  }
  return text;
}

Json joint_space_json(const Chain& chain, const GatheredPoses& poses, std::array<int, 2> joints) {
  Workspace ws(chain);
  Json list = Json::array();
  for (const std::vector<double>& q : poses.q) {
    compute_mass_matrix(chain, ws, q);
    Eigen::MatrixXd part(2, 2);
    for (Eigen::Index i = 0; i < 2; ++i)
      for (Eigen::Index j = 0; j < 2; ++j) part(i, j) = ws.M(joints[std::size_t(i)], joints[std::size_t(j)]);
    list.push_back({{"q", to_json(std::span<const double>(q))},
                    {"joints", {joints[0] + 1, joints[1] + 1}},
                    {"M", to_json(Eigen::MatrixXd(ws.M))},
                    {"image", to_json(part)}});
  }
  return list;
}

namespace {

constexpr int kPosesAlong = 6, kPointsAcross = 12;
// Of a motion: at 10 m/s on a turn of 1 m chords of 5 cm lie 0.3 mm off the path, less than a pixel of 4 m.
constexpr int kPathPoints = 400, kMostPathPoints = 8000, kPathPointsPerSecond = 200;

// What can be typed for this chain: "q1=0:90deg:9", of a slider "q1=0:0.5:9".
std::string sweep_of(const Chain& chain, std::size_t coordinate) {
  const bool slides = std::any_of(chain.bodies.begin() + 1, chain.bodies.end(), [&](const Body& body) {
    return body.joint.kind == JointKind::prismatic && body.joint.q_index == int(coordinate);
  });
  return "q" + std::to_string(coordinate + 1) + (slides ? "=0:0.5:9" : "=0:90deg:9");
}

std::string pose_of_zeros(const Chain& chain) {
  std::string pose;
  for (const double q : zero_configuration(chain)) pose += (pose.empty() ? "" : ",") + format_shortest(q);
  return pose;
}

GatheredPoses swept(const Chain& chain, const PoseSources& sources) {
  if (sources.poses.size() > 1)
    throw Error(ExitCode::usage, "--sweep starts from one --pose, not from several");
  const std::vector<double> from =
      sources.poses.empty() ? zero_configuration(chain) : parse_pose(chain, sources.poses[0], "--pose");
  const Sweep sweep = parse_sweep(sources.sweep, "--sweep", sweep_of(chain, std::size_t(chain.nq - 1)));
  const std::optional<std::size_t> at = coordinate_of(chain, sweep.key);
  if (!at)
    throw Error(ExitCode::usage, "--sweep " + sweep.key + ": " + chain.name + " has no such coordinate; it has q1 to q" +
                                     std::to_string(position_names(chain).size()) + ", like --sweep " +
                                     sweep_of(chain, std::size_t(chain.nq - 1)));
  GatheredPoses gathered;
  std::string doubt;  // one stands for all
  for (const std::string& value : sweep.values) {
    std::vector<double> q = from;
    std::vector<std::string> written(q.size());
    written[*at] = value + sweep.unit;
    const auto refuse = [&](const std::string& why) { throw Error(ExitCode::usage, "--sweep " + sources.sweep + ": " + why); };
    try {
      q[*at] = parse_quantity(value, {});
    } catch (const Error& error) {
      refuse(error.problems().front().message);
    }
    if (const std::string trouble = trouble_of_units(chain, written, StateNumbers::q); !trouble.empty())
      refuse(trouble + ", like --sweep " + sweep_of(chain, *at));
    if (const std::vector<std::string> doubts = doubts_of_pose(chain, q, written); doubt.empty() && !doubts.empty()) doubt = doubts.front();
    gathered.q.push_back(std::move(q));
  }
  if (!doubt.empty()) tell_warnings({"--sweep: " + doubt});
  return gathered;
}

GatheredPoses field_of(const Chain& chain, const PoseSources& sources) {
  PointSolver solver(chain, sources.elbow == "down" ? Elbow::down : Elbow::up);
  const int across = sources.samples > 0 ? sources.samples : kPointsAcross;
  GatheredPoses gathered;
  gathered.cell = 2 * solver.reach() / across;
  const auto turning = std::count_if(chain.bodies.begin() + 1, chain.bodies.end(), [](const Body& body) { return body.joint.kind == JointKind::revolute; });
  if (turning > 1) gathered.branch = chain.nq > 2 ? "joints bend alike" : "elbow " + sources.elbow;
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
    throw Error(ExitCode::usage, "which poses? Give --pose " + pose_of_zeros(chain) + ", --sweep " + sweep_of(chain, std::size_t(chain.nq - 1)) +
                                     ", --along SCENE or --field");
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
  const double wanted = std::clamp(kPathPointsPerSecond * film.scene.duration, double(kPathPoints), double(kMostPathPoints));
  const int between = std::max(1, int(wanted) / (count - 1)), intervals = between * (count - 1);
  std::vector<double> times;
  for (int k = 0; k <= intervals; ++k) times.push_back(film.scene.duration * k / intervals);
  const Runs runs(film, {}, times);
  runs.require_expected_ends();

  const Trajectory& run = runs[0];
  warn_of_run(film.panels.front(), run);
  Motion motion{film.panels.front().simulation.chain, {}, &page_theme(film.scene), film.scene.text_scale,
                film.scene.camera, film.scene.ellipse, film.panels.front().shapes,
                film.panels.front().simulation.constraints, film.scene.video, families_of(film.scene),
                page_logo(film.scene, film.scene.video.height)};
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
