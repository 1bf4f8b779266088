#include "solver/updated_kkt.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <random>

namespace nurbeam {
namespace {

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

void check_update(const Eigen::MatrixXd& dense, const std::vector<int>& unknowns, std::mt19937& random) {
  const auto p = static_cast<Eigen::Index>(unknowns.size());
  std::normal_distribution<double> number;
  const Eigen::VectorXd expected = Eigen::VectorXd::LinSpaced(dense.rows(), -1, 2);
  UpdatedKkt solver;
  Eigen::VectorXd x;
  ASSERT_TRUE(solver.factorise(dense.sparseView(), unknowns));
  solver.solve(dense * expected, x);
  EXPECT_LT((x - expected).norm(), 1e-8);
  for (int round = 0; round < 3; ++round) {
    Eigen::MatrixXd changed = dense;
    const Eigen::MatrixXd change = Eigen::MatrixXd::NullaryExpr(p, p, [&] { return number(random); });
    changed(unknowns, unknowns) += change;
    ASSERT_TRUE(solver.update(change));
    solver.solve(changed * expected, x);
    EXPECT_LT((x - expected).norm(), 1e-8);
  }
  ASSERT_TRUE(solver.factorise(dense.sparseView(), unknowns));
  solver.solve(dense * expected, x);
  EXPECT_LT((x - expected).norm(), 1e-8) << "what had changed is forgotten";
}

TEST(UpdatedKkt, SolvesWithAPartThatChangesInABand) {
  std::mt19937 random(3);
  check_update(coupled(90, 3, 1000, random), {4, 7, 8, 41, 42, 89}, random);
  check_update(coupled(31, 5, 1000, random), {0}, random);
}
TEST(UpdatedKkt, SolvesWithAPartThatChangesInAWideMatrix) {
  std::mt19937 random(4);
  check_update(coupled(300, 1, 7, random), {11, 3, 250}, random);
}

TEST(UpdatedKkt, TellsAPartThatHoldsNoNumber) {
  std::mt19937 random(5);
  UpdatedKkt solver;
  ASSERT_TRUE(solver.factorise(coupled(20, 2, 1000, random).sparseView(), {3, 4}));
  EXPECT_FALSE(solver.update(Eigen::MatrixXd::Constant(2, 2, std::nan(""))));
}

}  // namespace
}  // namespace nurbeam
