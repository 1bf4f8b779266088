#include "fem/constraints/directions_across.h"

#include <gtest/gtest.h>

#include "tests/support/rate_test.h"

namespace nurbeam::testing::directions_across_test {

TEST(DirectionsAcross, InSpaceAreTwoUnitVectorsAtRightAnglesAndRightHanded) {
  std::mt19937 random(1);
  for (int trial = 0; trial < 50; ++trial) {
    const Eigen::Vector3d t = random_vector(3, random).normalized();
    const Eigen::Matrix<double, 2, 3> n = directions_across<3>(t);
    EXPECT_LT((n * n.transpose() - Eigen::Matrix2d::Identity()).norm(), 1e-14);
    EXPECT_LT((n * t).norm(), 1e-14);
    EXPECT_LT((Eigen::Vector3d(n.row(0)).cross(Eigen::Vector3d(n.row(1))) - t).norm(), 1e-14);
  }
}

TEST(DirectionsAcross, InThePlaneIsTheVectorTurnedToTheLeft) {
  EXPECT_EQ(directions_across<2>({0.6, 0.8, 0}), Eigen::RowVector2d(-0.8, 0.6));
  EXPECT_EQ(directions_across<2>({3, 0, 0}), Eigen::RowVector2d(0, 3));
}

// Drawings lie along axes and diagonals: round-off of these must not exchange both directions.
TEST(DirectionsAcross, OfVectorsThatDifferByRoundOffAreTheSame) {
  std::mt19937 random(2);
  for (const Eigen::Vector3d& drawn :
       {Eigen::Vector3d(1, 0, 0), Eigen::Vector3d(0, 1, 0), Eigen::Vector3d(0, 0, -1),
        Eigen::Vector3d(1, 1, 0), Eigen::Vector3d(0, -1, 1), Eigen::Vector3d(1, 1, 1)})
    for (int trial = 0; trial < 20; ++trial) {
      const Eigen::Vector3d t = drawn.normalized(), beside = t + 1e-12 * random_vector(3, random);
      EXPECT_LT((directions_across<3>(beside) - directions_across<3>(t)).norm(), 1e-10) << t.transpose();
    }
}

}  // namespace nurbeam::testing::directions_across_test
