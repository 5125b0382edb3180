#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <optional>
#include <span>

#include "core/format.hpp"
#include "dynamics/constraints/constrained_dynamics.hpp"
#include "dynamics/constraints/constraint_projection.hpp"
#include "dynamics/constraints/constraint_rows.hpp"
#include "dynamics/constraints/followed_pose.hpp"
#include "dynamics/constraints/pose_search.hpp"
#include "scene/keys/constraints/kind.hpp"
#include "scene/run/prepare.hpp"
#include "sim/system/constraint_plan.hpp"

namespace chainreel {
namespace {

// A start further off than this is more likely another pose than meant.
constexpr double kFarthestMove = 0.5;  // of a coordinate, rad or m
// Less is the rounding of a start that was written with all its digits.
constexpr double kNoteworthy = 1e-9;  // m or rad, and per second
constexpr int kDigitsReadBack = 12;  // of a pose that is on the constraints when it is read back
// What is left of a way to a stretched chain is of order two: where this is left, half of all digits of q are right.
constexpr double kEndOfReach = 1e-6;  // m or rad
// A share of a force: less than it is the rounding of a direction.
constexpr double kBorne = 1e-9;

// The constraints of a scene as the chain knows them. Throws Error with all that is wrong with them.
ConstraintPlan plan_of(const Scene& scene, const Chain& chain) {
  ProblemList problems;
  ConstraintResolver resolver(scene, chain, problems);
  ConstraintPlan plan;
  plan.stabilize = scene.stabilize;
  plan.gain = scene.baumgarte_gain;
  for (const ConstraintEntry& entry : scene.constraints) {
    resolver.begin(entry.place);
    try {
      Constraint constraint = kind_of(entry.form).resolve(entry.form, resolver);
      ConstraintSet(chain, {constraint});
      plan.list.push_back(std::move(constraint));
    } catch (const Error& error) {
      for (const Problem& problem : error.problems())
        problems.add(problem.message, problem.place.file.empty() ? entry.place : problem.place);
    }
  }
  for (const ContactEntry& entry : scene.contact_force) {
    resolver.begin(entry.place);
    plan.contact_forces.push_back(
        {std::size_t(entry.constraint) - 1, resolver.world(entry.force, "'contact_force.force'")});
  }
  problems.throw_if_any();
  return plan;
}

// Why no pose fulfils all constraints: one of them that none fulfils, or that they contradict each other.
[[noreturn]] void refuse_unreachable(const Scene& scene, const Simulation& simulation,
                                     const ConstraintSet& all, const Projection& together) {
  ProblemList problems;
  for (std::size_t k = 0; k < simulation.constraints.list.size(); ++k) {
    const ConstraintSet one(simulation.chain, {simulation.constraints.list[k]});
    const Projection alone = find_pose(simulation.chain, one, simulation.q0).way;
    if (alone.reached) continue;
    const std::string name = "constraint '" + name_of(simulation.constraints.list[k]) + "' ";
    const std::string away = format_significant(alone.after, 3);
    problems.add(alone.after < kEndOfReach
                     ? name + "lies at the very end of reach (the nearest pose that was found leaves it " + away +
                           " away), where the chain can bear any force along itself; move it inwards"
                     : name + "is out of reach: the nearest pose that was found leaves it " + away +
                           " away; move it, or start elsewhere",
                 scene.constraints[k].place);
  }
  problems.throw_if_any();
  std::size_t k = 0;
  while (all.first_row(k + 1) <= together.worst_row) ++k;
  throw Error(
      ExitCode::bad_input,
      "the constraints contradict each other, or their closure is out of reach: each can be met, but the "
      "nearest pose to all leaves '" +
          all.row_names()[std::size_t(together.worst_row)] + "' " + format_significant(together.after, 3) +
          " away; change a length or place, or leave one out",
      scene.constraints[k].place);
}

// What a constraint cannot bear of the force that it is to be pressed with is left out, and said; one that bears no
// force at a frame is refused. After compute_constraints at the start.
void look_at_contact_forces(Scene& scene, const Simulation& simulation, const ConstraintSet& set,
                            const ConstrainedWorkspace& cws) {
  ProblemList problems;
  std::vector<double> lambda(std::size_t(set.rows()));
  const std::vector<ContactForce>& contacts = simulation.constraints.contact_forces;
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    const ContactForce& contact = contacts[i];
    const std::string name = name_of(simulation.constraints.list[contact.constraint]);
    multipliers_of_force(simulation.chain, set, cws, contact.constraint, contact.force, lambda);
    const Eigen::Vector3d borne = contact_force(simulation.chain, set, cws, contact.constraint, lambda);
    const auto numbers = [](const Eigen::Vector3d& f) { return bracketed({f.x(), f.y(), f.z()}) + " N"; };
    if (contact.force.norm() > 0 && borne.norm() <= kBorne * contact.force.norm())
      problems.add("'" + name + "' bears nothing of a contact_force of " + numbers(contact.force) +
                       " at the start: press along what it holds, or another constraint",
                   scene.contact_force[i].place);
    else if (repeats_others(simulation.chain, set, cws, contact.constraint))
      problems.add("'" + name + "' repeats what other constraints hold, which bear part of its force: how much no equation says. Leave one of them out, or press with another",
                   scene.contact_force[i].place);
    else if ((borne - contact.force).norm() > kBorne * contact.force.norm())
      scene.notices.push_back("of the contact_force of " + numbers(contact.force) + ", '" + name + "' bears " +
                              numbers(borne) + " at the start; the rest is left out");
  }
  problems.throw_if_any();
}

std::string named_words(const Chain& chain, const std::vector<double>& q, std::span<const std::size_t> names) {
  std::vector<std::string> words;
  for (const std::size_t i : names) words.push_back(chain.coordinate_names[i] + " = " + format_significant(q[i], 6));
  return joined(words);
}

// As `start: {q: {..}}` has them.
std::string named_keys(const Chain& chain, const std::vector<double>& q, std::span<const std::size_t> names) {
  std::string keys;
  for (const std::size_t i : names) keys += (keys.empty() ? "" : ", ") + chain.coordinate_names[i] + ": " + format_significant(q[i], 6);
  return keys;
}

// Of joints that the start names and that the ties, which leave fewer free, put elsewhere: "; joint2, though named, stands at .. and not at ..".
std::string moved_words(const Chain& chain, std::span<const std::size_t> named, const std::vector<double>& before, const std::vector<double>& now) {
  constexpr double kSeen = 1e-6;  // rad or m
  std::string words;
  for (const std::size_t i : named)
    if (std::fabs(now[i] - before[i]) > kSeen)
      words += "; " + chain.coordinate_names[i] + ", though named, stands at " + format_significant(now[i], 6) + " and not at " + format_significant(before[i], 6) +
               ", as the constraints leave fewer joints free than are named";
  return words;
}

// The pose on the constraints at which the joints that the start names stand as it says; where these are more than the ties leave free the
// first of them do, and the last ones say about where. Nothing where it names none.
std::optional<std::vector<double>> pose_of_named(const Scene& scene, const Simulation& simulation, const ConstraintSet& set, const Place& start) {
  const std::span<const std::size_t> named = scene.start.named_q;
  const Chain& chain = simulation.chain;
  if (chain.has_floating || named.empty()) return std::nullopt;
  FollowedPose nearest;
  for (std::size_t count = named.size(); count > 0; --count) {
    std::vector<bool> held(simulation.q0.size(), false);
    for (const std::size_t i : named.first(count)) held[i] = true;
    FollowedPose found = followed_pose(chain, set, simulation.q0, held, named.subspan(count));
    if (count == named.size()) nearest = found;
    if (!found.is_met) continue;
    const std::span<const std::size_t> about = named.subspan(count);
    const bool is_near = std::ranges::all_of(about, [&](std::size_t i) {
      const double by = found.q[i] - simulation.q0[i];
      return std::abs(by) <= kFarthestMove || std::abs(std::remainder(by, 2 * std::numbers::pi)) <= kFarthestMove;  // by whole turns
    });
    if (is_near) return std::move(found.q);
    throw Error(ExitCode::bad_input,
                "no pose on the constraints was found at which " + named_words(chain, simulation.q0, named) + ", as the start says: with " +
                    named_words(chain, simulation.q0, named.first(count)) + " the nearest has " + named_words(chain, found.q, about) +
                    ". What is named behind the first " + std::to_string(count) + " may be off by " + format_shortest(kFarthestMove) +
                    " rad or m: write what the nearest has, or leave it out, `start: {q: {" + named_keys(chain, simulation.q0, named.first(count)) +
                    "}}`: the others follow",
                start);
  }
  throw Error(ExitCode::bad_input,
              "no pose on the constraints was found at which " + named_words(chain, simulation.q0, named) + ", as the start says: the nearest leaves '" +
                  set.row_names()[std::size_t(nearest.row)] + "' " + format_significant(nearest.away, 3) + " away",
              start);
}

// Lets the rates that the start does not name follow those that it names. False where these cannot be kept.
bool follow_named_rates(const Scene& scene, const ConstraintSet& set, const ConstrainedWorkspace& cws, std::vector<double>& qd) {
  constexpr double kKept = 1e-9;
  const std::vector<std::size_t>& named = scene.start.named_qd;
  std::vector<Eigen::Index> free;
  for (std::size_t i = 0; i < qd.size(); ++i)
    if (std::ranges::count(named, i) == 0) free.push_back(Eigen::Index(i));
  if (free.empty() || named.empty()) return false;
  const Eigen::Map<const Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>> J(cws.Jc.data(), set.rows(), Eigen::Index(qd.size()));
  const Eigen::VectorXd off = J * Eigen::Map<const Eigen::VectorXd>(qd.data(), Eigen::Index(qd.size()));
  const Eigen::MatrixXd of_free = J(Eigen::all, free);
  const Eigen::VectorXd change = of_free.completeOrthogonalDecomposition().solve(-off);
  if ((of_free * change + off).norm() > kKept * (1 + off.norm())) return false;
  for (std::size_t k = 0; k < free.size(); ++k) qd[std::size_t(free[k])] += change[Eigen::Index(k)];
  return true;
}

}  // namespace

void prepare_constraints(Scene& scene, Simulation& simulation) {
  const Chain& chain = simulation.chain;
  simulation.constraints = plan_of(scene, chain);
  if (simulation.constraints.empty()) return;
  const ConstraintSet set(chain, simulation.constraints.list);
  ConstrainedWorkspace cws(chain, set);
  Workspace ws(chain);
  std::vector<double> qd = simulation.qd0;
  const Place start =
      scene.place_of("start.q").line > 0 ? scene.place_of("start.q") : scene.place_of("constraints");
  const std::optional<std::vector<double>> followed = pose_of_named(scene, simulation, set, start);
  auto [way, q] = find_pose(chain, set, followed ? *followed : simulation.q0);
  if (!way.reached) refuse_unreachable(scene, simulation, set, way);
  compute_constraints(chain, ws, set, cws, q, qd);
  if (const int row = reversed_row(ws, set); row >= 0)
    throw Error(ExitCode::bad_input,
                "the start holds '" + set.row_names()[std::size_t(row)] +
                    "' the wrong way round, half a turn off: start nearer to the pose that is meant",
                start);
  const std::string measure = row_units(chain, simulation.constraints.list)[std::size_t(way.worst_row)].error;
  const std::string unit = measure.empty() ? "" : " " + measure;
  double moved = 0;
  for (std::size_t i = 0; i < q.size(); ++i) moved = std::max(moved, std::fabs(q[i] - simulation.q0[i]));
  // One that nobody wrote may be anywhere.
  const bool is_written = std::any_of(scene.places.begin(), scene.places.end(), [](const auto& one) { return one.first.starts_with("start.q"); });
  if (moved > kFarthestMove && is_written && !followed)
    throw Error(ExitCode::bad_input,
                "the start is " + format_significant(way.before, 3) + unit + " off '" +
                    set.row_names()[std::size_t(way.worst_row)] +
                    "'; the pose found on the constraints is far from it, by " +
                    format_significant(moved, 3) + " in a coordinate: write `start: {q: " + bracketed(q, kDigitsReadBack) +
                    "}` if it is meant, or name the joints that are to stand so, `start: {q: {" + chain.coordinate_names.front() + ": " +
                    format_significant(simulation.q0.front(), 6) + "}}`: the others follow",
                start);
  if (followed && q != simulation.q0) scene.notices.push_back("the joints whose angles the constraints decide follow: q = " + bracketed(q) + moved_words(chain, scene.start.named_q, simulation.q0, q));
  const bool follow = follow_named_rates(scene, set, cws, qd);
  if (follow) scene.notices.push_back("the rates that the start does not name follow: qd = " + bracketed(qd));
  const double rate = follow ? 0 : project_velocities(chain, ws, set, cws, q, qd);
  if (way.before > kNoteworthy)
    scene.notices.push_back("the start was " + format_significant(way.before, 3) + unit + " off '" +
                            set.row_names()[std::size_t(way.worst_row)] +
                            "' and was moved to q = " + bracketed(q));
  if (rate > kNoteworthy)
    scene.notices.push_back("the start's rates left the constraints by " + format_significant(rate, 3) +
                            " a second and were changed to qd = " + bracketed(qd));
  simulation.q0 = scene.start.q = q;
  simulation.qd0 = scene.start.qd = qd;
  compute_constraints(chain, ws, set, cws, q, qd);
  look_at_contact_forces(scene, simulation, set, cws);
}

}  // namespace chainreel
