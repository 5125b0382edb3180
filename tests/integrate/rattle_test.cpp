// RATTLE on points that are no robot: a double pendulum of two point masses with links of 1 m.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "integrate/method.hpp"

namespace chainreel {
namespace {

struct Pendulum final : LinkedPoints {
  std::array<Link, 2> both{Link{1, 0, 0, 1}, Link{1, 0, 0, 1}};
  std::vector<double> x, u;  // as read last

  std::span<const Link> links() const override { return both; }
  bool force_depends_on_velocity() const override { return false; }
  void place(std::span<const double>, std::span<const double> v, std::span<double> at,
             std::span<double> rate) override {
    const double horizontal[] = {1, 0, 2, 0}, up[] = {0, v[0], 0, v[0] + v[1]};
    std::copy(horizontal, horizontal + 4, at.begin());
    std::copy(up, up + 4, rate.begin());
  }
  void read(std::span<const double> at, std::span<const double> rate, std::span<double>,
            std::span<double>) override {
    x.assign(at.begin(), at.end());
    u.assign(rate.begin(), rate.end());
  }
  void force(double, std::span<const double>, std::span<const double>, std::span<double> f) override {
    for (std::size_t i = 0; i < f.size(); i += 2) f[i] = 0, f[i + 1] = -9.81;
  }
  double energy() const {
    return 0.5 * (u[0] * u[0] + u[1] * u[1] + u[2] * u[2] + u[3] * u[3]) + 9.81 * (x[1] + x[3]);
  }
  // The largest of what lengths and the velocities along the links are off.
  double off_links() const {
    const double d_x = x[2] - x[0], d_y = x[3] - x[1];
    return std::max({std::fabs(std::hypot(x[0], x[1]) - 1), std::fabs(std::hypot(d_x, d_y) - 1),
                     std::fabs(x[0] * u[0] + x[1] * u[1]),
                     std::fabs(d_x * (u[2] - u[0]) + d_y * (u[3] - u[1]))});
  }
};

// Asked for nothing: no dense output is looked at here.
struct TwoAngles final : SecondOrder {
  int nq() const override { return 2; }
  int nv() const override { return 2; }
  void acceleration(double, std::span<const double>, std::span<const double>, std::span<double>) override {}
};

class Running {
 public:
  Running(const std::string& method, double rate) {
    integrator_ = make_integrator(find_method(method), {&angles_, nullptr, nullptr, &pendulum});
    integrator_->start(0, std::array{0.0, 0.0}, std::array{rate, 0.0});
  }
  StepResult go(int steps, double h) {
    StepResult result = StepResult::ok;
    for (int k = 1; k <= steps && result == StepResult::ok; ++k) result = integrator_->step(k * h, h);
    return result;
  }
  Pendulum pendulum;

 private:
  TwoAngles angles_;
  std::unique_ptr<Integrator> integrator_;
};

TEST(Rattle, KeepsLengthsForAMillionSteps) {
  for (const char* method : {"rattle2", "rattle4"}) {
    Running run(method, 0);
    ASSERT_EQ(run.go(1000000, 0.01), StepResult::ok);
    // Round-off of coordinates and rates of some 2 m and 10 m/s, and of a million increments' last digits.
    EXPECT_LT(run.pendulum.off_links(), 1e-14 * 2) << method;
  }
}

TEST(Rattle, HasAnEnergyErrorOfItsOrder) {
  double last = 0;
  for (const double h : {0.01, 0.005}) {
    Running run("rattle4", 0);
    ASSERT_EQ(run.go(int(1 / h), h), StepResult::ok);
    const double error = std::fabs(run.pendulum.energy());  // 0 at first
    if (last > 0) {
      EXPECT_NEAR(std::log2(last / error), 4, 0.1);
    }
    last = error;
  }
}

TEST(Rattle, SaysWhereAStepTurnsLinksTooFar) {
  // No impulse along the old links brings the points back to their lengths.
  Running run("rattle2", 500);
  EXPECT_EQ(run.go(10, 0.01), StepResult::not_converged);
}

}  // namespace
}  // namespace chainreel
