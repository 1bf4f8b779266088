#include "solver/algebra/banded_lu.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <memory>
#include <numeric>
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

Eigen::VectorXd solve(const BandedLu& lu, const BandOrder& order, const Eigen::VectorXd& rhs) {
  BandedLu::Places y = lu.places();
  lu.load(rhs, y);
  lu.lower(y);
  lu.upper(y);
  Eigen::VectorXd x(rhs.size());
  for (std::size_t k = 0; k < order.unknown.size(); ++k)
    if (order.unknown[k] >= 0) x[order.unknown[k]] = y[k];
  return x;
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
      const Eigen::VectorXd x = solve(lu, *order, dense * expected);
      EXPECT_LT((x - expected).norm(), 1e-9 * expected.norm()) << links;
    }
}

// Numbers of several sizes and zeros, so that rows are exchanged again and again, also those that others have
// been taken out of already.
TEST(BandedLu, SolvesSmallMatricesOfAllKindsAsFullPivotingDoes) {
  std::mt19937 random(19);
  std::normal_distribution<double> number;
  std::uniform_real_distribution<double> part(0, 1);
  int solved = 0;
  for (int trial = 0; trial < 3000; ++trial) {
    const int n = 2 + static_cast<int>(random() % 30), band = static_cast<int>(random() % 9);
    const double filled = part(random), zeros = part(random) / 2;
    Eigen::MatrixXd dense = Eigen::MatrixXd::Zero(n, n);
    std::vector<Eigen::Triplet<double>> entries;
    const auto set = [&](int row, int column) {
      const double value =
          part(random) < zeros ? 0 : number(random) * std::pow(10, static_cast<int>(random() % 5) - 2);
      dense(row, column) = value;
      entries.emplace_back(row, column, value);
    };
    for (int i = 0; i < n; ++i)
      for (int j = std::max(0, i - band); j <= i; ++j) {
        if (i != j && part(random) > filled) continue;
        set(i, j);
        if (i != j) set(j, i);
      }
    Eigen::SparseMatrix<double> matrix(n, n);
    matrix.setFromTriplets(entries.begin(), entries.end());
    auto order = std::make_shared<BandOrder>(matrix);
    if (trial % 2 == 1) *order = order->aligned(BandedLu::block);
    BandedLu lu;
    lu.take(order);
    const Eigen::FullPivLU<Eigen::MatrixXd> full(dense);
    if (!(lu.factorise(matrix) > 1e-8) || !full.isInvertible()) continue;
    ++solved;
    const Eigen::VectorXd rhs = Eigen::VectorXd::NullaryExpr(n, [&] { return number(random); });
    const Eigen::VectorXd expected = full.solve(rhs);
    EXPECT_LT((solve(lu, *order, rhs) - expected).norm(), 1e-6 * expected.norm()) << trial;
    BandedLu::Columns x;
    lu.solve(rhs, x);
    EXPECT_LT((x.col(0) - expected).norm(), 1e-6 * expected.norm()) << trial;
  }
  EXPECT_GT(solved, 1000);
}

TEST(BandedLu, SolvesWithBlocksThatBeginWhereNodesDo) {
  std::mt19937 random(17);
  std::normal_distribution<double> number;
  constexpr int nodes = 30, before = 3;  // unknowns before them, coupled with the first node
  const int n = before + 4 * nodes;
  for (const double diagonal : {0.0, 20.0}) {
    Eigen::MatrixXd dense = Eigen::MatrixXd::Zero(n, n);
    for (int i = 0; i < n; ++i)
      for (int j = 0; j < n; ++j) {
        const int a = i < before ? 0 : (i - before) / 4, b = j < before ? 0 : (j - before) / 4;
        if (std::abs(a - b) <= 1) dense(i, j) = number(random);
      }
    dense.topRightCorner(before, n - before - 4).setZero();
    dense.bottomLeftCorner(n - before - 4, before).setZero();
    dense.diagonal().array() += diagonal;
    const Eigen::SparseMatrix<double> matrix = dense.sparseView();
    std::vector<int> unknowns(static_cast<std::size_t>(n));
    std::iota(unknowns.begin(), unknowns.end(), 0);
    const auto order = std::make_shared<BandOrder>(BandOrder::of(matrix, unknowns).aligned(BandedLu::block));
    EXPECT_EQ(order->unknown.size(), static_cast<std::size_t>(n + 1));
    EXPECT_EQ(order->unknown[before], -1);
    for (int i = before; i < n; ++i) EXPECT_EQ(order->place[i], i + 1);
    BandedLu lu;
    lu.take(order);
    EXPECT_GT(lu.factorise(matrix), 1e-10);
    const Eigen::VectorXd expected = Eigen::VectorXd::LinSpaced(n, -1, 2);
    EXPECT_LT((solve(lu, *order, dense * expected) - expected).norm(), 1e-9 * expected.norm()) << diagonal;
    BandedLu::Columns many(n, 3), x;
    many << dense * expected, 2 * dense * expected, -dense * expected;
    lu.solve(many, x);
    EXPECT_LT((x.col(1) - 2 * expected).norm(), 1e-9 * expected.norm());
  }
}

TEST(BandedLu, FactorisesAgainWithOtherValuesOfThePattern) {
  std::mt19937 random(5);
  const Eigen::MatrixXd dense = shuffled_chain(9, false, random);
  Eigen::SparseMatrix<double> matrix = dense.sparseView();
  BandedLu lu;
  const auto order = std::make_shared<BandOrder>(matrix);
  lu.take(order);
  EXPECT_GT(lu.factorise(matrix), 0);
  matrix *= -3;
  EXPECT_GT(lu.factorise(matrix), 0);
  const Eigen::VectorXd rhs = Eigen::VectorXd::Ones(dense.rows());
  const Eigen::VectorXd x = solve(lu, *order, rhs);
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

TEST(BandedLu, SolvesWithTheFactorsOfPartsOfWhatIsNotZero) {
  std::mt19937 random(11);
  const Eigen::MatrixXd dense = shuffled_chain(30, false, random);
  const Eigen::SparseMatrix<double> matrix = dense.sparseView();
  BandedLu lu;
  lu.take(std::make_shared<BandOrder>(matrix));
  ASSERT_GT(lu.factorise(matrix), 0);
  BandedLu::Places whole = lu.places(), part = lu.places();
  const int first = 61;
  int last = 70;
  for (int k = first; k <= last; ++k) whole[k] = part[k] = k - 60.5;
  lu.lower(whole);
  lu.lower(part, first, last);
  for (std::size_t k = 0; k < whole.size(); ++k) {
    EXPECT_NEAR(part[k], whole[k], 1e-12 * (1 + std::abs(whole[k])));
    if (static_cast<int>(k) > last) EXPECT_EQ(whole[k], 0);
  }
  // z'(U^-1 y) = (U^-T z)'y.
  BandedLu::Places z = lu.places(), upper = whole;
  int from = 80, until = 90;
  for (int k = from; k <= until; ++k) z[k] = std::sin(k);
  const BandedLu::Places start = z;
  lu.upper(upper);
  lu.upper_transposed(z, from, until);
  const double expected = std::inner_product(start.begin(), start.end(), upper.begin(), 0.0);
  EXPECT_NEAR(std::inner_product(z.begin(), z.end(), whole.begin(), 0.0), expected,
              1e-9 * std::abs(expected));
}

TEST(BandOrder, LeavesUnknownsOutAndPutsWhatIsCoupledWithThemLast) {
  std::mt19937 random(13);
  const Eigen::SparseMatrix<double> matrix = shuffled_chain(40, false, random).sparseView();
  const std::vector<int> left_out{17, 90, 91};
  const BandOrder order(matrix, left_out);
  EXPECT_EQ(order.unknown.size(), 197u);
  for (const int i : left_out) EXPECT_EQ(order.place[i], -1);
  for (std::size_t k = 0; k < order.unknown.size(); ++k)
    EXPECT_EQ(order.place[order.unknown[k]], static_cast<int>(k));
  // Blocks of five are coupled with each other: without one block the chain falls apart beside it.
  Eigen::MatrixXd chain = Eigen::MatrixXd::Zero(50, 50);
  for (int k = 0; k + 1 < 10; ++k) chain.block<10, 10>(5 * k, 5 * k).setOnes();
  const BandOrder parts(chain.sparseView(), {20, 21, 22, 23, 24});
  EXPECT_EQ(parts.half_bandwidth, 9);
  const auto ends_with = [&](int end, int first) {
    for (int k = end - 5; k < end; ++k)
      if (parts.unknown[k] / 5 != first / 5) return false;
    return true;
  };
  EXPECT_TRUE(ends_with(20, 15) && ends_with(45, 25)) << "the blocks beside it";
}

/// A chain of blocks of four, numbered one after the other, of which the first and the last are held by two
/// multipliers at the end of all numbers, and the ninth is left out.
TEST(BandOrder, TakesAChainAsItIsNumberedWithItsMultipliersBesideIt) {
  constexpr int size = 4, links = 20, n = size * links;
  Eigen::MatrixXd chain = Eigen::MatrixXd::Zero(n + 4, n + 4);
  for (int k = 0; k + 1 < links; ++k) chain.block<2 * size, 2 * size>(size * k, size * k).setOnes();
  for (int r = 0; r < 4; ++r) {
    const int held = r < 2 ? r : n - size + r;
    chain(n + r, held) = chain(held, n + r) = 1;
  }
  const auto last_block = [](const BandOrder& order, int end) { return order.unknown[end - 1] / size; };
  const BandOrder whole(chain.sparseView());
  EXPECT_LE(whole.half_bandwidth, 2 * size + 1);
  EXPECT_EQ(whole.unknown.size(), static_cast<std::size_t>(n + 4));
  const BandOrder parts(chain.sparseView(), {36, 37, 38, 39});
  EXPECT_LE(parts.half_bandwidth, 2 * size + 1);
  EXPECT_EQ(last_block(parts, 38), 8) << "before what is left out";
  EXPECT_EQ(last_block(parts, n), 10) << "behind it, turned round";
  std::vector<int> sorted = parts.unknown;
  std::sort(sorted.begin(), sorted.end());
  EXPECT_EQ(std::unique(sorted.begin(), sorted.end()), sorted.end());
  EXPECT_EQ(sorted.size(), static_cast<std::size_t>(n));
}

TEST(BandOrder, IsByLevelsWhereTheNumbersAreFarApart) {
  constexpr int n = 200;
  Eigen::MatrixXd chain = Eigen::MatrixXd::Identity(n, n);
  for (int k = 0; k + 1 < n; ++k) {
    const int a = 77 * k % n, b = 77 * (k + 1) % n;
    chain(a, b) = chain(b, a) = 1;
  }
  EXPECT_EQ(BandOrder(chain.sparseView()).half_bandwidth, 1);
}

}  // namespace
}  // namespace nurbeam
