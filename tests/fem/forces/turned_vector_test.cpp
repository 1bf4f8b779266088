#include "fem/forces/turned_vector.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <random>

#include "fem/forces/moment.h"

namespace nurbeam {
namespace {

void expect_gradient(const auto& f, const Eigen::Vector3d& x, const Eigen::Matrix3d& gradient) {
  for (int i = 0; i < 3; ++i) {
    const auto error = [&](double h) {
      const Eigen::Vector3d d = h * Eigen::Vector3d::Unit(i);
      return ((f(x + d) - f(x - d)) / (2 * h) - gradient.col(i)).norm();
    };
    const double coarse = error(2e-3), fine = error(1e-3);
    EXPECT_LT(fine, 1e-4);
    if (coarse > 1e-10) EXPECT_NEAR(coarse / fine, 4, 0.3);
  }
}

TEST(TurnedVector, HasTheDerivativeOfItsValueInTheSlope) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> unit(-1, 1);
  const auto any = [&] { return Eigen::Vector3d(unit(random), unit(random), unit(random)); };
  for (int trial = 0; trial < 20; ++trial) {
    const Eigen::Vector3d p = any(), drawn = any().normalized(), rs = drawn + 0.8 * any();
    if (drawn.dot(rs.normalized()) < -0.8) continue;
    const auto value = [&](const Eigen::Vector3d& x) { return turned_with_tangent(p, drawn, x).value; };
    expect_gradient(value, rs, turned_with_tangent(p, drawn, rs).gradient);
    const auto force = [&](const Eigen::Vector3d& x) {
      return moment_on_slope(turned_with_tangent(p, drawn, x), x).value;
    };
    expect_gradient(force, rs, moment_on_slope(turned_with_tangent(p, drawn, rs), rs).gradient);
  }
}

TEST(TurnedVector, KeepsItsLengthAndItsAngleWithTheTangent) {
  const Eigen::Vector3d p(0.3, -1, 0.5), drawn(0, 0.6, 0.8), rs(2, 1, -0.5);
  const Eigen::Vector3d turned = turned_with_tangent(p, drawn, rs).value;
  EXPECT_NEAR(turned.norm(), p.norm(), 1e-15);
  EXPECT_NEAR(turned.dot(rs.normalized()), p.dot(drawn), 1e-15);
}

TEST(TurnedVector, InThePlaneIsRegularForEveryAngle) {
  const Eigen::Vector3d p(1, 2, 0), drawn(1, 0, 0), opposite(-3, 0, 0);
  EXPECT_LT((turned_with_tangent(p, drawn, opposite).value + p).norm(), 1e-15);
}

TEST(Moment, DoesItsWorkOnTheTurningOfTheSlopeAndOnNoOther) {
  const Eigen::Vector3d m(0.2, -1, 0.7), rs(1, 0.4, -0.3);
  const Eigen::Vector3d f = moment_on_slope({m, Eigen::Matrix3d::Zero()}, rs).value;
  EXPECT_NEAR(f.dot(rs), 0, 1e-15);  // none on stretching
  const Eigen::Vector3d w(0.1, 0.3, -0.2);
  const Eigen::Vector3d across = m - m.dot(rs) / rs.squaredNorm() * rs;
  EXPECT_NEAR(f.dot(w.cross(rs)), across.dot(w), 1e-15);
}

}  // namespace
}  // namespace nurbeam
