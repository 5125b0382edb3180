#include "core/dense.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <Eigen/QR>

namespace chainreel {

SymmetricEigen eigen_of_symmetric(const Eigen::MatrixXd& A) {
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(A);
  SymmetricEigen result{eigen.eigenvalues(), eigen.eigenvectors()};
  for (Eigen::Index k = 0; k < result.vectors.cols(); ++k) {
    Eigen::Index at = 0;
    result.vectors.col(k).cwiseAbs().maxCoeff(&at);
    if (result.vectors(at, k) < 0) result.vectors.col(k) = -result.vectors.col(k);
  }
  return result;
}

Eigen::VectorXcd eigenvalues_of(const Eigen::MatrixXd& A) {
  return A.eigenvalues();
}

Eigen::MatrixXd null_space(const Eigen::MatrixXd& A, double threshold) {
  Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr;
  qr.setThreshold(threshold);
  qr.compute(A.transpose());
  const Eigen::MatrixXd Q = qr.householderQ();
  return Q.rightCols(A.cols() - qr.rank());
}

Eigen::MatrixXd product(const Eigen::MatrixXd& A, const Eigen::MatrixXd& B) {
  return A * B;
}

Eigen::MatrixXd congruence(const Eigen::MatrixXd& A, const Eigen::MatrixXd& B) {
  const Eigen::MatrixXd turned = A.transpose() * B * A;
  return 0.5 * (turned + turned.transpose());
}

Eigen::MatrixXd inverse_of(const Eigen::MatrixXd& A) {
  return A.inverse();
}

Eigen::VectorXd least_squares(const Eigen::MatrixXd& A, const Eigen::VectorXd& b) {
  return A.completeOrthogonalDecomposition().solve(b);
}

Eigen::VectorXd solve_symmetric(const Eigen::MatrixXd& A, const Eigen::VectorXd& b) {
  return A.ldlt().solve(b);
}

}  // namespace chainreel
