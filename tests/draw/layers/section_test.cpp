// The ellipsoid of the effective mass cut by a plane.
#include "draw/layers/ellipse.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "draw/chains.hpp"
#include "draw/robot/chain.hpp"
#include "dynamics/kinematics.hpp"

namespace chainreel {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

// Eigenvalues of 0.37 to 5 kg: products of three matrices of condition 14.
constexpr double kSectionRoundOff = 1e-11;

class Section : public ::testing::Test {
 protected:
  Section() : chain(test::model("arm", {0, 0, -9.81})), ws(chain) {
    effective = effective_mass_of(chain, ws, q, chain.end_effector, Task::linear);
    compute_kinematics(chain, ws, q, std::vector<double>(6, 0.0));
    plane = tip_plane(chain, ws);
    for (int j = 0; j < 3; ++j) basis.col(j) = effective.basis.directions[std::size_t(j)];
  }
  Matrix3d Lambda() const { return basis * *effective.Lambda * basis.transpose(); }
  Matrix3d Lambda_inv() const { return basis * effective.Lambda_inv * basis.transpose(); }

  // A point of the ellipse with these semi-axes.
  Vector3d at(const std::vector<MassAxis>& axes, EllipseReading reading, double angle) const {
    return std::cos(angle) * *semi_axis(axes[0], reading) * axes[0].direction +
           std::sin(angle) * *semi_axis(axes[1], reading) * axes[1].direction;
  }

  std::vector<double> q{0.3, 0.6, 1.2, 0.4, 0.7, -0.2};
  Chain chain;
  Workspace ws;
  EffectiveMass effective;
  Eigen::Matrix<double, 3, 2> plane;
  Matrix3d basis;
};

TEST_F(Section, LiesInThePlaneOfTheTool) {
  const Vector3d normal = plane.col(0).cross(plane.col(1));
  EXPECT_NEAR(normal.norm(), 1, kSectionRoundOff);
  for (const EllipseReading reading : {EllipseReading::mass, EllipseReading::energy, EllipseReading::belt}) {
    const auto axes = section_axes(effective, plane, reading);
    ASSERT_EQ(axes.size(), 2u);
    for (const MassAxis& axis : axes) {
      EXPECT_NEAR(axis.direction.dot(normal), 0, kSectionRoundOff);
      EXPECT_NEAR(axis.direction.norm(), 1, kSectionRoundOff);
    }
    EXPECT_NEAR(axes[0].direction.dot(axes[1].direction), 0, kSectionRoundOff);
    EXPECT_GE(*axes[0].mass, *axes[1].mass);  // as mass_axes: the heaviest first
  }
}

TEST_F(Section, OfMassAreForcesForUnitAccelerations) {
  const auto axes = section_axes(effective, plane, EllipseReading::mass);
  for (double angle = 0; angle < 6; angle += 0.7)
    EXPECT_NEAR((Lambda_inv() * at(axes, EllipseReading::mass, angle)).norm(), 1, kSectionRoundOff);
}

TEST_F(Section, OfEnergyAreVelocitiesOfEqualEnergy) {
  const auto axes = section_axes(effective, plane, EllipseReading::energy);
  for (double angle = 0; angle < 6; angle += 0.7) {
    const Vector3d v = at(axes, EllipseReading::energy, angle);
    EXPECT_NEAR(v.dot(Lambda() * v), 1, kSectionRoundOff);
  }
}

TEST_F(Section, OfTheBeltAreTheMassesFeltInThePlane) {
  const auto axes = section_axes(effective, plane, EllipseReading::belt);
  for (const MassAxis& axis : axes)
    EXPECT_NEAR(*axis.mass, 1 / axis.direction.dot(Lambda_inv() * axis.direction), kSectionRoundOff);
  // They are the extremes: between them the plane has nothing heavier and nothing lighter.
  for (double angle = 0; angle < 6; angle += 0.3) {
    const Vector3d u = plane * Eigen::Vector2d(std::cos(angle), std::sin(angle));
    const double felt = 1 / u.dot(Lambda_inv() * u);
    EXPECT_LE(felt, *axes[0].mass + kSectionRoundOff);
    EXPECT_GE(felt, *axes[1].mass - kSectionRoundOff);
  }
}

// Halfway between two principal axes the form is the mean of theirs: three different masses.
TEST_F(Section, DiffersFromOneReadingToAnother) {
  const auto whole = mass_axes(effective);
  Eigen::Matrix<double, 3, 2> halfway;
  halfway << (whole[0].direction + whole[1].direction).normalized(), whole[2].direction;
  const double a = *whole[0].mass, b = *whole[1].mass;
  EXPECT_NEAR(*section_axes(effective, halfway, EllipseReading::mass)[0].mass,
              1 / std::sqrt((1 / (a * a) + 1 / (b * b)) / 2), kSectionRoundOff);
  EXPECT_NEAR(*section_axes(effective, halfway, EllipseReading::energy)[0].mass, (a + b) / 2, kSectionRoundOff);
  EXPECT_NEAR(*section_axes(effective, halfway, EllipseReading::belt)[0].mass, 2 / (1 / a + 1 / b),
              kSectionRoundOff);
  EXPECT_GT(a, 1.5 * b);  // else the three would hardly differ
}

TEST_F(Section, ThroughTwoPrincipalAxesHasThem) {
  const auto whole = mass_axes(effective);
  Eigen::Matrix<double, 3, 2> through;
  through << whole[0].direction, whole[2].direction;
  for (const EllipseReading reading : {EllipseReading::mass, EllipseReading::energy, EllipseReading::belt}) {
    const auto axes = section_axes(effective, through, reading);
    EXPECT_NEAR(*axes[0].mass, *whole[0].mass, kSectionRoundOff);
    EXPECT_NEAR(*axes[1].mass, *whole[2].mass, kSectionRoundOff);
  }
}

TEST_F(Section, IsOpenWhereThePlaneHoldsAnInfiniteMass) {
  // Stretched upwards the hand cannot move along z.
  const std::vector<double> up(6, 0.0);
  const EffectiveMass stretched = effective_mass_of(chain, ws, up, chain.end_effector, Task::linear);
  Eigen::Matrix<double, 3, 2> xz, xy;
  xz << Vector3d::UnitX(), Vector3d::UnitZ();
  xy << Vector3d::UnitX(), Vector3d::UnitY();
  EXPECT_FALSE(section_axes(stretched, xz, EllipseReading::mass)[0].mass);
  EXPECT_TRUE(section_axes(stretched, xz, EllipseReading::mass)[1].mass);
  EXPECT_FALSE(section_axes(stretched, xz, EllipseReading::belt)[0].mass);
  EXPECT_EQ(*semi_axis(section_axes(stretched, xz, EllipseReading::energy)[0], EllipseReading::energy), 0);
}

TEST(SectionInThePlane, IsTheEllipseItself) {
  const Chain rr = test::model("rr");
  Workspace ws(rr);
  const std::vector<double> q{0.2, 1.1};
  const EffectiveMass effective = effective_mass_of(rr, ws, q, rr.end_effector, Task::linear);
  const auto whole = mass_axes(effective),
             cut = section_axes(effective, tip_plane(rr, ws), EllipseReading::mass);
  ASSERT_EQ(cut.size(), whole.size());
  EXPECT_EQ(cut[0].mass, whole[0].mass);
}

}  // namespace
}  // namespace chainreel
