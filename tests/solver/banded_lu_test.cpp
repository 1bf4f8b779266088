#include "solver/banded_lu.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <random>

namespace nurbeam {
namespace {

/// A chain of `links` blocks of five unknowns, each coupled to the next, with their numbers shuffled, and
/// zeros on part of the diagonal, as multipliers have them.
Eigen::MatrixXd shuffled_chain(int links, bool closed, std::mt19937& random) {
  constexpr int size = 5;
  const int n = size * links;
  std::normal_distribution<double> number;
  Eigen::MatrixXd chain = Eigen::MatrixXd::Zero(n, n);
  for (int k = 0; k < links; ++k) {
    chain.block<size, size>(size * k, size * k) =
        Eigen::MatrixXd::NullaryExpr(size, size, [&] { return number(random); });
    const int next = (k + 1) % links;
    if (next == 0 && !closed) continue;
    chain.block<size, size>(size * k, size * next) =
        Eigen::MatrixXd::NullaryExpr(size, size, [&] { return number(random); });
    chain.block<size, size>(size * next, size * k) =
        chain.block<size, size>(size * k, size * next).transpose();
    chain(size * k, size * k) = 0;
  }
  Eigen::PermutationMatrix<Eigen::Dynamic> shuffle(n);
  shuffle.setIdentity();
  std::shuffle(shuffle.indices().begin(), shuffle.indices().end(), random);
  return shuffle * chain * shuffle.transpose();
}

TEST(BandedLu, SolvesShuffledChainsAndRingsToRoundOff) {
  std::mt19937 random(3);
  for (const bool closed : {false, true})
    for (const int links : {3, 4, 17, 100}) {
      const Eigen::MatrixXd dense = shuffled_chain(links, closed, random);
      const Eigen::SparseMatrix<double> matrix = dense.sparseView();
      BandedLu lu;
      const auto order = std::make_shared<BandOrder>(matrix);
      EXPECT_LE(order->half_bandwidth, closed ? 24 : 9);
      lu.take(order);
      EXPECT_GT(lu.factorise(matrix), 1e-10);
      const Eigen::VectorXd expected = Eigen::VectorXd::LinSpaced(dense.rows(), -1, 2);
      Eigen::VectorXd x;
      lu.solve(dense * expected, x);
      EXPECT_LT((x - expected).norm(), 1e-9 * expected.norm()) << links;
    }
}

TEST(BandedLu, FactorisesAgainWithOtherValuesOfThePattern) {
  std::mt19937 random(5);
  const Eigen::MatrixXd dense = shuffled_chain(9, false, random);
  Eigen::SparseMatrix<double> matrix = dense.sparseView();
  BandedLu lu;
  lu.take(std::make_shared<BandOrder>(matrix));
  EXPECT_GT(lu.factorise(matrix), 0);
  matrix *= -3;
  EXPECT_GT(lu.factorise(matrix), 0);
  const Eigen::VectorXd rhs = Eigen::VectorXd::Ones(dense.rows());
  Eigen::VectorXd x;
  lu.solve(rhs, x);
  EXPECT_LT((-3 * dense * x - rhs).norm(), 1e-10);
}

TEST(BandedLu, TellsASingularMatrixByItsPivots) {
  std::mt19937 random(7);
  Eigen::MatrixXd dense = shuffled_chain(9, false, random);
  dense.row(20) = dense.row(11);
  const Eigen::SparseMatrix<double> matrix = dense.sparseView();
  BandedLu lu;
  lu.take(std::make_shared<BandOrder>(matrix));
  EXPECT_LT(lu.factorise(matrix), 1e-14);
}

}  // namespace
}  // namespace nurbeam
