// A motion that was recorded: its states, what it takes, and what of a table is none.
#include "sim/drive/recorded_motion.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <sstream>

#include "core/format.hpp"
#include "sim/audit.hpp"
#include "sim/doubts.hpp"
#include "sim/runs.hpp"
#include "sim/torques_along.hpp"
#include "support/temporary_folder.hpp"

namespace chainreel {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

// The rr's motion under torques of 1 and -0.5 N m, whose inverse dynamics must give them back.
const std::vector<double> kTau{1, -0.5};

// Rows every `h` of 1 s, of the quantities that are named.
std::string table_text(double h, const std::vector<std::string>& quantities) {
  std::ostringstream text;
  text << "t";
  for (const std::string& name : quantities) text << "," << name << "1," << name << "2";
  text << "\n";
  Simulation run = run_of("rr", {"1", "-0.5"}, 1, "dop853", 0);
  run.options.tolerance = 1e-13;
  const Trajectory motion = simulate(run, instants(1, h));
  ChainSystem system(run);
  std::vector<double> qdd(2);
  for (int k = 0; k < motion.size(); ++k) {
    const double t = motion.t[std::size_t(k)];
    system.acceleration(t, motion.q_at(k), motion.qd_at(k), qdd);
    text << format_shortest(t);
    for (const std::string& name : quantities)
      for (const double x : name == "q" ? motion.q_at(k) : name == "qd" ? motion.qd_at(k) : std::span<const double>(qdd))
        text << "," << format_shortest(x);
    text << "\n";
  }
  return text.str();
}

class Recorded : public ::testing::Test {
 protected:
  std::shared_ptr<const RecordedMotion> motion(const std::string& text, const ColumnNames& names = {}) {
    const std::string path = folder_.write("log.csv", text);
    const Chain chain = run_of("rr", {"0", "0"}, 1).chain;
    return std::make_shared<const RecordedMotion>(chain, std::make_shared<const Table>(read_log(path, names)), names);
  }
  std::string error(const std::string& text, const ColumnNames& names = {}) {
    try {
      motion(text, names);
      return "";
    } catch (const Error& caught) {
      EXPECT_EQ(caught.code(), ExitCode::bad_input);
      return caught.what();
    }
  }
  Simulation replayed(const std::string& text) {
    Simulation run = run_of("rr", {"0", "0"}, 1);
    replay(run, motion(text));
    run.duration = run.motion->end();
    return run;
  }
  // The largest difference of the torques at the rows from those that made the motion.
  double torque_error(double h, const std::vector<std::string>& quantities) {
    const Simulation run = replayed(table_text(h, quantities));
    const Trajectory shown = simulate(run, instants(1, h));
    const std::vector<double> tau = torques_along(run, shown);
    double largest = 0;
    for (std::size_t i = 0; i < tau.size(); ++i) largest = std::max(largest, std::fabs(tau[i] - kTau[i % 2]));
    return largest;
  }

 private:
  TemporaryFolder folder_;
};

TEST_F(Recorded, StatesAreTheTablesAndTorquesThoseThatMadeThem) {
  const Simulation run = replayed(table_text(0.02, {"q", "qd", "qdd"}));
  const Table table = read_csv(TemporaryFolder().write("again.csv", table_text(0.02, {"q", "qd", "qdd"})));
  const Trajectory shown = simulate_audited(run, instants(1, 0.02));
  ASSERT_EQ(shown.size(), 51);
  EXPECT_EQ(shown.evaluations, 0);
  EXPECT_EQ(shown.steps, 50);
  for (int k = 0; k < shown.size(); ++k)
    for (std::size_t i = 0; i < 2; ++i) {
      EXPECT_EQ(shown.q_at(k)[i], table.columns[1 + i][std::size_t(k)]);
      EXPECT_EQ(shown.qd_at(k)[i], table.columns[3 + i][std::size_t(k)]);
    }
  const std::vector<double> tau = torques_along(run, shown);
  // Sums of terms of some 30 N m in doubles; those of the forward dynamics before.
  for (std::size_t i = 0; i < tau.size(); ++i) EXPECT_NEAR(tau[i], kTau[i % 2], 1e-12);
  EXPECT_THAT(run.motion->remarks(), IsEmpty());
  EXPECT_THAT(doubts_of(run, shown, audit_of(run, shown), {}), IsEmpty());
}

TEST_F(Recorded, TorquesHaveTheOrderOfTheDerivatives) {
  // Halving h divides the error of a second derivative of a spline by 4, of a first derivative at the ends by 8.
  const double q_alone = torque_error(0.01, {"q"}) / torque_error(0.005, {"q"});
  const double with_rates = torque_error(0.01, {"q", "qd"}) / torque_error(0.005, {"q", "qd"});
  EXPECT_NEAR(std::log2(q_alone), 2, 0.4);
  EXPECT_NEAR(std::log2(with_rates), 3, 0.4);
  EXPECT_LT(torque_error(0.005, {"q", "qd", "qdd"}), 1e-12);
  EXPECT_GT(torque_error(0.005, {"q"}), 1e-6);  // negative control: derivatives are no knowledge
}

// What is not told has to be derived, and every other row alone says how well: three times the error of a smooth motion, as that
// goes with h^2; where accelerations jump about as much. With rates alone the ends are worst, with h^3: seven times.
TEST_F(Recorded, EveryOtherRowTellsHowFarTorquesMayBeOff) {
  for (const double h : {0.02, 0.01}) {
    const auto q_alone = motion(table_text(h, {"q"}))->coarse_torques(), with_rates = motion(table_text(h, {"q", "qd"}))->coarse_torques();
    ASSERT_TRUE(q_alone && with_rates);
    EXPECT_NEAR(q_alone->largest / torque_error(h, {"q"}), 3, 1) << h;
    EXPECT_GT(with_rates->largest / torque_error(h, {"q", "qd"}), 2.5) << h;
    EXPECT_LT(with_rates->largest / torque_error(h, {"q", "qd"}), 9) << h;
  }
  EXPECT_FALSE(motion(table_text(0.01, {"q", "qd", "qdd"}))->coarse_torques()) << "nothing is derived";
  EXPECT_FALSE(motion("t,q1,q2\n0,0,0\n1,0.1,0.1\n2,0.2,0.1\n")->coarse_torques()) << "too few rows";
  // q2 begins to turn at 0.5 s with 8 rad/s^2: M22 = 1/3 kg m^2, 1 kg at 1 m (models/rr.urdf).
  for (const bool has_rates : {false, true})
    for (const double at : {0.5, 0.505, 0.51}) {
      std::string text = has_rates ? "t,q1,q2,qd1,qd2\n" : "t,q1,q2\n";
      for (int k = 0; k <= 50; ++k) {
        const double t = 0.02 * k, s = std::max(0.0, t - at);
        text += format_shortest(t) + ",-1.5707963267948966," + format_shortest(4 * s * s) + (has_rates ? ",0," + format_shortest(8 * s) : "") + "\n";
      }
      const auto jumps = motion(text);
      std::vector<double> q(2), qd(2), qdd(2);
      double worst = 0;
      for (int k = 0; k <= 50; ++k) {
        jumps->evaluate(0.02 * k, q, qd, qdd);
        worst = std::max(worst, std::fabs(qdd[1] - (0.02 * k > at ? 8 : 0)) / 3);
      }
      EXPECT_GT(jumps->coarse_torques()->largest, 0.5 * worst) << at << has_rates;
      EXPECT_THAT(jumps->remarks(), ElementsAre(HasSubstr("and are known so well: splines through every other row"))) << at << has_rates;
    }
}

TEST_F(Recorded, EnergyIsThatOfTheStatesAndItsChangeTheWorkOfTheTorques) {
  const Simulation run = replayed(table_text(0.005, {"q", "qd", "qdd"}));
  const Trajectory shown = simulate_audited(run, instants(1, 0.005));
  EnergyBalance balance(run);
  const double last = shown.work.back();
  const auto end = balance.at(shown.q_at(200), shown.qd_at(200), last);
  // tau . (q - q(0)) of constant torques; between rows tau is off by the spline's h^2, some 1e-3 N m.
  EXPECT_NEAR(last, kTau[0] * shown.q_at(200)[0] + kTau[1] * shown.q_at(200)[1], 1e-3);
  EXPECT_NEAR(end.error, 0, 1e-3);
}

TEST_F(Recorded, WhatNothingDrivesHasNoTorque) {
  // Hanging still: gravity's torques are rounding of nothing, and of a free swing that of some 30 N m.
  const Simulation still = replayed("t,q1,q2,qd1,qd2,qdd1,qdd2\n0,-1.5707963267948966,0,0,0,0,0\n1,-1.5707963267948966,0,0,0,0,0\n");
  const Trajectory shown = simulate(still, instants(1, 0.25));
  EXPECT_THAT(torques_along(still, shown), testing::Each(testing::DoubleNear(0, 1e-14)));
  const Simulation held = replayed("t,q1,q2\n0,0,0\n1,0,0\n");
  EXPECT_GT(torques_along(held, simulate(held, instants(1, 0.25)))[0], 9);  // N m: held out level it takes some
}

TEST_F(Recorded, FirstRowIsTheStartAndItsStampMayBeLarge) {
  const ColumnNames names{ColumnName("stamp"), {{"joint1", "q", ColumnName("a")}, {"joint2", "q", ColumnName("b")}}};
  const auto since = motion("stamp [ns],b,a\n1700000000000000001,0,0\n1700000000100000002,0.5,0.1\n1700000000200000004,1,0.2\n", names);
  EXPECT_DOUBLE_EQ(since->end(), 0.200000003);  // doubles of that size are 256 ns apart
  std::vector<double> q(2), qd(2), qdd(2);
  since->evaluate(0.100000001, q, qd, qdd);
  EXPECT_DOUBLE_EQ(q[0], 0.1);
  EXPECT_DOUBLE_EQ(q[1], 0.5);
  EXPECT_THAT(since->remarks(), ElementsAre(HasSubstr("too few")));
  EXPECT_THAT(since->told_instants(), testing::Pointwise(testing::DoubleEq(), {1700000000000000001e-9, 1700000000100000002e-9, 1700000000200000004e-9}));
  const auto seconds = motion("stamp,b,a\n1700000000.000000001,0,0\n1700000000.100000002,0,0\n", names);
  EXPECT_DOUBLE_EQ(seconds->end(), 0.100000001);
  EXPECT_DOUBLE_EQ(motion("t,q1,q2\n-1.25,0,0\n.5,0,0\n", {})->end(), 1.75);
  EXPECT_DOUBLE_EQ(motion("t,q1,q2\n1e3,0,0\n1001.5,0,0\n", {})->end(), 1.5);
  EXPECT_DOUBLE_EQ(motion("t,q1,q2\n99999999999999999999,0,0\n99999999999999999999999,0,0\n", {})->end(), 99999999999999999999999.0 - 1e20);
}

TEST_F(Recorded, NamesOfJointsDoNotDependOnTheOrder) {
  const auto by_name = motion("t,q.joint2,q.joint1\n0,0,0\n1,0.5,0.25\n");
  const auto in_degrees = motion("t [ms],q1 [deg],q2 [deg]\n0,0,0\n1000,45,90\n");
  std::vector<double> q(2), qd(2), qdd(2);
  by_name->evaluate(1, q, qd, qdd);
  EXPECT_THAT(q, ElementsAre(0.25, 0.5));
  EXPECT_THAT(qd, ElementsAre(0.25, 0.5));  // of two rows, a line
  in_degrees->evaluate(1, q, qd, qdd);
  EXPECT_DOUBLE_EQ(q[1], std::acos(-1) / 2);
  EXPECT_THAT(error("t,q1,q.joint1,q2\n0,0,0,0\n1,0,0,0\n"), HasSubstr("mean the same"));
}

TEST_F(Recorded, WhatIsNoMotionIsRefusedWithItsPlace) {
  EXPECT_THAT(error("t,q1,q2\n0,0,0\n"), HasSubstr("a motion takes two rows"));
  EXPECT_THAT(error("t,q1,q2\n0,0,0\n0,0,0\n"), HasSubstr("log.csv:3: 't' does not rise"));
  EXPECT_THAT(error("t,q1,q2\n0,0,0\n1,nan,0\n"), HasSubstr("log.csv:3: 'nan' under 'q1'"));
  EXPECT_THAT(error("t,q1\n0,0\n1,0\n"), HasSubstr("there is none of 'joint2'"));
  EXPECT_THAT(error("t,q1,q2,qd1\n0,0,0,0\n1,0,0,0\n"), HasSubstr("needs the columns qd1 to qd2"));
  EXPECT_THAT(error("t,q1,q2,q3\n0,0,0,0\n1,0,0,0\n"), HasSubstr("has a column q3"));
  EXPECT_THAT(error("time,q1,q2\n0,0,0\n1,0,0\n"), HasSubstr("has no column 't'"));
  EXPECT_THAT(error("t,x,y\n0,0,0\n1,0,0\n"), HasSubstr("has no columns q1 to q2"));
  EXPECT_THAT(error("t [m],q1,q2\n0,0,0\n1,0,0\n"), HasSubstr("is to be the time"));
  EXPECT_THAT(error("t,q1 [m],q2\n0,0,0\n1,0,0\n"), HasSubstr("which turns"));
  EXPECT_THAT(error("t,q1 [rad/s],q2\n0,0,0\n1,0,0\n"), HasSubstr("which turns"));
  EXPECT_THAT(error("t,q1,q2\n0,3.1,0\n0.1,-3.1,0\n"), HasSubstr("log.csv:3: 'q1' jumps by -6.2 rad"));
  EXPECT_THAT(error("t,q1,q2\n0,0,0\n1,0,0\n", {ColumnName("t"), {{"knee", "q", ColumnName("q1")}}}), HasSubstr("no joint of the mechanism is called so"));
  EXPECT_THAT(error("t,q1,q2\n0,0,0\n1,0,0\n", {ColumnName("t"), {{"joint1", "q", ColumnName("p")}}}), HasSubstr("has no column 'p'"));
  EXPECT_THAT(error("t,q1,q2\n0,0,0\n1,0,0\n", {ColumnName("t"), {{"joint1", "q", ColumnName("q2")}, {"joint2", "q", ColumnName("q2")}}}), HasSubstr("for two things"));
  EXPECT_EQ(error("t,q1,q2\n0,0,0\n1,0,0\n"), "");  // negative control
  // Fast, but the rates say so.
  EXPECT_EQ(error("t,q1,q2,qd1,qd2\n0,0,0,40,0\n0.1,4,0,40,0\n"), "");
}

TEST_F(Recorded, WhatOneWouldNotBelieveIsRemarked) {
  const auto remarks = [&](const std::string& text) { return motion(text)->remarks(); };
  const auto few = HasSubstr("too few to tell how well");
  EXPECT_THAT(remarks("t,q1,q2,qd1,qd2\n0,0,0,57.3,0\n1,1,0,57.3,0\n2,2,0,57.3,0\n"),
              ElementsAre(AllOf(HasSubstr("'qd1' is not the rate of 'q1'"), HasSubstr("differ by 56.3")), few));
  EXPECT_THAT(remarks("t,q1,q2\n0,0,0\n0.1,0.1,0\n0.2,0.2,0\n0.3,0.3,0\n2,2,0\n"), ElementsAre(HasSubstr("there is nothing between t = 0.3 and 2 s"), few));
  EXPECT_THAT(remarks("t,q1,q2,tau1,tau2\n0,0,0,5,0\n1,0,0,5,0\n"), ElementsAre(few, HasSubstr("torques are those of inverse dynamics, not those that")));
  EXPECT_THAT(remarks("t,q1,q2,volts\n0,0,0,5\n1,0,0,5\n"), ElementsAre(few, HasSubstr("no use is made of these columns")));
  EXPECT_THAT(remarks("t,q1,q2\n0,0,0\n1,0.1,0.1\n2,0.2,0.1\n"), ElementsAre(few));
  EXPECT_THAT(remarks("t,q1,q2,qd1,qd2,qdd1,qdd2\n0,0,0,0,0,1,0\n1,0.5,0,1,0,1,0\n2,2,0,2,0,1,0\n"), IsEmpty()) << "negative control: it tells accelerations";
}

// Accelerations are held against the places where no rates stand between them: q1 = 0.6 sin(7 t) + 0.2 at 1 kHz.
TEST_F(Recorded, AccelerationsThatAreNotThoseOfThePlacesAreRemarked) {
  const auto remarks = [&](double factor) {
    std::string text = "t,q1,q2,qdd1,qdd2\n";
    for (int k = 0; k <= 1000; ++k) {
      const double t = k / 1000.0;
      text += format_shortest(t) + "," + format_shortest(0.6 * std::sin(7 * t) + 0.2) + ",0," + format_shortest(-factor * 0.6 * 49 * std::sin(7 * t)) + ",0\n";
    }
    return motion(text)->remarks();
  };
  EXPECT_THAT(remarks(180 / std::numbers::pi), ElementsAre(HasSubstr("'qdd1' is not the second derivative of 'q1'"))) << "degrees";
  EXPECT_THAT(remarks(-1), ElementsAre(HasSubstr("'qdd1' is not the second derivative of 'q1'"))) << "of the other sign";
  EXPECT_THAT(remarks(1.1), ElementsAre(HasSubstr("'qdd1' is 1.1 times the second derivative of 'q1'")));
  EXPECT_THAT(remarks(1), IsEmpty()) << "negative control";
}

// q1 = sin(2 pi t) in `rows` rows a period, read with this much noise, and rates that are `factor` times its own.
TEST_F(Recorded, RatesThatAreOffByAFactorAreRemarked) {
  const auto remarks = [&](int rows, double noise, double factor) {
    std::string text = "t,q1,q2,qd1,qd2\n";
    const double w = 2 * std::numbers::pi;
    for (int k = 0; k <= 3 * rows; ++k) {
      const double t = double(k) / rows, off = noise * std::sin(1e4 * k * k);  // as good as random
      text += format_shortest(t) + "," + format_shortest(std::sin(w * t) + off) + ",0," + format_shortest(factor * w * std::cos(w * t)) + ",0\n";
    }
    return motion(text)->remarks();
  };
  for (const double noise : {0.0, 1e-3}) {
    EXPECT_THAT(remarks(200, noise, 1.1), ElementsAre(HasSubstr("'qd1' is 1.1 times the rate of 'q1'"))) << noise;
    EXPECT_THAT(remarks(200, noise, 0.9), ElementsAre(HasSubstr("'qd1' is 0.9 times the rate of 'q1'"))) << noise;
    EXPECT_THAT(remarks(200, noise, 1), IsEmpty()) << noise;
    EXPECT_THAT(remarks(200, noise, 1.03), IsEmpty()) << "below what is told; " << noise;
  }
  EXPECT_THAT(remarks(6, 0, 1), ElementsAre(HasSubstr("are known so well: splines through every other row"))) << "honest rates, and few rows";
}

// q1 = sin(2 pi t) at 100 Hz: what its second differences make of the last digit, or of noise.
TEST_F(Recorded, RowsThatAreRoundedOrNoisyAreDoubted) {
  const double w = 2 * std::numbers::pi;
  const auto doubts = [&](int rate, double grid, double noise, const std::function<double(double)>& q1) {
    std::string text = "t,q1,q2\n";
    for (int k = 0; k <= 2 * rate; ++k) {
      const double t = double(k) / rate, q = q1(t) + noise * std::sin(1e4 * k * k);
      text += format_shortest(t) + "," + format_shortest(grid > 0 ? grid * std::round(q / grid) : q) + ",0\n";
    }
    return motion(text)->doubts();
  };
  const auto sine = [&](double t) { return std::sin(w * t); };
  EXPECT_THAT(doubts(100, 0, 0, sine), IsEmpty());
  EXPECT_THAT(doubts(10, 0, 0, sine), IsEmpty()) << "few rows, but honest";
  EXPECT_THAT(doubts(100, 1e-6, 0, sine), IsEmpty()) << "6e-7 of 1e-4 s^2 is 0.02 of 28 rad/s^2";
  EXPECT_THAT(doubts(100, 1e-3, 0, sine), ElementsAre(AllOf(HasSubstr("'q1'"), HasSubstr("noisy, rounded"))));
  EXPECT_THAT(doubts(100, 0, 1e-3, sine), ElementsAre(HasSubstr("noisy, rounded")));
  EXPECT_THAT(doubts(100, 0, 0, [&](double t) { return sine(t) + (std::fabs(t - 1.2) < 1e-6 ? 0.05 : 0); }), ElementsAre(HasSubstr("noisy"))) << "one row";
  EXPECT_THAT(doubts(100, 0, 0, [&](double t) { return sine(t) + (t > 1.7 ? 1e-2 * std::sin(1e8 * t * t) : 0); }), ElementsAre(HasSubstr("noisy"))) << "the last rows";
  EXPECT_THAT(doubts(100, 0, 0, [&](double t) { return std::fmod(std::floor(100 * t + 0.5), 7) == 0 ? 1e-3 : 0; }), ElementsAre(HasSubstr("noisy"))) << "a digit that flickers";
  EXPECT_THAT(doubts(100, 0, 0, [](double t) { return t < 1 ? t * t / 2 : 1 - (2 - t) * (2 - t) / 2; }), IsEmpty()) << "an acceleration that jumps";
  EXPECT_THAT(doubts(100, 0, 0, [](double t) { return 0.5 * t; }), IsEmpty()) << "rounding of a rate that is constant";
  EXPECT_THAT(doubts(20000, 0, 0, [](double t) { return 3 + 0.5 * t; }), IsEmpty()) << "likewise, of rows that are very near";
  EXPECT_THAT(doubts(100, 0, 0, [](double) { return 0.5; }), IsEmpty());
}

}  // namespace
}  // namespace chainreel
