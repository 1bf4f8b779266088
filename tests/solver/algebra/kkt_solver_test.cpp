#include "solver/algebra/kkt_solver.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "solver/algebra/side_by_side.h"

namespace nurbeam {
namespace {

Eigen::MatrixXd saddle_point() {
  Eigen::MatrixXd matrix(3, 3);
  matrix << 4, 1, 2, 1, 3, -1, 2, -1, 0;
  return matrix;
}

TEST(KktSolver, SolvesASaddlePointSystemToRoundOff) {
  const Eigen::SparseMatrix<double> matrix = saddle_point().sparseView();
  const Eigen::Vector3d expected(1, -2, 3);
  KktSolver solver;
  ASSERT_TRUE(solver.factorise(matrix));
  EXPECT_LT((solver.solve(matrix * expected) - expected).norm(), 1e-14);
}

TEST(KktSolver, FollowsAChangeOfValuesOfPatternAndOfSize) {
  KktSolver solver;
  Eigen::MatrixXd diagonal_apart = saddle_point();
  diagonal_apart(0, 0) = 0;
  diagonal_apart(2, 2) = 5;
  for (const Eigen::MatrixXd& dense : {saddle_point(), Eigen::MatrixXd(2 * saddle_point()), diagonal_apart,
                                       Eigen::MatrixXd(saddle_point().topLeftCorner(2, 2))}) {
    const Eigen::SparseMatrix<double> matrix = dense.sparseView();
    const Eigen::VectorXd expected = Eigen::VectorXd::LinSpaced(dense.rows(), 1, 2);
    ASSERT_TRUE(solver.factorise(matrix));
    EXPECT_LT((solver.solve(matrix * expected) - expected).norm(), 1e-14);
  }
}

// Of a band whose rows are exchanged, of one with a part that is eliminated last, and of a matrix that has no
// narrow band: with more right-hand sides than are taken side by side, and fewer.
TEST(KktSolver, SolvesForManyRightHandSidesAtOnce) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> number(-1, 1);
  const int n = 61;
  Eigen::MatrixXd band = Eigen::MatrixXd::Zero(n, n), full(n, n);
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      full(i, j) = number(random);
      if (std::abs(i - j) <= 3 && i != j) band(i, j) = number(random);
    }
  // Rows are exchanged everywhere, nowhere and here and there.
  const Eigen::MatrixXd dominant = band + 40 * Eigen::MatrixXd::Identity(n, n);
  Eigen::MatrixXd mixed = dominant;
  for (int i = 5; i < n; i += 11) mixed(i, i) = 0;
  for (const auto& [dense, part] :
       {std::pair(band, std::vector<int>{}), std::pair(dominant, std::vector<int>{}),
        std::pair(mixed, std::vector<int>{}), std::pair(band, std::vector<int>{7, 8, 30}),
        std::pair(full, std::vector<int>{})}) {
    const Eigen::SparseMatrix<double> matrix = dense.sparseView();
    KktSolver solver;
    ASSERT_TRUE(solver.factorise(matrix, part));
    for (const int count : {1, 3, 8, 11, 13, 20, 23, 45}) {
      const KktSolver::Columns expected =
          KktSolver::Columns::NullaryExpr(n, count, [&] { return number(random); });
      KktSolver::Columns x;
      solver.solve(KktSolver::Columns(dense * expected), x);
      EXPECT_LT((x - expected).norm(), 1e-10 * expected.norm())
          << count << " of a matrix with " << part.size();
    }
  }
}

TEST(KktSolver, ReportsASingularMatrixAndRecoversFromIt) {
  Eigen::MatrixXd dense = saddle_point();
  dense.col(2) = dense.col(0) / 3;
  const Eigen::SparseMatrix<double> singular = dense.sparseView();
  const Eigen::SparseMatrix<double> regular = saddle_point().sparseView();
  KktSolver solver;
  EXPECT_FALSE(solver.factorise(singular));
  EXPECT_TRUE(solver.factorise(regular));
}

TEST(KktSolver, ReportsANumericallySingularMatrix) {
  Eigen::MatrixXd dense(3, 3);
  dense << 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9;
  const Eigen::SparseMatrix<double> matrix = dense.sparseView();
  KktSolver solver;
  EXPECT_FALSE(solver.factorise(matrix));
}

TEST(KktSolver, ReportsAStructurallySingularMatrix) {
  Eigen::SparseMatrix<double> matrix(2, 2);
  matrix.insert(0, 0) = 1;
  matrix.insert(0, 1) = 1;
  matrix.makeCompressed();
  KktSolver solver;
  EXPECT_FALSE(solver.factorise(matrix));
}

TEST(KktSolver, ReportsAMatrixThatHoldsNoNumber) {
  Eigen::MatrixXd dense = saddle_point();
  dense(1, 1) = std::numeric_limits<double>::quiet_NaN();
  const Eigen::SparseMatrix<double> matrix = dense.sparseView();
  KktSolver solver;
  EXPECT_FALSE(solver.factorise(matrix));
}

/// Unknowns that are coupled with the next `reach` ones and with those `branch` further on.
Eigen::MatrixXd coupled(int n, int reach, int branch, std::mt19937& random) {
  std::normal_distribution<double> number;
  Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(n, n);
  for (int i = 0; i < n; ++i)
    for (int j = i; j < n; ++j)
      if (j - i <= reach || (j - i) % branch == 0) {
        matrix(i, j) = number(random);
        matrix(j, i) = number(random);
      }
  return matrix;
}

void check_part(const Eigen::MatrixXd& dense, const std::vector<int>& unknowns, std::mt19937& random) {
  const auto p = static_cast<Eigen::Index>(unknowns.size());
  std::normal_distribution<double> number;
  const Eigen::VectorXd expected = Eigen::VectorXd::LinSpaced(dense.rows(), -1, 2);
  KktSolver solver;
  Eigen::VectorXd x;
  ASSERT_TRUE(solver.factorise(dense.sparseView(), unknowns));
  solver.solve(dense * expected, x);
  EXPECT_LT((x - expected).norm(), 1e-8);
  for (int round = 0; round < 3; ++round) {
    Eigen::MatrixXd changed = dense;
    const Eigen::MatrixXd change = Eigen::MatrixXd::NullaryExpr(p, p, [&] { return number(random); });
    changed(unknowns, unknowns) += change;
    ASSERT_TRUE(solver.renew(change));
    solver.solve(changed * expected, x);
    EXPECT_LT((x - expected).norm(), 1e-8);
  }
  ASSERT_TRUE(solver.factorise(dense.sparseView(), unknowns));
  solver.solve(dense * expected, x);
  EXPECT_LT((x - expected).norm(), 1e-8) << "what had changed is forgotten";
}

TEST(KktSolver, SolvesWithAPartThatChangesInABand) {
  std::mt19937 random(3);
  check_part(coupled(90, 3, 1000, random), {4, 7, 8, 41, 42, 89}, random);
  check_part(coupled(31, 5, 1000, random), {0}, random);
}
TEST(KktSolver, SolvesWithAPartThatChangesInAWideMatrix) {
  std::mt19937 random(4);
  check_part(coupled(300, 1, 7, random), {11, 3, 250}, random);
}

/// A long chain, or ring, of points with two unknowns each, every one of them coupled with the next two
/// points.
Eigen::SparseMatrix<double> long_chain(int points, bool closed, std::mt19937& random) {
  std::normal_distribution<double> number;
  std::vector<Eigen::Triplet<double>> entries;
  const int n = 2 * points;
  for (int i = 0; i < n; ++i) {
    entries.emplace_back(i, i, 30 + number(random));
    for (int j = i + 1; j < 2 * (i / 2) + 6; ++j)
      if (j < n || closed) {
        entries.emplace_back(i, j % n, number(random));
        entries.emplace_back(j % n, i, number(random));
      }
  }
  Eigen::SparseMatrix<double> matrix(n, n);
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

// Long enough to be cut in two; with a part that changes at an end, in the middle, elsewhere and at two
// places.
TEST(KktSolver, SolvesLongChainsInTwoStrandsWithTheSameBitsOnAnyNumberOfThreads) {
  std::mt19937 random(6);
  for (const bool closed : {false, true})
    for (const std::vector<int>& part : {std::vector<int>{},
                                         {0, 1},
                                         {6000, 6001, 6002, 6003},
                                         {1501, 1502},
                                         {1500, 1501, 1502, 1503, 9000, 9001, 9002, 9003}}) {
      Eigen::SparseMatrix<double> matrix = long_chain(6000, closed, random);
      const Eigen::VectorXd expected = Eigen::VectorXd::LinSpaced(matrix.rows(), -1, 2);
      const auto p = static_cast<Eigen::Index>(part.size());
      const Eigen::MatrixXd change = Eigen::MatrixXd::Random(p, p);
      const Eigen::VectorXd rhs = matrix * expected;
      std::vector<Eigen::VectorXd> solutions;
      for (const int threads : {1, 2, 3}) {
        const ThreadLimit limit(threads);
        KktSolver solver;
        ASSERT_TRUE(solver.factorise(matrix, part));
        solutions.push_back(solver.solve(rhs));
        EXPECT_LT((solutions.back() - expected).norm(), 1e-12 * expected.norm());
        EXPECT_EQ(solutions.back(), solutions.front());
      }
      if (part.empty()) continue;
      KktSolver solver;
      ASSERT_TRUE(solver.factorise(matrix, part));
      ASSERT_TRUE(solver.renew(change));
      for (Eigen::Index i = 0; i < p; ++i)
        for (Eigen::Index j = 0; j < p; ++j) matrix.coeffRef(part[i], part[j]) += change(i, j);
      matrix.makeCompressed();
      EXPECT_LT((solver.solve(matrix * expected) - expected).norm(), 1e-12 * expected.norm());
    }
}

// Everything that a strand is cut at is held by multipliers: each half is singular by itself.
TEST(KktSolver, LeavesALongChainWholeWhereAHalfOfItIsSingular) {
  constexpr int links = 6000, n = 2 * links;
  std::vector<Eigen::Triplet<double>> entries;
  // Coordinate k, multiplier k: x_k + x_(k+1) = b; nothing resists but the multipliers.
  const auto both = [&](int i, int j, double value) {
    entries.emplace_back(i, j, value);
    if (i != j) entries.emplace_back(j, i, value);
  };
  for (int k = 0; k < links; ++k) {
    both(k, k, k == links - 1 ? 1 : 0);
    both(k, links + k, 1);
    if (k + 1 < links) both(k + 1, links + k, 0.5);
    both(links + k, links + k, 0);
  }
  Eigen::SparseMatrix<double> matrix(n, n);
  matrix.setFromTriplets(entries.begin(), entries.end());
  const Eigen::VectorXd expected = Eigen::VectorXd::LinSpaced(n, -1, 2);
  KktSolver solver;
  ASSERT_TRUE(solver.factorise(matrix));
  EXPECT_LT((solver.solve(matrix * expected) - expected).norm(), 1e-10 * expected.norm());
}

TEST(KktSolver, TellsAPartThatHoldsNoNumber) {
  std::mt19937 random(5);
  KktSolver solver;
  ASSERT_TRUE(solver.factorise(coupled(20, 2, 1000, random).sparseView(), {3, 4}));
  EXPECT_FALSE(solver.renew(Eigen::MatrixXd::Constant(2, 2, std::nan(""))));
}

}  // namespace
}  // namespace nurbeam
