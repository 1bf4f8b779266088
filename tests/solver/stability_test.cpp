#include "solver/stability.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <random>

namespace nurbeam {
namespace {

/// K, with G below and beside it.
Eigen::SparseMatrix<double> kkt(const Eigen::MatrixXd& K, const Eigen::MatrixXd& G) {
  const auto n = K.rows(), m = G.rows();
  Eigen::MatrixXd whole = Eigen::MatrixXd::Zero(n + m, n + m);
  whole.topLeftCorner(n, n) = K;
  whole.bottomLeftCorner(m, n) = G;
  whole.topRightCorner(n, m) = G.transpose();
  Eigen::SparseMatrix<double> sparse = whole.sparseView();
  for (Eigen::Index i = 0; i < n + m; ++i) sparse.coeffRef(i, i) += 0;  // as tangent_pattern() has it
  sparse.makeCompressed();
  return sparse;
}

/// Random stiffnesses, less what compression takes away, against the eigenvalues of Z'KZ, Z a basis of the
/// null space.
TEST(Stability, CountsTheNegativeEigenvaluesOnTheNullSpaceOfTheConstraints) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> number(-1, 1);
  for (int trial = 0; trial < 200; ++trial) {
    const int n = 4 + trial % 7, m = trial % 4;
    const auto matrix = [&](int rows, int columns) {
      return Eigen::MatrixXd::NullaryExpr(rows, columns, [&] { return number(random); }).eval();
    };
    const Eigen::MatrixXd A = matrix(n, n), G = matrix(m, n);
    const Eigen::MatrixXd K =
        A * A.transpose() - 0.2 * (1 + number(random)) * Eigen::MatrixXd::Identity(n, n);
    const Eigen::MatrixXd Z =
        m > 0 ? Eigen::FullPivLU<Eigen::MatrixXd>(G).kernel().eval() : Eigen::MatrixXd::Identity(n, n).eval();
    const Eigen::MatrixXd Q =
        Eigen::HouseholderQR<Eigen::MatrixXd>(Z).householderQ() * Eigen::MatrixXd::Identity(n, n - m);
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> modes(Q.transpose() * K * Q);
    if (modes.eigenvalues().cwiseAbs().minCoeff() < 0.01) continue;
    const auto found = stability(kkt(K, G), n);
    ASSERT_TRUE(found);
    EXPECT_EQ(found->unstable_directions, (modes.eigenvalues().array() < 0).count());
    if (found->unstable_directions == 0) continue;
    EXPECT_LT(found->direction.dot(K * found->direction), 0);
    EXPECT_NEAR(found->direction.norm(), 1, 1e-12);
    EXPECT_LT((G * found->direction).norm(), 0.2);
  }
}

// The second coordinate is held, and a large force couples it with the first, which is soft.
TEST(Stability, IsNotLostToWhatTheConstraintsForbid) {
  for (const double coupling : {1.0, 50.0, 5e3, 1e5})
    for (const double stiffness : {1.0, -1.0}) {
      const Eigen::Matrix2d K{{stiffness, coupling}, {coupling, 0}};
      const auto found = stability(kkt(K, Eigen::RowVector2d(0, 1)), 2);
      ASSERT_TRUE(found);
      EXPECT_EQ(found->unstable_directions, stiffness > 0 ? 0 : 1) << coupling;
    }
}

TEST(Stability, SaysNothingOfAnUnsymmetricTangent) {
  Eigen::MatrixXd K = Eigen::MatrixXd::Identity(3, 3);
  K(0, 1) = 0.5;
  EXPECT_FALSE(stability(kkt(K, Eigen::MatrixXd::Zero(0, 3)), 3));
}

TEST(Stability, APositiveTangentWithSoftAndStiffDirectionsIsStable) {
  Eigen::VectorXd d(4);
  d << 1e9, 1e-6, 1, 0;
  EXPECT_EQ(stability(kkt(d.asDiagonal(), Eigen::MatrixXd::Zero(0, 4)), 4)->unstable_directions, 0);
}

}  // namespace
}  // namespace nurbeam
