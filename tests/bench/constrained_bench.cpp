// Constrained forward dynamics beside MuJoCo's `connect`: the pen on a line, the pinned tip (a four-bar
// linkage of three rods), the same pinned twice, a seven-joint arm whose tip is pinned, the same twice.
//
// Rule: 64 random states, projected onto the constraints; a call for each in turn, all engines in turn, round
// after round. Reported are the median and the lowest of the rounds' processor time per call. The residual is
// the largest |Jc qdd + Jcd_qd| over 100 such states. MuJoCo's constraints are soft, so its residual is what
// it strays by; its pen holds on to a sleigh of 1 mg on a rail, since it has no lines.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>
#include <optional>
#include <stdexcept>

#include "bench/chains.hpp"
#include "bench/results.hpp"
#include "core/format.hpp"
#include "dynamics/constraints/constrained_dynamics.hpp"
#include "dynamics/constraints/constraint_projection.hpp"
#include "dynamics/constraints/constraint_rows.hpp"
#include "dynamics/kinematics.hpp"
#include "peers/mujoco_chain.hpp"
#include "support/chains.hpp"

namespace chainreel::bench {
namespace {

constexpr int kRounds = 31;
constexpr int kCalls = 64 * 30;
constexpr int kCheckedStates = 100;

struct Case {
  std::string name;
  Chain chain;
  std::vector<Constraint> ties;
  std::optional<double> most_ns, least_ratio;
};

class Ours {
 public:
  explicit Ours(const Case& given)
      : chain_(given.chain), set_(chain_, given.ties), ws_(chain_), cws_(chain_, set_) {}

  // A random state on the constraints.
  test::State state(test::Random& random) {
    for (int tries = 0; tries < 1000; ++tries) {
      test::State s = test::random_state(chain_, random);
      if (!project_positions(chain_, ws_, set_, cws_, s.q).reached) continue;
      project_velocities(chain_, ws_, set_, cws_, s.q, s.qd);
      return s;
    }
    throw std::runtime_error("no state on the constraints was found");
  }

  const std::vector<double>& qdd_of(const test::State& s) {
    status_ = compute_constrained_dynamics(chain_, ws_, set_, cws_, s.q, s.qd, s.tau);
    return ws_.qdd;
  }
  ConstraintStatus status() const { return status_; }

  double residual(const test::State& s, const std::vector<double>& qdd) {
    compute_constraints(chain_, ws_, set_, cws_, s.q, s.qd);
    const auto nv = std::size_t(chain_.nv);
    double largest = 0;
    for (std::size_t i = 0; i < cws_.Jcd_qd.size(); ++i) {
      double sum = cws_.Jcd_qd[i];
      for (std::size_t v = 0; v < nv; ++v) sum += cws_.Jc[i * nv + v] * qdd[v];
      if (!(std::abs(sum) <= largest)) largest = std::abs(sum);
    }
    return largest;
  }
  const Frame& tip() const { return chain_.frames[std::size_t(chain_.end_effector)]; }

 private:
  Chain chain_;
  ConstraintSet set_;
  Workspace ws_;
  ConstrainedWorkspace cws_;
  ConstraintStatus status_ = ConstraintStatus::regular;
};

// The tip tied to a place, or to a sleigh on a rail through it.
class Mujoco {
 public:
  Mujoco(const Case& given, const Ours& ours) : nv_(std::size_t(given.chain.nv)) {
    Chain chain = given.chain;
    const bool line = std::holds_alternative<LineConstraint>(given.ties.front());
    Eigen::Vector3d place;
    if (line) {
      const auto& tie = std::get<LineConstraint>(given.ties.front());
      Body sleigh;
      sleigh.name = "sleigh";
      sleigh.parent = 0;
      sleigh.joint.kind = JointKind::prismatic;
      sleigh.joint.axis = tie.direction;
      sleigh.joint.name = "rail";
      sleigh.joint.X_PJ = Eigen::Isometry3d(Eigen::Translation3d(tie.point));
      sleigh.inertia.mass = 1e-6;
      chain.bodies.push_back(sleigh);
      test::finish(chain);
      place.setZero();
    } else {
      place = std::get<PointConstraint>(given.ties.front()).at;
    }
    const std::string first = "b" + std::to_string(ours.tip().body);
    const std::string second = line ? "b" + std::to_string(chain.bodies.size() - 1) : "world";
    std::string equality;
    for (std::size_t k = 0; k < given.ties.size(); ++k)
      equality += "<connect body1=\"" + first + "\" body2=\"" + second + "\" anchor=\"0 0 0\"/>";
    chain_ = std::make_unique<peers::MujocoChain>(chain, equality);
    for (std::size_t k = 0; k < given.ties.size(); ++k)
      chain_->connect(int(k), ours.tip().X_BF.translation(), place);
  }

  void set(const test::State& s, const Eigen::Vector3d& tip_place) {
    mjData* d = chain_->data();
    const auto all = std::size_t(chain_->model()->nv);
    for (std::size_t i = 0; i < nv_; ++i) {
      d->qpos[i] = s.q[i];
      d->qvel[i] = s.qd[i];
      d->qfrc_applied[i] = s.tau[i];
    }
    if (all > nv_) d->qpos[nv_] = tip_place.x();
  }
  void forward() { mj_forward(chain_->model(), chain_->data()); }
  std::vector<double> qdd() { return {chain_->data()->qacc, chain_->data()->qacc + nv_}; }

 private:
  std::size_t nv_;
  std::unique_ptr<peers::MujocoChain> chain_;
};

template <class Call>
double ns_per_call(const Call& call) {
  const double begin = processor_seconds();
  for (std::size_t k = 0; k < std::size_t(kCalls); ++k) call(k % kStates);
  return (processor_seconds() - begin) * 1e9 / kCalls;
}

double lowest_of(const std::vector<double>& values) {
  return *std::min_element(values.begin(), values.end());
}

void measure(const Case& one, Results& results) {
  Ours ours(one);
  Mujoco mujoco(one, ours);
  test::Random random(17);
  std::vector<test::State> states;
  for (int k = 0; k < kCheckedStates; ++k) states.push_back(ours.state(random));
  Workspace ws(one.chain);
  std::vector<Eigen::Vector3d> tips;
  double residual = 0, their_residual = 0;
  for (const test::State& s : states) {
    const std::vector<double> qdd = ours.qdd_of(s);
    if (ours.status() != ConstraintStatus::regular && ours.status() != ConstraintStatus::redundant)
      throw std::runtime_error(one.name + ": " + to_string(ours.status()));
    residual = std::max(residual, ours.residual(s, qdd));
    compute_kinematics(one.chain, ws, s.q, s.qd);
    tips.push_back(frame_position(one.chain, ws, one.chain.end_effector));
    mujoco.set(s, tips.back());
    mujoco.forward();
    their_residual = std::max(their_residual, ours.residual(s, mujoco.qdd()));
  }

  std::vector<double> ours_ns, mujoco_ns;
  for (int round = 0; round < kRounds; ++round) {
    ours_ns.push_back(ns_per_call([&](std::size_t k) { ours.qdd_of(states[k]); }));
    mujoco_ns.push_back(ns_per_call([&](std::size_t k) {
      mujoco.set(states[k], tips[k]);
      mujoco.forward();
    }));
  }
  const double ratio = lowest_of(mujoco_ns) / lowest_of(ours_ns);
  const std::string goal_ns = one.most_ns ? format_shortest(*one.most_ns) : "";
  const std::string goal_ratio = one.least_ratio ? format_shortest(*one.least_ratio) : "";
  std::printf(
      "%-12s ours %8.1f ns (lowest %.1f, goal %s), MuJoCo %9.1f ns, ratio of lowest %.1f (goal %s), "
      "residual %.1e, MuJoCo's %.1e\n",
      one.name.c_str(), median_of(ours_ns), lowest_of(ours_ns), goal_ns.c_str(), median_of(mujoco_ns), ratio,
      goal_ratio.c_str(), residual, their_residual);
  results.add({one.name, format_fixed(median_of(ours_ns), 1), format_fixed(lowest_of(ours_ns), 1), goal_ns,
               format_fixed(median_of(mujoco_ns), 1), format_fixed(lowest_of(mujoco_ns), 1),
               format_fixed(ratio, 1), goal_ratio, format_significant(residual, 2),
               format_significant(their_residual, 2)});
}

void run() {
  Results results("constrained",
                  {"case", "median_ns", "lowest_ns", "goal_ns", "mujoco_median_ns", "mujoco_lowest_ns",
                   "ratio_of_lowest", "goal_ratio", "residual", "mujoco_residual"});
  const std::vector<NamedChain> chains = timed_chains();
  const Chain& rrr = chains.at(1).chain;
  const Chain& arm = chains.at(2).chain;
  const auto tip_of = [](const Chain& chain) { return chain.frames[std::size_t(chain.end_effector)].name; };
  const LineConstraint line{tip_of(rrr), {0, 0.5, 0}, {1, 0, 0}};
  const PointConstraint pin{tip_of(rrr), {1.2, 0.3, 0}};
  const PointConstraint place{tip_of(arm), {0.35, 0.15, 0.5}};
  measure({"pen", rrr, {line}, 80, 35}, results);
  measure({"four-bar", rrr, {pin}, 80, 35}, results);
  measure({"twins", rrr, {pin, pin}, {}, {}}, results);
  measure({"arm7", arm, {place}, 1300, {}}, results);
  measure({"arm7 twins", arm, {place, place}, 2500, {}}, results);
  results.write();
}

}  // namespace
}  // namespace chainreel::bench

int main() {
  return chainreel::bench::run_main(chainreel::bench::run);
}
