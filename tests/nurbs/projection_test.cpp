#include "nurbs/projection.h"

#include <gtest/gtest.h>

namespace nurbeam {
namespace {

TEST(ProjectionTest, TheHalfAngleCircleHasTheDerivativesOfItsSeriesAtZero) {
  // ((1 - u^2), 2u) / (1 + u^2) = (1 - 2u^2 + 2u^4 - ..., 2u - 2u^3 + 2u^5 - ...)
  Eigen::Matrix<double, 4, 6> homogeneous = Eigen::Matrix<double, 4, 6>::Zero();
  homogeneous.col(0) << 1, 0, 0, 1;
  homogeneous.col(1) << 0, 2, 0, 0;
  homogeneous.col(2) << -2, 0, 0, 2;
  Eigen::Matrix<double, 3, 6> expected = Eigen::Matrix<double, 3, 6>::Zero();
  expected.row(0) << 1, 0, -4, 0, 48, 0;
  expected.row(1) << 0, 2, 0, -12, 0, 240;
  EXPECT_EQ(projected_derivatives(homogeneous), expected);
}

TEST(ProjectionTest, ACommonFactorDoesNotCount) {
  const Eigen::Matrix4d homogeneous = Eigen::Matrix4d::Random().array() + 2;
  const Eigen::Matrix<double, 3, 4> once = projected_derivatives(homogeneous);
  const Eigen::Matrix<double, 3, 4> scaled = projected_derivatives<4>(0.25 * homogeneous);
  EXPECT_EQ(once, scaled);
}

}  // namespace
}  // namespace nurbeam
