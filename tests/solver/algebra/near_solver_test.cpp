#include "solver/algebra/near_solver.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
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

// How fast corrections become smaller is known of the matrix before: one does, until it is no longer small.
TEST(CorrectSolution, TakesOneCorrectionWhereThatIsKnownToDo) {
  constexpr int n = 40;
  constexpr double tolerance = 1e-7;
  KktSolver factors;
  ASSERT_TRUE(factors.factorise(chain(n, 0)));
  double contraction = unknown_contraction;
  Eigen::VectorXd x = Eigen::VectorXd::Zero(n);
  std::vector<int> corrections;
  for (int i = 1; i <= 12; ++i) {
    const Matrix A = chain(n, 2e-5 * i);
    const Eigen::VectorXd b = Eigen::VectorXd::LinSpaced(n, -1, 2 + 1e-3 * i);
    int count = 0;
    const auto open = [&](const Eigen::VectorXd& of, Eigen::VectorXd& left) {
      left = b - A * of;
      ++count;
    };
    ASSERT_TRUE(correct_solution(factors, open, tolerance, n, x, contraction));
    corrections.push_back(count);
    EXPECT_LT((x - exact(A, b)).lpNorm<Eigen::Infinity>(), tolerance * x.lpNorm<Eigen::Infinity>()) << i;
  }
  EXPECT_GE(corrections.front(), 2);
  EXPECT_EQ(*std::min_element(corrections.begin(), corrections.end()), 1);
  EXPECT_GT(*std::max_element(corrections.begin() + 1, corrections.end()), 1);
}

// Multipliers in another unit do not outweigh coordinates.
TEST(CorrectSolution, MeasuresCoordinatesApart) {
  constexpr int n = 40, coordinates = 30;
  constexpr double tolerance = 1e-7, unit = 1e-9;
  const auto scaled = [&](Matrix A) {
    for (int j = 0; j < coordinates; ++j) A.col(j) /= unit;  // x_j as many times smaller
    return A;
  };
  KktSolver factors;
  ASSERT_TRUE(factors.factorise(scaled(chain(n, 0))));
  const Matrix A = scaled(chain(n, 1e-4));
  const Eigen::VectorXd b = Eigen::VectorXd::LinSpaced(n, -1, 2), expected = exact(A, b);
  Eigen::VectorXd x = Eigen::VectorXd::Zero(n);
  double contraction = unknown_contraction;
  const auto open = [&](const Eigen::VectorXd& of, Eigen::VectorXd& left) { left = b - A * of; };
  ASSERT_TRUE(correct_solution(factors, open, tolerance, coordinates, x, contraction));
  EXPECT_LT((x - expected).head(coordinates).lpNorm<Eigen::Infinity>(),
            tolerance * expected.head(coordinates).lpNorm<Eigen::Infinity>());
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
