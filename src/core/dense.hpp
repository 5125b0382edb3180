// Algebra of matrices of any size, for what is computed a few times a picture. Eigen's templates for it are costly to
// compile, so they are compiled in one unit; the step loop has no use for them.
#pragma once

#include <Eigen/Core>

namespace chainreel {

// Values rising; their unit vectors as columns.
struct SymmetricEigen {
  Eigen::VectorXd values;
  Eigen::MatrixXd vectors;
};
// A is symmetric; its lower triangle is read. The sign of a vector is free: its largest number is positive, the first
// of those that tie.
SymmetricEigen eigen_of_symmetric(const Eigen::MatrixXd& A);

// A is square.
Eigen::VectorXcd eigenvalues_of(const Eigen::MatrixXd& A);

// Columns of length 1 at right angles that A sends to zero. Rows count as dependent below `threshold` of the largest.
Eigen::MatrixXd null_space(const Eigen::MatrixXd& A, double threshold);

Eigen::MatrixXd product(const Eigen::MatrixXd& A, const Eigen::MatrixXd& B);
// A^T B A, symmetric to the last bit as B is meant to be.
Eigen::MatrixXd congruence(const Eigen::MatrixXd& A, const Eigen::MatrixXd& B);
// A is square and regular.
Eigen::MatrixXd inverse_of(const Eigen::MatrixXd& A);
// The shortest x of those that bring A x nearest to b.
Eigen::VectorXd least_squares(const Eigen::MatrixXd& A, const Eigen::VectorXd& b);
// A^-1 b of a symmetric, positive A.
Eigen::VectorXd solve_symmetric(const Eigen::MatrixXd& A, const Eigen::VectorXd& b);

}  // namespace chainreel
