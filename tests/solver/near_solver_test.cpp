#include "solver/near_solver.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <random>

namespace nurbeam {
namespace {

using Matrix = Eigen::SparseMatrix<double>;

/// Of one pattern: a chain with values that `part` changes, each its own way.
Matrix chain(int n, double part) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> number(-1, 1);
  std::vector<Eigen::Triplet<double>> entries;
  for (int i = 0; i < n; ++i)
    for (int j = std::max(0, i - 2); j <= std::min(n - 1, i + 2); ++j)
      entries.emplace_back(i, j, (i == j ? 4 : number(random)) * (1 + part * number(random)));
  Matrix A(n, n);
  A.setFromTriplets(entries.begin(), entries.end());
  return A;
}

Eigen::VectorXd exact(const Matrix& A, const Eigen::VectorXd& b) {
  return Eigen::MatrixXd(A).partialPivLu().solve(b);
}

// Near ones by corrections, those farther away with factors of their own; all to round-off.
TEST(NearSolver, SolvesAllToRoundOffHoweverNearTheyAre) {
  constexpr int n = 40;
  NearSolver solver;
  for (const double part : {0.0, 1e-9, -1e-6, 1e-4, 0.3, 0.3 + 1e-7, 5.0, -2.0}) {
    const Matrix A = chain(n, part);
    const Eigen::VectorXd b = Eigen::VectorXd::LinSpaced(n, -1, 2 + part);
    Eigen::VectorXd x;
    ASSERT_TRUE(solver.solve(A, {}, b, x)) << part;
    const Eigen::VectorXd expected = exact(A, b);
    EXPECT_LT((x - expected).norm(), 1e-13 * expected.norm()) << part;
  }
}

TEST(NearSolver, TakesAnotherRightHandSideFarFromTheOneBefore) {
  const Matrix A = chain(40, 0), near = chain(40, 1e-6);
  NearSolver solver;
  Eigen::VectorXd x;
  ASSERT_TRUE(solver.solve(A, {}, Eigen::VectorXd::Ones(40), x));
  for (const double factor : {1e6, 1e-6, 0.0}) {
    const Eigen::VectorXd b = factor * Eigen::VectorXd::LinSpaced(40, -3, 2);
    ASSERT_TRUE(solver.solve(near, {}, b, x));
    EXPECT_LE((x - exact(near, b)).norm(), 1e-13 * exact(near, b).norm() + 1e-15) << factor;
  }
}

// One of them also where factors of another matrix are at hand.
TEST(NearSolver, RefusesASingularMatrixAndGoesOnAfterIt) {
  NearSolver solver;
  Eigen::VectorXd x;
  const Matrix A = chain(12, 0);
  ASSERT_TRUE(solver.solve(A, {}, Eigen::VectorXd::Ones(12), x));
  Matrix singular = A;
  for (Matrix::InnerIterator entry(singular, 5); entry; ++entry) entry.valueRef() = 0;
  EXPECT_FALSE(solver.solve(singular, {}, Eigen::VectorXd::Ones(12), x));
  for (const Matrix& regular : {A, chain(9, 0)}) {
    const Eigen::VectorXd b = Eigen::VectorXd::Ones(regular.rows());
    ASSERT_TRUE(solver.solve(regular, {}, b, x));
    EXPECT_LT((x - exact(regular, b)).norm(), 1e-13 * exact(regular, b).norm());
  }
}

}  // namespace
}  // namespace nurbeam
