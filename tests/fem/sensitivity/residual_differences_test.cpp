#include "fem/sensitivity/residual_differences.h"

#include <gtest/gtest.h>

#include "tests/fem/random_models.h"

namespace nurbeam {
namespace {

using Columns = ResidualDifferences::Columns;

/// A beam of which a control point is `by` higher, and whose bending stiffness is so much greater.
BeamSystem beam(int dimension, double by, double stiffer) {
  std::mt19937 random(11);
  std::vector<RationalCubic> axis;
  for (const RationalCubic& cubic : testing::uneven_axis(random, dimension)) {
    Eigen::Matrix4d points = cubic.points();
    if (axis.empty()) points(1, 1) += by * points(3, 1);
    axis.emplace_back(points);
  }
  return BeamSystem(
      testing::one_beam(axis, dimension, {300, 2 * (1 + stiffer), 0.7, 0.02, {}}, 10, {{0, false}}));
}

class ResidualDifferencesIn : public ::testing::TestWithParam<int> {};

// What many parameters do to sums of residuals times multipliers is told by numbers of the elements, where
// they change nothing else; a stiffness comes by differences as before.
TEST_P(ResidualDifferencesIn, AreTheSameInSums) {
  const int dimension = GetParam();
  constexpr double step = 1e-5;
  const BeamSystem own = beam(dimension, 0, 0);
  const BeamSystem higher = beam(dimension, step, 0), lower = beam(dimension, -step, 0);
  const BeamSystem stiffer = beam(dimension, 0, step), softer = beam(dimension, 0, -step);
  const std::vector<ResidualDifferences::Pair> pairs{{&higher, &lower, step}, {&stiffer, &softer, step}};
  std::mt19937 random(12);
  const Eigen::Index n = own.coordinate_count(), m = own.constraint_count();
  const std::vector<std::vector<ResidualDifferences::Shift>> shifts(2);
  const Eigen::RowVectorXd same_time = Eigen::RowVectorXd::Zero(2);
  constexpr Eigen::Index count = 2;
  Columns by_find = Columns::Zero(count, 2), by_sums = by_find;
  ResidualDifferences all(pairs, drawn_state(own)), back(pairs, drawn_state(own));
  back.go_back(own, drawn_state(own), shifts, count);
  EXPECT_FALSE(back.are_all_in_sums());
  Columns dynamics = Columns::Constant(n, 2, 7), constraints = Columns::Constant(m, 2, 7);
  Columns of_back = dynamics, constraints_of_back = constraints;
  for (int i = 0; i < 3; ++i) {
    const State state = testing::disturbed_state(own, random);
    const Columns mu = Columns::Random(n + m, count);
    all.find(own, state, same_time, shifts, dynamics, constraints);
    by_find += mu.topRows(n).transpose() * dynamics + mu.bottomRows(m).transpose() * constraints;
    back.find(own, state, same_time, shifts, of_back, constraints_of_back);
    EXPECT_TRUE(of_back.col(0).isZero(0) && constraints_of_back.col(0).isZero(0));
    EXPECT_EQ(of_back.col(1), dynamics.col(1));
    by_sums += mu.topRows(n).transpose() * of_back + mu.bottomRows(m).transpose() * constraints_of_back;
    back.add(state, mu);
  }
  EXPECT_TRUE(back.sums().col(1).isZero(0));
  by_sums += back.sums();
  EXPECT_LT((by_sums - by_find).norm(), 1e-8 * by_find.norm());
  EXPECT_GT(by_find.colwise().norm().minCoeff(), 1e-3);
}

INSTANTIATE_TEST_SUITE_P(EveryDimension, ResidualDifferencesIn, ::testing::Values(2, 3));

}  // namespace
}  // namespace nurbeam
