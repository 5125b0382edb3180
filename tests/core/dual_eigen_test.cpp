#include "core/dual_eigen.hpp"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <Eigen/LU>

namespace chainreel {
namespace {

template <class T>
using Matrix = Eigen::Matrix<T, Eigen::Dynamic, Eigen::Dynamic>;
template <class T>
using Vector = Eigen::Matrix<T, Eigen::Dynamic, 1>;

const Eigen::Matrix3d kA = (Eigen::Matrix3d() << 4, 1, 0.5, 1, 3, -1, 0.5, -1, 5).finished();
const Eigen::Matrix3d kRate = (Eigen::Matrix3d() << 1, 2, 0, 2, -1, 3, 0, 3, 1).finished();
const Eigen::Vector3d kB(1, -2, 3);

// A + e kRate
Matrix<Dual<double>> moving_matrix() {
  return kA.binaryExpr(kRate, [](double a, double rate) { return Dual<double>(a, rate); });
}

// From A x = b: x' = -A^-1 A' x.
void expect_solution_and_rate(const Vector<Dual<double>>& x, const Eigen::Matrix3d& rate) {
  const Eigen::Vector3d value = kA.inverse() * kB;
  const Eigen::Vector3d slope = -kA.inverse() * rate * value;
  for (int i = 0; i < 3; ++i) {
    EXPECT_NEAR(x(i).re, value(i), 1e-15);  // a dozen roundings of numbers near 1, as in the next line
    EXPECT_NEAR(x(i).du, slope(i), 4e-15);
  }
}

TEST(DualMatrices, SolversCarryTheDerivativeOfTheSolution) {
  const Matrix<Dual<double>> A = moving_matrix();
  const Vector<Dual<double>> b = kB.cast<Dual<double>>();
  expect_solution_and_rate(A.ldlt().solve(b), kRate);
  expect_solution_and_rate(A.llt().solve(b), kRate);
  expect_solution_and_rate(A.partialPivLu().solve(b), kRate);
  expect_solution_and_rate(Eigen::Matrix<Dual<double>, 3, 3>(A).inverse() * b, kRate);
}

TEST(DualMatrices, AnotherRateIsNotMistakenForTheRightOne) {
  const Vector<Dual<double>> x = moving_matrix().ldlt().solve(kB.cast<Dual<double>>().eval());
  const Eigen::Vector3d slope = -kA.inverse() * (1.001 * kRate) * (kA.inverse() * kB);
  EXPECT_GT(std::fabs(x(1).du - slope(1)), 4e-15);
}

TEST(DualMatrices, NormsAndProductsAreThoseOfTheirParts) {
  Eigen::Matrix<Dual<double>, 2, 1> v(Dual<double>(3, 1), Dual<double>(4, 0));
  EXPECT_EQ(v.norm().re, 5);
  EXPECT_DOUBLE_EQ(v.norm().du, 0.6);
  v *= 2.0;
  EXPECT_EQ(v.dot(v).re, 100);
  EXPECT_EQ(v.dot(v).du, 24);
}

TEST(QuadMatrices, SolveToTheirOwnPrecision) {
  const Matrix<Quad> A = kA.cast<Quad>();
  const Vector<Quad> b = kB.cast<Quad>();
  const Vector<Quad> x = A.ldlt().solve(b);
  const Vector<Quad> rest = A * x - b;
  EXPECT_LT(value_of(rest.norm()), 1e-32);  // a dozen roundings of 2^-113 near 5
  const Vector<Quad> rounded = (kA.inverse() * kB).cast<Quad>();
  const Vector<Quad> rest_of_rounded = A * rounded - b;
  EXPECT_GT(value_of(rest_of_rounded.norm()), 1e-18);
}

TEST(QuadMatrices, LimitsAreThoseOfTheType) {
  EXPECT_TRUE(Quad(1) + Eigen::NumTraits<Quad>::epsilon() != Quad(1));
  EXPECT_TRUE(Quad(1) + Eigen::NumTraits<Quad>::epsilon() / 4 == Quad(1));
  EXPECT_TRUE(Eigen::NumTraits<Quad>::highest() * 2 == Eigen::NumTraits<Quad>::highest() * 4);
}

}  // namespace
}  // namespace chainreel
