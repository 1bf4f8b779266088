#include "solver/rest/stability.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <Eigen/Eigenvalues>
#include <cmath>
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

// Two bodies that press a spring together, held on a straight guide whose curvature is round-off: nothing can
// move, however soft the spring makes them across it.
TEST(Stability, TakesRoundOffForNoStiffness) {
  const double c = 0.802, s = std::sqrt(1 - c * c), k = 33, N = 15;
  for (const double curvature : {0.0, 1e-17, -1e-17, 1e-19}) {
    Eigen::MatrixXd K = Eigen::MatrixXd::Zero(6, 6), G = Eigen::MatrixXd::Zero(6, 6);
    Eigen::Matrix2d spring;
    spring << k * c * c - N * s * s, -(k + N) * c * s, -(k + N) * c * s, k * s * s - N * c * c;
    for (const int i : {0, 3})
      for (const int j : {0, 3}) K.block<2, 2>(i, j) = (i == j ? 1 : -1) * spring;
    for (const int i : {0, 3}) {
      K(i + 2, i + 2) = curvature;
      G.block<3, 3>(i, i) << -0.55, 0, 0.55 * c, 0, -0.63, -0.63 * s, 0, 0, 1;
    }
    const auto found = stability(kkt(K, G), 6);
    ASSERT_TRUE(found) << curvature;
    EXPECT_EQ(found->unstable_directions, 0) << curvature;
  }
}

TEST(Stability, SaysNothingOfAnUnsymmetricTangent) {
  Eigen::MatrixXd K = Eigen::MatrixXd::Identity(3, 3);
  K(0, 1) = 0.5;
  EXPECT_FALSE(stability(kkt(K, Eigen::MatrixXd::Zero(0, 3)), 3));
}

Stability divergence_of(const Eigen::MatrixXd& K, const Eigen::MatrixXd& G, const Eigen::MatrixXd& M) {
  return divergence(
      kkt(K, G), static_cast<int>(K.rows()), [&] { return M.sparseView().eval(); });
}

/// Against the real parts of the eigenvalues of (Z'MZ)^-1 Z'KZ; a direction that is told falls.
TEST(Divergence, IsANegativeRealPartOfAnEigenvalueOnTheNullSpaceOfTheConstraints) {
  std::mt19937 random(2);
  std::uniform_real_distribution<double> number(-1, 1);
  int stable = 0, unstable = 0;
  for (int trial = 0; trial < 300; ++trial) {
    const int n = 4 + trial % 7, m = trial % 4;
    const auto matrix = [&](int rows, int columns) {
      return Eigen::MatrixXd::NullaryExpr(rows, columns, [&] { return number(random); }).eval();
    };
    const Eigen::MatrixXd A = matrix(n, n), B = matrix(n, n), G = matrix(m, n);
    const Eigen::MatrixXd one = Eigen::MatrixXd::Identity(n, n), M = B * B.transpose() + one;
    const Eigen::MatrixXd K = A * A.transpose() + 0.5 * matrix(n, n) - 0.2 * (1 + number(random)) * one;
    const Eigen::MatrixXd Z = m > 0 ? Eigen::FullPivLU<Eigen::MatrixXd>(G).kernel().eval() : one;
    const Eigen::MatrixXd inertia = Z.transpose() * M * Z, stiffness = Z.transpose() * K * Z;
    const double least =
        Eigen::EigenSolver<Eigen::MatrixXd>(inertia.llt().solve(stiffness)).eigenvalues().real().minCoeff();
    if (std::abs(least) < 0.01) continue;
    const Stability found = divergence_of(K, G, M);
    ASSERT_EQ(found.unstable_directions, least < 0 ? 1 : 0) << trial;
    ++(least < 0 ? unstable : stable);
    if (least > 0) continue;
    EXPECT_LT(found.direction.dot(K * found.direction), 0);
    EXPECT_NEAR(found.direction.norm(), 1, 1e-12);
    EXPECT_LT((G * found.direction).norm(), 1e-9);
  }
  EXPECT_GT(stable, 50);
  EXPECT_GT(unstable, 50);
}

// Ziegler's double pendulum, of masses 2 and 1, unit lengths and springs, under a force P that follows its
// end. Its tangent [[2 - P, P - 1], [-1, 1]] has the determinant 1. Its eigenvalues are real and positive up
// to P = 7/2 - sqrt(2), and of negative real parts above 7/2.
TEST(Divergence, OfZieglersPendulumBeginsAboveItsFlutter) {
  const Eigen::Matrix2d M{{3, 1}, {1, 1}};
  for (const double P : {1.0, 2.0, 3.4, 3.6, 4.0, 10.0, 1e3}) {
    const Eigen::Matrix2d K{{2 - P, P - 1}, {-1, 1}};
    EXPECT_EQ(divergence_of(K, Eigen::MatrixXd(0, 2), M).unstable_directions, P > 3.5 ? 1 : 0) << P;
  }
}

// A soft direction that falls among stiff ones, with a coordinate that has no mass.
TEST(Divergence, IsFoundAmongSoftAndStiffDirections) {
  for (const double softest : {-1e-3, -1e-7, 1e-7, 1e-3}) {
    Eigen::MatrixXd K = Eigen::VectorXd{{1, 1, 1, 1, 1e9}}.asDiagonal(), M = K;
    const Eigen::MatrixXd couple{{1, -1 + softest}, {-1, 1}};
    K.topLeftCorner(2, 2) = couple;
    K(0, 2) = 3;
    K(2, 0) = 1e-9;  // of hardly any influence on its eigenvalues, as their product says
    M.setIdentity();
    M(3, 3) = 0;
    EXPECT_EQ(divergence_of(K, Eigen::MatrixXd(0, 5), M).unstable_directions, softest < 0 ? 1 : 0) << softest;
  }
}

TEST(Stability, APositiveTangentWithSoftAndStiffDirectionsIsStable) {
  Eigen::VectorXd d(4);
  d << 1e9, 1e-6, 1, 0;
  EXPECT_EQ(stability(kkt(d.asDiagonal(), Eigen::MatrixXd::Zero(0, 4)), 4)->unstable_directions, 0);
}

}  // namespace
}  // namespace nurbeam
