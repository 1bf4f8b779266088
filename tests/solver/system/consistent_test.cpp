#include "solver/system/consistent.h"

#include <gtest/gtest.h>

#include "tests/support/small_systems.h"

namespace nurbeam {
namespace {

using testing::CartesianPendulum;
using testing::DrivenSlider;

/// The same constraint twice: its mass matrix is singular.
class DoublyHeldMass : public testing::DenseSystem {
 public:
  int coordinate_count() const override { return 2; }
  int constraint_count() const override { return 2; }
  void residual(const State& state, Eigen::Ref<Eigen::VectorXd> dynamics,
                Eigen::Ref<Eigen::VectorXd> constraints) const override {
    dynamics = state.a + constraint_jacobian(state).transpose() * state.lambda;
    constraints = constraint_jacobian(state) * state.q;
  }

 protected:
  Eigen::MatrixXd mass(const State&) const override { return Eigen::Matrix2d::Identity(); }
  Eigen::MatrixXd stiffness(const State&) const override { return Eigen::Matrix2d::Zero(); }
  Eigen::MatrixXd constraint_jacobian(const State&) const override {
    return (Eigen::Matrix2d() << 1, 3, 1, 3).finished();
  }
};

TEST(Consistent, AccelerationAndMultiplierOfAPendulumAreThoseOfItsClosedForm) {
  const CartesianPendulum pendulum;
  const State expected = pendulum.at_angle(0, 0.7, 1.3);
  State state = expected;
  state.a.setZero();
  state.lambda.setZero();
  ASSERT_EQ(make_accelerations_consistent(pendulum, state), ConsistencyStatus::done);
  EXPECT_LT((state.a - expected.a).norm(), 1e-13 * expected.a.norm());
  EXPECT_NEAR(state.lambda[0], expected.lambda[0], 1e-13 * expected.lambda[0]);
}

TEST(Consistent, AMovingConstraintIsFollowedInVelocityAndAcceleration) {
  const DrivenSlider slider;
  const State expected = slider.exact(0.4);
  State state = expected;
  state.v[0] = 0;
  const Projection projection = project_velocities(slider, state);
  ASSERT_EQ(projection.status, ConsistencyStatus::done);
  EXPECT_NEAR(state.v[0], expected.v[0], 1e-14);
  EXPECT_DOUBLE_EQ(state.v[1], expected.v[1]);
  EXPECT_NEAR(projection.impulse[0], -slider.first_mass * expected.v[0], 1e-13);
  ASSERT_EQ(make_accelerations_consistent(slider, state), ConsistencyStatus::done);
  EXPECT_LT((state.a - expected.a).norm(), 1e-13);
  EXPECT_NEAR(state.lambda[0], expected.lambda[0], 1e-13);
}

TEST(Consistent, ProjectionTakesOutTheRadialVelocityAndItsMomentumIsTheImpulse) {
  const CartesianPendulum pendulum;
  const State swinging = pendulum.at_angle(0, 0.7, 1.3);
  State state = swinging;
  state.v += 0.25 * state.q;
  const Projection projection = project_velocities(pendulum, state);
  ASSERT_EQ(projection.status, ConsistencyStatus::done);
  EXPECT_LT((state.v - swinging.v).norm(), 1e-14);
  EXPECT_NEAR(projection.impulse[0], 0.25 * pendulum.point_mass, 1e-14);
}

TEST(Consistent, TheVelocityOfAMomentumKeepsItsTangentialPart) {
  const CartesianPendulum pendulum;
  const State swinging = pendulum.at_angle(0, 0.7, 1.3);
  State state = swinging;
  state.v.setZero();
  const Eigen::VectorXd momentum = pendulum.point_mass * swinging.v + 3 * swinging.q;
  const Projection projection = velocities_from_momentum(pendulum, momentum, state);
  ASSERT_EQ(projection.status, ConsistencyStatus::done);
  EXPECT_LT((state.v - swinging.v).norm(), 1e-14);
  EXPECT_NEAR(projection.impulse[0], 3, 1e-13);
}

TEST(Consistent, ConstraintsAreClosedByTheNearestPlaces) {
  const CartesianPendulum pendulum;
  const State swinging = pendulum.at_angle(0, 0.7, 1.3);
  State state = swinging;
  state.q *= 1.2;
  EXPECT_GT(open_constraints(pendulum, state), 0.1);
  ASSERT_TRUE(close_constraints(pendulum, 1e-14, state));
  EXPECT_LT((state.q - swinging.q).norm(), 1e-14);
  EXPECT_LE(open_constraints(pendulum, state), 1e-14);
  const State closed = state;
  ASSERT_TRUE(close_constraints(pendulum, 1e-14, state));
  EXPECT_EQ(state.q, closed.q);
}

TEST(Consistent, ConstraintsAreClosedToRoundOffWhereverThatIs) {
  const CartesianPendulum pendulum;
  const State swinging = pendulum.at_angle(0, 0.7, 1.3);
  State state = swinging;
  state.q *= 1 + 1e-9;
  close_constraints_to_round_off(pendulum, state);
  EXPECT_LE(open_constraints(pendulum, state), 1e-15);
  EXPECT_LT((state.q - swinging.q).norm(), 1e-14);
}

TEST(Consistent, RedundantConstraintsAreReportedAndLeaveTheStateAlone) {
  const DoublyHeldMass system;
  State state{.t = 0,
              .q = Eigen::Vector2d::Zero(),
              .v = Eigen::Vector2d(1, 2),
              .a = Eigen::Vector2d(3, 4),
              .lambda = Eigen::Vector2d(5, 6)};
  const State before = state;
  EXPECT_EQ(make_accelerations_consistent(system, state), ConsistencyStatus::singular);
  EXPECT_EQ(project_velocities(system, state).status, ConsistencyStatus::singular);
  EXPECT_EQ(velocities_from_momentum(system, state.v, state).status, ConsistencyStatus::singular);
  state.q = Eigen::Vector2d(1, 1);
  EXPECT_FALSE(close_constraints(system, 1e-14, state));
  state.q = before.q;
  EXPECT_EQ(state.v, before.v);
  EXPECT_EQ(state.a, before.a);
  EXPECT_EQ(state.lambda, before.lambda);
}

}  // namespace
}  // namespace nurbeam
