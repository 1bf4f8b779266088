#include "fem/comparison/merged_weights.h"

#include <gtest/gtest.h>

#include "nurbs/rational_cubic.h"

namespace nurbeam {
namespace {

TEST(MergedWeights, LeadTheCurveThroughTheRemovedNode) {
  const Eigen::Vector3d a(0, 0, 0), slope_a(1.2, 0.3, 0.1), b(1, 0.4, 0.2), slope_b(0.9, 0.5, -0.1);
  const double u = 0.45;
  // A cubic with equal weights passes here; the wanted point is beside it in all directions.
  const auto curve = [&](const std::array<double, 4>& w) {
    Eigen::Matrix4d points;
    points.col(0) << w[0] * a, w[0];
    points.col(1) << w[1] * a + w[0] * slope_a / 3, w[1];
    points.col(2) << w[2] * b - w[3] * slope_b / 3, w[2];
    points.col(3) << w[3] * b, w[3];
    return RationalCubic(points).point(u);
  };
  const Eigen::Vector3d plain = curve({1, 1, 1, 1});
  // Reachable points are those of some admissible weights.
  const Eigen::Vector3d wanted = curve({1.05, 0.97, 1.04, 1});
  const std::array<double, 4> w = merged_weights(3, a, slope_a, b, slope_b, wanted, u);
  EXPECT_LT((curve(w) - wanted).norm(), 0.02 * (plain - wanted).norm());
  EXPECT_EQ(w[3], 1);

  const std::array<double, 4> planar = merged_weights(2, a, slope_a, b, slope_b, wanted, u);
  EXPECT_LT((curve(planar) - wanted).head<2>().norm(), 1e-12);
}

TEST(MergedWeights, AreOnesWhereTheRuleGivesNoneThatArePositive) {
  const Eigen::Vector3d a(0, 0, 0), slope(1, 0, 0), b(1, 0, 0);
  const std::array<double, 4> w = merged_weights(2, a, slope, b, slope, {0.2, 30, 0}, 0.5);
  EXPECT_EQ(w, (std::array<double, 4>{1, 1, 1, 1}));
}

}  // namespace
}  // namespace nurbeam
