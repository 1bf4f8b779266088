#include "solver/system/scaled_equations.h"

#include <gtest/gtest.h>

#include <limits>

#include "tests/support/small_systems.h"

namespace nurbeam {
namespace {

using testing::CartesianPendulum;

/// A pendulum far from equilibrium, with forces of some 1e6 N and a length of 1e-2 m.
struct Swung {
  Swung() {
    pendulum.point_mass = 1e5;
    pendulum.length = 1e-2;
    start = pendulum.at_angle(0, 0.9, 0);
    start.lambda[0] *= 1.3;
  }
  CartesianPendulum pendulum;
  State start;
};

TEST(ScaledEquations, TakeAStateToUnknownsAndBack) {
  const Swung swung;
  ScaledEquations equations(swung.pendulum, swung.start);
  equations.rescale(swung.start, 1e4);
  const State& back = equations.state_of(equations.scaled_unknowns(swung.start));
  EXPECT_LT((back.q - swung.start.q).norm(), 1e-15 * swung.start.q.norm());
  EXPECT_NEAR(back.lambda[0], swung.start.lambda[0], 1e-15 * swung.start.lambda[0]);
  EXPECT_EQ(back.v, Eigen::Vector2d::Zero());
  EXPECT_EQ(back.a, Eigen::Vector2d::Zero());
}

TEST(ScaledEquations, RowsAreWorkOverTheGivenAndLengthsOverTheCoordinatesSize) {
  const Swung swung;
  const double work = 1e4, l = swung.pendulum.length;
  ScaledEquations equations(swung.pendulum, swung.start);
  equations.rescale(swung.start, work);
  State off = swung.start;
  off.q *= 1.001;  // the rod is longer by a thousandth
  Eigen::Vector3d rows;
  ASSERT_TRUE(equations.evaluate(equations.scaled_unknowns(off), rows));
  Eigen::Vector2d force = off.q * off.lambda[0];
  force.y() += swung.pendulum.point_mass * swung.pendulum.gravity;
  EXPECT_LT((rows.head<2>() - force * l / work).norm(), 1e-12);
  const double moved = (std::sin(0.9) + std::cos(0.9)) * l * l;  // sum of |G_j| s_j
  EXPECT_NEAR(rows[2], 0.5 * (1.001 * 1.001 - 1) * l * l / moved, 1e-15);
}

TEST(ScaledEquations, TheDerivativeIsTheLimitOfDifferencesAtSecondOrder) {
  const Swung swung;
  ScaledEquations equations(swung.pendulum, swung.start);
  equations.rescale(swung.start, 1e4);
  for (const double proximity : {0.0, 7.0}) {
    equations.set_proximity(proximity, Eigen::Vector2d(0.001, -0.002));
    const Eigen::Vector3d x = equations.scaled_unknowns(swung.start);
    ASSERT_TRUE(equations.differentiate(x));
    const Eigen::Matrix3d derivative = equations.tangent();
    const Eigen::Vector3d along(0.3, -0.5, 0.4);
    double errors[2];
    for (const int k : {0, 1}) {
      const double h = k == 0 ? 0.1 : 0.05;
      Eigen::Vector3d forward, backward;
      ASSERT_TRUE(equations.evaluate(x + h * along, forward));
      ASSERT_TRUE(equations.evaluate(x - h * along, backward));
      errors[k] = ((forward - backward) / (2 * h) - derivative * along).norm();
    }
    EXPECT_LE(errors[0], 1e-10 * derivative.norm()) << "the equations are quadratic: differences are exact";
    EXPECT_LE(errors[1], 1e-10 * derivative.norm());
  }
}

TEST(ScaledEquations, ProximityIsAnAccelerationTowardsItsCentre) {
  const Swung swung;
  ScaledEquations equations(swung.pendulum, swung.start);
  const Eigen::Vector3d x = equations.scaled_unknowns(swung.start);
  const Eigen::Vector2d centre(0.001, 0.002);
  equations.set_proximity(3, centre);
  EXPECT_LT((equations.state_of(x).a - 3 * (swung.start.q - centre)).norm(), 1e-15);
  equations.clear_proximity();
  EXPECT_EQ(equations.state_of(x).a, Eigen::Vector2d::Zero());
  const double l = swung.pendulum.length;
  EXPECT_NEAR(equations.inertial_work(swung.start), swung.pendulum.point_mass * l * l, 1e-10);
}

TEST(ScaledEquations, WhatMeansNothingIsNeitherEvaluatedNorAcceptable) {
  Swung swung;
  swung.pendulum.wall = 0;  // the start is beyond it
  ScaledEquations equations(swung.pendulum, swung.start);
  Eigen::Vector3d x = equations.scaled_unknowns(swung.start), rows;
  EXPECT_FALSE(equations.evaluate(x, rows));
  EXPECT_FALSE(equations.quality(x, 1).acceptable);
  EXPECT_EQ(equations.quality(x, 1).residual_norm, std::numeric_limits<double>::infinity());
  swung.pendulum.wall = 1;
  x[0] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(equations.evaluate(x, rows));
}

TEST(ScaledEquations, OnlyARestingStateIsAcceptableAtRoundOff) {
  const Swung swung;
  ScaledEquations equations(swung.pendulum, swung.start);
  equations.rescale(swung.start, 1e4);
  const State hanging = swung.pendulum.at_angle(0, 0, 0);
  EXPECT_TRUE(equations.quality(equations.scaled_unknowns(hanging), 1e-14).acceptable);
  State off = hanging;
  off.lambda *= 1 + 1e-9;
  EXPECT_FALSE(equations.quality(equations.scaled_unknowns(off), 1e-14).acceptable);
}

}  // namespace
}  // namespace nurbeam
