#include "solver/algebra/eigenpairs.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <Eigen/Eigenvalues>
#include <random>

namespace nurbeam {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

MatrixXd random_matrix(int rows, int columns, std::mt19937& random) {
  std::normal_distribution<double> normal;
  return MatrixXd::NullaryExpr(rows, columns, [&] { return normal(random); });
}

MatrixXd kkt_of(const MatrixXd& B, const MatrixXd& G) {
  const auto n = B.rows(), m = G.rows();
  MatrixXd kkt = MatrixXd::Zero(n + m, n + m);
  kkt.topLeftCorner(n, n) = B;
  kkt.bottomLeftCorner(m, n) = G;
  kkt.topRightCorner(n, m) = G.transpose();
  return kkt;
}

/// theta of A x = theta B x on the null space of G, dense; the largest magnitude first.
VectorXd dense_eigenvalues(const MatrixXd& A, const MatrixXd& B, const MatrixXd& G) {
  const MatrixXd Z = G.rows() > 0 ? MatrixXd(G.fullPivLu().kernel()) : MatrixXd::Identity(A.rows(), A.rows());
  const Eigen::GeneralizedSelfAdjointEigenSolver<MatrixXd> solver(Z.transpose() * A * Z,
                                                                  Z.transpose() * B * Z);
  VectorXd values = solver.eigenvalues();
  std::sort(values.begin(), values.end(), [](double a, double b) { return std::abs(a) > std::abs(b); });
  return values;
}

void expect_pairs(const MatrixXd& A, const MatrixXd& B, const MatrixXd& G, int count) {
  const auto found = largest_eigenpairs(A.sparseView(), kkt_of(B, G).sparseView(), count);
  ASSERT_TRUE(found);
  ASSERT_EQ(found->values.size(), count);
  const VectorXd exact = dense_eigenvalues(A, B, G);
  const MatrixXd overlap = found->vectors.transpose() * B * found->vectors;
  EXPECT_LT((overlap - MatrixXd::Identity(count, count)).cwiseAbs().maxCoeff(), 1e-8);
  for (int i = 0; i < count; ++i) {
    EXPECT_NEAR(found->values[i], exact[i], 1e-9 * std::abs(exact[0])) << i;
    const VectorXd x = found->vectors.col(i);
    if (G.rows() > 0) EXPECT_LT((G * x).norm(), 1e-9 * x.norm()) << i;
  }
}

TEST(Eigenpairs, AreThoseOnTheNullSpaceOfTheConstraints) {
  std::mt19937 random(1);
  for (const int constraints : {0, 1, 7}) {
    const MatrixXd root = random_matrix(40, 40, random), other = random_matrix(40, 40, random);
    const MatrixXd definite = root * root.transpose(), indefinite = other + other.transpose();
    const MatrixXd G = random_matrix(constraints, 40, random);
    expect_pairs(indefinite, definite, G, 6);
  }
}

TEST(Eigenpairs, AreAllFoundWhereEigenvaluesAreEqual) {
  // Each of 1, 1/2, 1/3, ... three times; in coordinates that hide it.
  std::mt19937 random(2);
  const MatrixXd Q = random_matrix(30, 30, random).householderQr().householderQ();
  VectorXd stiffness(30);
  for (int i = 0; i < 30; ++i) stiffness[i] = 1 + i / 3;
  const MatrixXd B = Q * stiffness.asDiagonal() * Q.transpose(), A = MatrixXd::Identity(30, 30);
  expect_pairs(A, B, MatrixXd(0, 30), 8);
}

TEST(Eigenpairs, AreFewerWhereTheRestIsZero) {
  MatrixXd A = MatrixXd::Zero(12, 12);
  A(2, 2) = 3;
  A(5, 5) = -7;
  const auto found = largest_eigenpairs(A.sparseView(), MatrixXd(MatrixXd::Identity(12, 12)).sparseView(), 4);
  ASSERT_TRUE(found);
  ASSERT_EQ(found->values.size(), 2);
  EXPECT_NEAR(found->values[0], -7, 1e-12);
  EXPECT_NEAR(found->values[1], 3, 1e-12);
}

TEST(Eigenpairs, OfASingularMatrixAreNone) {
  const MatrixXd zero = MatrixXd::Zero(5, 5);
  EXPECT_FALSE(largest_eigenpairs(MatrixXd(MatrixXd::Identity(5, 5)).sparseView(), zero.sparseView(), 2));
}

}  // namespace
}  // namespace nurbeam
