#include "solver/algebra/fronts.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <Eigen/SparseCore>
#include <random>
#include <utility>
#include <vector>

namespace nurbeam {
namespace {

// Nodes of so many unknowns each, coupled with each other where a list of pairs says so.
SparsePattern nodes_pattern(int nodes, int unknowns, const std::vector<std::pair<int, int>>& coupled) {
  std::vector<Eigen::Triplet<double>> entries;
  const auto couple = [&](int a, int b) {
    for (int i = 0; i < unknowns; ++i)
      for (int j = 0; j < unknowns; ++j) entries.emplace_back(unknowns * a + i, unknowns * b + j, 1);
  };
  for (int node = 0; node < nodes; ++node) couple(node, node);
  for (const auto& [a, b] : coupled) {
    couple(a, b);
    couple(b, a);
  }
  Eigen::SparseMatrix<double> matrix(nodes * unknowns, nodes * unknowns);
  matrix.setFromTriplets(entries.begin(), entries.end());
  return SparsePattern(matrix);
}

std::vector<std::pair<int, int>> chain(int nodes) {
  std::vector<std::pair<int, int>> coupled;
  for (int node = 0; node + 1 < nodes; ++node) coupled.emplace_back(node, node + 1);
  return coupled;
}

// All levels around a node in the middle.
Fronts fronts_of(const SparsePattern& pattern, int unknowns) {
  const int middle = pattern.size() / unknowns / 2 * unknowns;
  std::vector<int> first(static_cast<std::size_t>(unknowns));
  for (int i = 0; i < unknowns; ++i) first[i] = middle + i;
  return {pattern, CouplingLevels(pattern, pattern.size(), first, pattern.size())};
}

TEST(Fronts, AreTheNodesOfEachStrandOfAChain) {
  const Fronts fronts = fronts_of(nodes_pattern(7, 4, chain(7)), 4);
  ASSERT_EQ(fronts.level_count(), 4);
  ASSERT_EQ(fronts.of_level(0).size(), 1u);
  for (int level = 1; level < 4; ++level) {
    ASSERT_EQ(fronts.of_level(level).size(), 2u);
    for (const Front& front : fronts.of_level(level)) {
      EXPECT_EQ(front.own, 4);
      EXPECT_EQ(front.before, 4);
      EXPECT_EQ(fronts.unknowns()[front.first] / 4 - fronts.unknowns()[front.first_before] / 4,
                fronts.unknowns()[front.first] / 4 < 3 ? -1 : 1);
    }
  }
}

TEST(Fronts, HoldBothStrandsOfARingWhoseFarEndTheyReach) {
  auto ring = chain(7);
  ring.emplace_back(6, 0);
  const Fronts fronts = fronts_of(nodes_pattern(7, 4, ring), 4);
  for (int level = 1; level < 4; ++level) {
    ASSERT_EQ(fronts.of_level(level).size(), 1u);
    EXPECT_EQ(fronts.of_level(level)[0].own, 8);
  }
}

// Against the dense matrix: products, and the solution by fronts of one size, of another and of any.
TEST(Fronts, MultiplyAndSolveAsTheWholeMatrix) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> unit(-1, 1);
  const auto branched = [] {
    auto coupled = chain(9);
    coupled.emplace_back(6, 9);
    coupled.emplace_back(9, 10);
    coupled.emplace_back(10, 1);
    return coupled;
  };
  for (const int unknowns : {1, 3, 4, 6})
    for (const auto& [nodes, coupled] : {std::pair{9, chain(9)}, {11, branched()}}) {
      const SparsePattern pattern = nodes_pattern(nodes, unknowns, coupled);
      const Fronts fronts = fronts_of(pattern, unknowns);
      const int size = pattern.size();
      ASSERT_EQ(static_cast<int>(fronts.unknowns().size()), size);
      Eigen::MatrixXd A = Eigen::MatrixXd::Zero(size, size);
      Eigen::VectorXd blocks = Eigen::VectorXd::Zero(fronts.block_size());
      for (int j = 0; j < size; ++j)
        for (int k = pattern.column_starts()[fronts.unknowns()[j]];
             k < pattern.column_starts()[fronts.unknowns()[j] + 1]; ++k)
          for (int i = 0; i < size; ++i)
            if (fronts.unknowns()[i] == pattern.rows()[k]) {
              ASSERT_GE(fronts.index(i, j), 0) << "of " << i << " and " << j;
              A(i, j) = blocks[fronts.index(i, j)] = unit(random) + (i == j ? 3 * unknowns : 0);
            }
      const Eigen::VectorXd x = Eigen::VectorXd::NullaryExpr(size, [&](auto) { return unit(random); });
      Eigen::VectorXd left = A * x, sum = Eigen::VectorXd::Zero(size);
      for (const Front& front : fronts.all()) {
        subtract_product(front, blocks.data(), x.data(), left.data());
        add_absolute_product(front, blocks.data(), x.data(), sum.data());
      }
      EXPECT_LT(left.norm(), 1e-13);
      EXPECT_LT((sum - A.cwiseAbs() * x.cwiseAbs()).norm(), 1e-13 * sum.norm());
      Eigen::VectorXd solution = A * x;
      for (int level = fronts.level_count() - 1; level >= 0; --level)
        for (const Front& front : fronts.of_level(level)) {
          ASSERT_TRUE(factorise(front, blocks.data()));
          if (front.parent >= 0) take_from_parent(front, fronts.all()[front.parent], blocks.data());
          solve_inwards(front, blocks.data(), solution.data());
        }
      for (const Front& front : fronts.all()) solve_outwards(front, blocks.data(), solution.data());
      EXPECT_LT((solution - x).norm(), 1e-13 * x.norm()) << unknowns << " of " << nodes;
    }
}

TEST(Fronts, RefuseAPivotThatIsNone) {
  const SparsePattern pattern = nodes_pattern(1, 2, {});
  const Fronts fronts = fronts_of(pattern, 2);
  std::vector<double> singular{1, 2, 2, 4};
  EXPECT_FALSE(factorise(fronts.all()[0], singular.data()));
}

}  // namespace
}  // namespace nurbeam
