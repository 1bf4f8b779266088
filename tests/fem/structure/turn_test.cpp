#include "fem/structure/turn.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

namespace nurbeam::testing::turn_test {

using std::numbers::pi;

// The angle is the integral of the speed, and nothing jumps where the ramp begins and ends.
TEST(AngleMotion, GrowsToItsSpeedWithoutAJump) {
  const AngleMotion motion = AngleMotion::at_speed(6, 15);
  double angle = 0;
  constexpr int parts = 20000;
  for (int i = 0; i < parts; ++i) {
    const double t = 20.0 * (i + 0.5) / parts;
    angle += 20.0 / parts * motion.at(t).rate;
  }
  EXPECT_NEAR(motion.at(20).angle, angle, 1e-6);
  EXPECT_NEAR(motion.at(20).angle, 6 * (20 - 7.5), 1e-12);
  for (const double t : {0.0, 15.0})
    for (const double h : {-1e-6, 1e-6}) {
      EXPECT_NEAR(motion.at(t + h).rate, t == 0 ? 0 : 6, 1e-9);
      EXPECT_NEAR(motion.at(t + h).acceleration, 0, 1e-9);
    }
  for (const double t : {0.3, 4.0, 9.0, 14.5}) {
    const double h = 1e-4;
    EXPECT_NEAR((motion.at(t + h).angle - motion.at(t - h).angle) / (2 * h), motion.at(t).rate, 1e-7);
    EXPECT_NEAR((motion.at(t + h).rate - motion.at(t - h).rate) / (2 * h), motion.at(t).acceleration, 1e-7);
  }
  EXPECT_EQ(AngleMotion::at_speed(-2).at(3).angle, -6);
  EXPECT_EQ(AngleMotion::at_speed(-2).at(3).rate, -2);
}

TEST(AngleMotion, GoesNoFurtherThanItsBound) {
  const AngleMotion rows({{0, 0}, {1, 3}, {2, -1}});
  EXPECT_GE(rows.way(0, 2), 3 + 4);
  EXPECT_GE(AngleMotion::at_speed(6, 15).way(0, 20), 6 * 12.5 - 1e-9);
}

TEST(AxisTurn, IsARotationWithItsRates) {
  const AxisTurn turn{
      Eigen::Vector3d(1, -2, 0.5).normalized(), {1, 2, 3}, AngleMotion([](double t) {
        return AngleMotion::Moment{std::sin(3 * t), 3 * std::cos(3 * t), -9 * std::sin(3 * t)};
      })};
  const double t = 0.4, load = 0.7, h = 1e-4;
  const AxisTurn::Rotation now = turn.at(t, load);
  const Eigen::Matrix3d R = Eigen::AngleAxisd(load * std::sin(3 * t), turn.axis).toRotationMatrix();
  EXPECT_LT((now.R - R).norm(), 1e-14);
  EXPECT_LT((now.first - (turn.at(t + h, load).R - turn.at(t - h, load).R) / (2 * h)).norm(), 1e-6);
  EXPECT_LT((now.second - (turn.at(t + h, load).first - turn.at(t - h, load).first) / (2 * h)).norm(), 1e-6);
  EXPECT_LT((turn.by(2 * pi).R - Eigen::Matrix3d::Identity()).norm(), 1e-14);
}

}  // namespace nurbeam::testing::turn_test
