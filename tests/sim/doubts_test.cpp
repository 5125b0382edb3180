// What speaks against a run: each fault is found, and sound runs are let be.

#include <algorithm>

#include "sim/doubts.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "model/link_chain.hpp"
#include "model/read_chain.hpp"
#include "sim/rank_loss.hpp"
#include "sim/runs.hpp"
#include "sim/system/constrained_chain.hpp"
#include "support/chains.hpp"
#include "support/temporary_folder.hpp"

namespace chainreel {
namespace {

using ::testing::HasSubstr;

std::vector<Doubt> doubts(const Simulation& run, double dt = 1.0 / 60) {
  const Trajectory trajectory = simulate(run, instants(run.duration, dt));
  EXPECT_EQ(trajectory.status, RunStatus::finished) << trajectory.trouble;
  return doubts_of(run, trajectory, audit_of(run, trajectory), {});
}

std::vector<std::string> kinds(const Simulation& run) {
  std::vector<std::string> names;
  for (const Doubt& doubt : doubts(run)) names.push_back(doubt.kind);
  return names;
}

// A body of 1 kg that floats without weight and carries a link of some grams, whose joint has 0.1 N m of friction:
// tanh(qd / 0.01) pulls it with a rate of 10 N m s over 2e-5 kg m^2, 5e5 /s.
Simulation light_link_with_friction(const std::string& method, double step) {
  Simulation run;
  run.chain = test::random_tree(4, {.bodies = 2, .serial = true, .floating_base = true, .prismatic = 0});
  run.chain.gravity.setZero();
  run.chain.bodies[2].inertia = {0.01, {0.02, 0, 0}, Eigen::Vector3d(1e-5, 1e-5, 1e-5).asDiagonal()};
  run.chain.bodies[2].joint.friction = 0.1;
  run.chain.has_dissipation = true;
  test::finish(run.chain);
  run.q0 = zero_configuration(run.chain);
  run.qd0.assign(std::size_t(run.chain.nv), 0);
  run.qd0[3] = 1, run.qd0[4] = 0.5;
  run.torque = make_torque_law(run.chain, std::vector<TorqueEntry>(run.qd0.size()), {});
  run.method = &find_method(method);
  run.step = step;
  run.duration = 1;
  if (step == 0) run.options.tolerance = 1e-8;
  return run;
}

double last_rate(const Simulation& run) {
  double largest = 0;
  const Trajectory path = simulate(run, instants(1, 0.1));
  for (int k = 5; k < path.size(); ++k) largest = std::max(largest, std::abs(path.qd_at(k).back()));
  return largest;
}

TEST(Doubts, FindAStepTooLongForTheFrictionOfALightLink) {
  const Simulation run = light_link_with_friction("rk4", 2e-4), truth = light_link_with_friction("radau5", 0);
  EXPECT_GT(last_rate(run), 1000 * last_rate(truth));  // it shakes, and should creep
  const std::vector<Doubt> found = doubts(run);
  ASSERT_FALSE(found.empty());
  EXPECT_EQ(found.back().kind, "step");
  EXPECT_THAT(found.back().words, HasSubstr("'" + run.chain.coordinate_names.back() + "'"));
  EXPECT_THAT(found.back().remedy, HasSubstr("--set method=radau5"));
  EXPECT_THAT(kinds(truth), ::testing::IsEmpty());
  Simulation fine = light_link_with_friction("rk4", 2e-6);
  fine.duration = 0.1;
  EXPECT_THAT(kinds(fine), ::testing::IsEmpty());
}

TEST(Doubts, FindEnergyThatAMethodMakes) {
  const std::vector<Doubt> found = doubts(run_of("rr", {}, 10, "explicit_euler", 0.02));
  ASSERT_GE(found.size(), 1u);
  EXPECT_EQ(found[0].kind, "energy");
  EXPECT_GT(found[0].amount, kDoubtfulEnergy);
  EXPECT_THAT(found[0].words, HasSubstr("J at t = "));
  EXPECT_THAT(found[0].remedy, HasSubstr("--set step="));
}

TEST(Doubts, LetSoundRunsBe) {
  for (const auto& [method, step] : {std::pair{"rk4", 0.005}, {"verlet", 0.001}, {"gauss4", 0.01}, {"semi_implicit_euler", 1e-4},
                                     {"explicit_euler", 1e-5}})
    EXPECT_THAT(kinds(run_of("rr", {}, 2, method, step)), ::testing::IsEmpty()) << method;
  // One jump of a torque within a step is one step's error, not the method's failure.
  EXPECT_THAT(kinds(run_of("rr", {"5*(t>0.5003)"}, 2, "rk4", 0.001)), ::testing::IsEmpty());
  // Nothing moves: rounding is no doubt.
  Simulation still = run_of("rr", {"0", "0"}, 1, "rk4", 0.001);
  still.q0 = {-1.5707963267948966, 0};
  EXPECT_THAT(kinds(still), ::testing::IsEmpty());
}

TEST(Doubts, FindConstraintsThatAreLeft) {
  Simulation run = run_of("rrr", {}, 2, "explicit_euler", 0.005);
  run.q0 = {1.5707963267948966, -1.5707963267948966, -0.5235987755982988};
  run.constraints.list = {LineConstraint{"gripper", {0, 0.5, 0}, {1, 0, 0}}};
  run.constraints.stabilize = Stabilization::none;
  EXPECT_THAT(kinds(run), ::testing::Contains("constraint"));
  run.constraints.stabilize = Stabilization::project;
  EXPECT_THAT(kinds(run), ::testing::Not(::testing::Contains("constraint")));
}

TEST(Doubts, AreNoneOfARunThatDidNotComeToItsEnd) {
  Simulation run = run_of("rr", {"-1e7*qd1", "0"}, 1, "rk4", 0.01);
  run.qd0 = {1, 0};
  const Trajectory trajectory = simulate(run, instants(1, 0.05));
  ASSERT_EQ(trajectory.status, RunStatus::diverged);
  EXPECT_TRUE(doubts_of(run, trajectory, audit_of(run, trajectory), {}).empty());
}

// A pendulum on its head: nothing moves it but the rounding of cos(pi / 2).
TEST(Doubts, FindAStartThatOnlyRoundingMoves) {
  constexpr double kUp = 1.5707963267948966;
  const auto rests = [](std::vector<double> q, std::vector<std::string> torque = {}, double duration = 6) {
    Simulation run = run_of("rr", std::move(torque), duration, "rk4", 0.005);
    run.q0 = std::move(q);
    const std::vector<std::string> all = kinds(run);
    return std::count(all.begin(), all.end(), "rest");
  };
  EXPECT_EQ(rests({kUp, 0}), 1);
  EXPECT_EQ(rests({-kUp, 2 * kUp}, {}, 10), 1) << "the second link alone, and rounding does not move this one";
  EXPECT_EQ(rests({kUp, 0}, {"max(0, t - 7)", "0"}, 8), 1) << "what acts later comes too late";
  // Negative controls: it hangs; it is held; it stands beside; it has no time to leave; it is moved later; nothing acts.
  EXPECT_EQ(rests({-kUp, 0}), 0);
  EXPECT_EQ(rests({kUp, 0}, {"-500 * (q1 - pi / 2) - 50 * qd1", "-500 * q2 - 50 * qd2"}), 0);
  EXPECT_EQ(rests({kUp + 1e-6, 0}), 0);
  EXPECT_EQ(rests({kUp, 0}, {}, 0.5), 0);
  EXPECT_EQ(rests({kUp, 0}, {"max(0, t - 1)", "0"}, 2), 0);
  Simulation weightless = run_of("rr", {}, 6, "rk4", 0.005);
  weightless.chain.gravity.setZero();
  EXPECT_THAT(kinds(weightless), ::testing::IsEmpty());
  Simulation run = run_of("rr", {}, 6, "rk4", 0.005);
  run.q0 = {kUp, 0};
  const std::vector<Doubt> found = doubts(run);
  ASSERT_FALSE(found.empty());
  EXPECT_THAT(found.front().words, HasSubstr("only rounding can move it, which grows e-fold every 0.17 s"));
  EXPECT_THAT(found.front().remedy, HasSubstr("--set start.q."));
}

// A loop of 0.3, 0.6, 0.4 and 0.7 m: 0.3 + 0.7 = 0.6 + 0.4, so that all lie on one line once a turn, where its two rows are one. The crank turns at about
// 3 rad/s, so that it is there a little after a turn of 1.6 rad.
Simulation loop(const std::string& method, double step, double ground, double duration) {
  Simulation run;
  ModelOptions weightless;
  weightless.gravity = Eigen::Vector3d(0, 0, 0);
  const TemporaryFolder folder;
  LinkChain links;
  links.links = {0.3, 0.6, 0.4};
  EXPECT_TRUE(complete(links).empty());
  run.chain = read_chain(folder.write("loop.urdf", urdf_of(links, "loop")), weightless);
  run.torque = make_torque_law(run.chain, std::vector<TorqueEntry>(3), {});
  run.method = &find_method(method);
  run.step = step;
  if (step == 0) run.options.tolerance = 1e-12;
  run.duration = duration;
  run.constraints.list = {PointConstraint{"gripper", {ground, 0, 0}}};
  run.q0 = {1.5707963267948966, -1.43, -1.45};
  run.qd0 = {3, -3.4, 2.65};
  ConstrainedChain chain(run.chain, run.constraints);
  Workspace ws(run.chain);
  chain.project(ws, run.q0, run.qd0);
  return run;
}

TEST(Doubts, FindAPoseWhereTheWayOnIsOpen) {
  for (const auto& [method, step] : {std::pair("semi_implicit_euler", 1e-3), std::pair("rk4", 1e-3), std::pair("dop853", 0.0)}) {
    const Simulation run = loop(method, step, 0.7, 2);
    const std::vector<Doubt> found = doubts(run);
    const auto rank = std::find_if(found.begin(), found.end(), [](const Doubt& one) { return one.kind == "rank"; });
    ASSERT_NE(rank, found.end()) << method;
    EXPECT_THAT(rank->words, HasSubstr("at t = 0.55")) << method;
    EXPECT_THAT(rank->remedy, HasSubstr("--set duration=0.5")) << method;
    for (const Doubt& doubt : found) EXPECT_EQ(doubt.remedy, rank->remedy) << doubt.kind << ": no other method helps";
    // Negative controls: as told; a ground that is longer by a millionth; by a twentieth.
    EXPECT_THAT(kinds(loop(method, step, 0.7, 0.54)), ::testing::Not(::testing::Contains("rank"))) << method;
    EXPECT_THAT(kinds(loop(method, step, 0.735, 2)), ::testing::Not(::testing::Contains("rank"))) << method;
  }
  EXPECT_THAT(kinds(loop("dop853", 0, 0.7 + 1e-5, 2)), ::testing::Not(::testing::Contains("rank"))) << "it turns round 5 mrad before";
}

// The parallelogram started in its change point is a pendulum of one freedom, q'' = -22.0725 cos q for links of (0.3, 0.5, 0.3, 0.5) m: it passes that pose
// again, and every passage is told.
TEST(Doubts, TellEveryPassageOfSuchAPose) {
  Simulation run = run_of("four_bar_parallel", {}, 1, "rk4", 1e-3);
  run.constraints.list = {CloseConstraint{"rocker_end", "ground_pin"}};
  run.q0 = {0, 0, -3.14159265358979312};
  run.qd0 = {2, -2, 2};
  ConstrainedChain chain(run.chain, run.constraints);
  Workspace ws(run.chain);
  chain.project(ws, run.q0, run.qd0);
  const Trajectory trajectory = simulate(run, instants(1, 1.0 / 60));
  std::vector<double> passed;  // where the crank lies on the ground's line
  const Trajectory dense = simulate(run, instants(1, 1e-4));
  for (int k = 1; k < dense.size(); ++k)
    if (std::sin(dense.q_at(k - 1)[0]) * std::sin(dense.q_at(k)[0]) < 0) passed.push_back(dense.t[std::size_t(k)]);
  ASSERT_GE(passed.size(), 2u);
  const std::vector<RankLoss> losses = rank_losses_of(run, trajectory);
  ASSERT_EQ(losses.size(), passed.size() + 1) << "and the start";
  EXPECT_EQ(losses[0].t, 0);
  for (std::size_t k = 0; k < passed.size(); ++k) EXPECT_NEAR(losses[k + 1].t, passed[k], 1e-3);  // the pose is left by a thousandth
  const std::optional<Doubt> doubt = doubt_of_rank(run, trajectory);
  ASSERT_TRUE(doubt);
  EXPECT_THAT(doubt->words, HasSubstr("at t = 0, "));
  EXPECT_THAT(doubt->words, HasSubstr(" and "));
}

// However far apart its samples are, and however often it is there: the first instant is told.
TEST(Doubts, FindTheFirstSuchPoseBetweenFewSamples) {
  const auto rank_of = [](const Simulation& run, double dt) -> std::string {
    for (const Doubt& doubt : doubts(run, dt))
      if (doubt.kind == "rank") return doubt.words.substr(0, doubt.words.find(" s ")) + "; " + doubt.remedy.substr(0, doubt.remedy.find(','));
    return "";
  };
  for (const double dt : {1.0, 0.5, 1.0 / 3, 0.25, 0.2, 0.1}) EXPECT_THAT(rank_of(loop("rk4", 1e-3, 0.7, 2), dt), HasSubstr("at t = 0.55")) << dt;
  // Fifteen and thirty times as fast.
  for (const double times : {15.0, 30.0}) {
    Simulation fast = loop("rk4", 1e-4, 0.7, 0.5);
    for (double& rate : fast.qd0) rate *= times;
    const std::string said = rank_of(fast, 1.0 / 60);
    EXPECT_THAT(said, HasSubstr(times == 15 ? "at t = 0.0369" : "at t = 0.0184")) << said;
    EXPECT_THAT(said, HasSubstr(times == 15 ? "duration=0.036" : "duration=0.018")) << said;
    fast.duration = times == 15 ? 0.036 : 0.018;
    EXPECT_EQ(rank_of(fast, 1.0 / 60), "") << "as told";
    fast.duration = 0.0201;
    EXPECT_EQ(rank_of(fast, 1.0 / 60).empty(), times == 15) << "two samples";
  }
}

// A chain that its constraints hold altogether is at rest, and nothing speaks against that.
TEST(Doubts, AreNoneOfAChainWithoutFreedom) {
  Simulation run = run_of("rr", {}, 1, "rk4", 0.01);
  run.constraints.list = {JointConstraint{run.chain.coordinate_names[0], 0}, JointConstraint{run.chain.coordinate_names[1], 0}};
  EXPECT_THAT(kinds(run), ::testing::IsEmpty());
}

}  // namespace
}  // namespace chainreel
