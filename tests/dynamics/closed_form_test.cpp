// Against what a book or a pencil gives.
//
// K. Lynch, F. Park, Modern Robotics (2017), eq. 8.9: RR with point masses at the ends of its links,
//   M = [ m1 L1^2 + m2 (L1^2 + 2 L1 L2 c2 + L2^2)   m2 (L1 L2 c2 + L2^2) ]
//       [ .                                         m2 L2^2              ]
//   c = [ -m2 L1 L2 s2 (2 qd1 qd2 + qd2^2),  m2 L1 L2 qd1^2 s2 ]
//   g = [ (m1 + m2) L1 g c1 + m2 g L2 c12,   m2 g L2 c12 ]
#include <gtest/gtest.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "dynamics/compare.hpp"
#include "dynamics/equation_of_motion.hpp"
#include "dynamics/kinematics.hpp"
#include "support/chains.hpp"

namespace chainreel::test {
namespace {

struct BookRR {
  Eigen::Matrix2d M;
  Eigen::Vector2d c, g;
};

BookRR book_rr(const RR& rr, const State& s) {
  const auto [L1, L2, m1, m2, g] = rr;
  const double c1 = std::cos(s.q[0]), c2 = std::cos(s.q[1]), s2 = std::sin(s.q[1]),
               c12 = std::cos(s.q[0] + s.q[1]);
  const double qd1 = s.qd[0], qd2 = s.qd[1];
  const double M12 = m2 * (L1 * L2 * c2 + L2 * L2);
  BookRR book;
  book.M << m1 * L1 * L1 + m2 * (L1 * L1 + 2 * L1 * L2 * c2 + L2 * L2), M12, M12, m2 * L2 * L2;
  book.c << -m2 * L1 * L2 * s2 * (2 * qd1 * qd2 + qd2 * qd2), m2 * L1 * L2 * qd1 * qd1 * s2;
  book.g << (m1 + m2) * L1 * g * c1 + m2 * g * L2 * c12, m2 * g * L2 * c12;
  return book;
}

// Largest relative differences of M, nle, tau_g and qdd over 1000 states.
double difference_from_book(const RR& rr, const Chain& chain) {
  Random random(1);
  Workspace ws(chain);
  double largest = 0;
  for (int k = 0; k < 1000; ++k) {
    const State s = random_state(chain, random, 5);
    const BookRR book = book_rr(rr, s);
    compute_mass_matrix(chain, ws, s.q);
    compute_nle(chain, ws, s.q, s.qd);
    compute_gravity_torque(chain, ws, s.q);
    compute_forward_dynamics(chain, ws, s.q, s.qd, s.tau);
    // c and g may cancel in nle: measured against the larger of the two.
    const double force = std::max(book.c.norm(), book.g.norm());
    largest = std::max(largest, relative_difference(ws.M, book.M));
    largest = std::max(largest, (as_vector(ws.nle) - book.c - book.g).norm() / force);
    largest = std::max(largest, (as_vector(ws.tau_g) - book.g).norm() / force);
    const Eigen::Vector2d qdd = book.M.inverse() * (as_vector(s.tau) - book.c - book.g);
    const double condition = book.M.norm() * book.M.inverse().norm();
    const double size = (force + as_vector(s.tau).norm()) * book.M.inverse().norm();
    largest = std::max(largest, (as_vector(ws.qdd) - qdd).norm() / size / condition);
  }
  return largest;
}

// A few dozen operations of the same size, each rounded once.
constexpr double kBookTolerance = 32 * kRoundOff;

TEST(RrTest, EqualsTheBookToRoundOff) {
  for (const RR& rr : {RR{}, RR{.L1 = 0.7, .L2 = 1.3, .m1 = 2, .m2 = 0.4, .g = 1.62}}) {
    const Chain chain = rr_chain(rr);
    ASSERT_TRUE(chain.planar);
    EXPECT_LT(difference_from_book(rr, chain), kBookTolerance);
    EXPECT_LT(difference_from_book(rr, without_planar_form(chain)), kBookTolerance);
  }
}

TEST(RrTest, AnotherMassIsNotTheBooks) {
  EXPECT_GT(difference_from_book({}, with_changed_mass(rr_chain(), 2, 1 + 1e-12)), kBookTolerance);
}

TEST(PpTest, MassMatrixAndForcesAreExact) {
  const Chain chain = pp_chain();
  Workspace ws(chain);
  Random random(2);
  for (int k = 0; k < 100; ++k) {
    const State s = random_state(chain, random);
    compute_mass_matrix(chain, ws, s.q);
    EXPECT_EQ(ws.M, (Eigen::Matrix2d() << 2, 0, 0, 1).finished());
    compute_nle(chain, ws, s.q, s.qd);
    EXPECT_EQ(ws.nle, (std::vector<double>{0, 9.81}));
    compute_forward_dynamics(chain, ws, s.q, s.qd, s.tau);
    EXPECT_EQ(ws.qdd[0], s.tau[0] / 2);
    // tau - m g is rounded where the book's tau/m - g rounds once as well
    EXPECT_NEAR(ws.qdd[1], s.tau[1] - 9.81, 16 * kRoundOff);
  }
}

TEST(PpTest, TipIsAtTheCoordinates) {
  const Chain chain = pp_chain();
  Workspace ws(chain);
  const std::vector<double> q{0.25, -1.5}, qd{2, 3};
  compute_kinematics(chain, ws, q, qd);
  EXPECT_EQ(frame_position(chain, ws, chain.end_effector), Eigen::Vector3d(0.25, -1.5, 0));
  EXPECT_EQ(frame_velocity(chain, ws, chain.end_effector), Eigen::Vector3d(2, 3, 0));
}

// Euler's equations of a free box, in its own axes: I wd + w x I w = moment, m (vd + w x v) = force.
TEST(FreeBodyTest, FollowsEulersEquations) {
  TreeOptions options{.bodies = 1, .floating_base = true};
  Chain chain = random_tree(3, options);
  Inertia& inertia = chain.bodies[1].inertia;
  inertia.com.setZero();
  Workspace ws(chain);
  Random random(4);
  for (int k = 0; k < 100; ++k) {
    const State s = random_state(chain, random);
    compute_forward_dynamics(chain, ws, s.q, s.qd, s.tau);
    compute_kinematics(chain, ws, s.q, s.qd);
    const Eigen::Vector3d v(s.qd[0], s.qd[1], s.qd[2]), w(s.qd[3], s.qd[4], s.qd[5]);
    const Eigen::Vector3d force(s.tau[0], s.tau[1], s.tau[2]), moment(s.tau[3], s.tau[4], s.tau[5]);
    const Eigen::Vector3d gravity = ws.X_WB[1].linear().transpose() * chain.gravity;
    Eigen::VectorXd expected(6);
    expected << force / inertia.mass + gravity - w.cross(v),
        inertia.about_com.inverse() * (moment - w.cross(inertia.about_com * w));
    EXPECT_LT(relative_difference(Eigen::VectorXd(as_vector(ws.qdd)), expected), 64 * kRoundOff);
  }
}

}  // namespace
}  // namespace chainreel::test
