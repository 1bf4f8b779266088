#include "tests/support/ida/ida_integrator.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

#include "solver/steps/generalized_alpha.h"
#include "tests/support/small_systems.h"

namespace nurbeam {
namespace {

using testing::CartesianPendulum;
using testing::DrivenSlider;
using testing::KeplerOrbit;

State advance_ida_evenly(Integrator& integrator, double time, int calls) {
  for (int i = 0; i < calls; ++i) {
    const StepReport report = integrator.advance(time / calls);
    EXPECT_EQ(report.status, StepStatus::converged);
    EXPECT_EQ(report.step, time / calls);
  }
  return integrator.state();
}

double ida_distance(const State& a, const State& b) { return (a.q - b.q).norm() + (a.v - b.v).norm(); }

TEST(Ida, FollowsAPendulumWithItsMultiplierAsCloselyAsItsToleranceSays) {
  const CartesianPendulum pendulum;
  const State exact = pendulum.reference(1.2, 2.0, 20000);
  for (const double tolerance : {1e-6, 1e-8, 1e-10, 1e-12}) {
    IdaIntegrator integrator({.tolerance = tolerance}, pendulum, pendulum.at_angle(0, 1.2, 0));
    const State end = advance_ida_evenly(integrator, 2.0, 10);
    EXPECT_DOUBLE_EQ(end.t, 2.0);
    EXPECT_LT((end.q - exact.q).norm(), 200 * tolerance);
    EXPECT_LT((end.v - exact.v).norm(), 500 * tolerance);
    EXPECT_LT((end.a - exact.a).norm(), 5e3 * tolerance);
    EXPECT_LT((end.lambda - exact.lambda).norm(), 5e3 * tolerance);
    EXPECT_NEAR(pendulum.energy(end), pendulum.energy(exact), 2e3 * tolerance);
  }
}

TEST(Ida, KeepsPositionAndVelocityOnTheConstraint) {
  const CartesianPendulum pendulum;
  const double tolerance = 1e-8;
  IdaIntegrator integrator({.tolerance = tolerance}, pendulum, pendulum.at_angle(0, 3.0, 0));
  for (int i = 0; i < 500; ++i) {
    ASSERT_EQ(integrator.advance(0.1).status, StepStatus::converged);
    const State& state = integrator.state();
    EXPECT_NEAR(state.q.norm(), pendulum.length, tolerance);
    EXPECT_NEAR(state.q.dot(state.v), 0, 10 * tolerance);
  }
}

TEST(Ida, FollowsAMovingConstraint) {
  const DrivenSlider slider;
  for (const double tolerance : {1e-6, 1e-9}) {
    IdaIntegrator integrator({.tolerance = tolerance}, slider, slider.exact(0.3));
    const State end = advance_ida_evenly(integrator, 1.7, 7);
    const State exact = slider.exact(2.0);
    EXPECT_LT(ida_distance(end, exact), 200 * tolerance);
    EXPECT_NEAR(end.lambda[0], exact.lambda[0], 5e3 * tolerance);
    EXPECT_NEAR(end.q[0], exact.q[0], 0.1 * tolerance);
    EXPECT_NEAR(end.v[0], exact.v[0], 0.1 * tolerance);
  }
}

TEST(Ida, ClosesAnOrbitWithoutConstraintsAndWithAMassThatDependsOnPosition) {
  const KeplerOrbit orbit;
  State start = orbit.at_nearest_point();
  IdaIntegrator integrator({.tolerance = 1e-10}, orbit, start);
  const State end = advance_ida_evenly(integrator, 2 * std::numbers::pi, 3);
  start.q[1] += 2 * std::numbers::pi;
  EXPECT_LT(ida_distance(end, start), 1e-6);
  EXPECT_LT((end.a - start.a).norm(), 1e-5);
}

TEST(Ida, AndGeneralizedAlphaApproachEachOtherAsBothAreRefined) {
  const CartesianPendulum pendulum;
  const State start = pendulum.at_angle(0, 1.2, 0);
  double last = std::numeric_limits<double>::infinity();
  for (int i = 0; i < 4; ++i) {
    IdaIntegrator ida({.tolerance = 1e-5 * std::pow(0.02, i)}, pendulum, start);
    GeneralizedAlphaIntegrator alpha({.newton_tolerance = 1e-14}, pendulum, start);
    const State one = advance_ida_evenly(ida, 2.0, 5);
    const State other = advance_ida_evenly(alpha, 2.0, 100 << (2 * i));
    const double apart = ida_distance(one, other) + (one.lambda - other.lambda).norm();
    EXPECT_LT(apart, last / 10);
    last = apart;
  }
  EXPECT_LT(last, 1e-5);
}

TEST(Ida, GivesTheSameOverAThousandCallsAsOverTen) {
  const CartesianPendulum pendulum;
  IdaIntegrator few({}, pendulum, pendulum.at_angle(0, 1.2, 0));
  IdaIntegrator many({}, pendulum, pendulum.at_angle(0, 1.2, 0));
  const State one = advance_ida_evenly(few, 2.0, 10);
  const State other = advance_ida_evenly(many, 2.0, 1000);
  EXPECT_NEAR(one.t, other.t, 1e-12);
  EXPECT_LT(ida_distance(one, other), 5e-6);
  EXPECT_LT((one.lambda - other.lambda).norm(), 5e-5);
}

TEST(Ida, KeepsItsHistoryBetweenCalls) {
  const CartesianPendulum pendulum;
  IdaIntegrator integrator({.tolerance = 1e-6}, pendulum, pendulum.at_angle(0, 1.2, 0));
  advance_ida_evenly(integrator, 0.1, 1);
  const long at_start = integrator.internal_steps();
  advance_ida_evenly(integrator, 1.0, 1000);
  EXPECT_LT(integrator.internal_steps() - at_start, 1100);
}

TEST(Ida, SolvesItsEquationsInAFewIterationsWhereTheConstraintTurnsFast) {
  const CartesianPendulum pendulum;
  IdaIntegrator integrator({}, pendulum, pendulum.at_angle(0, 0, 30));
  const StepReport report = integrator.advance(1.0);
  ASSERT_EQ(report.status, StepStatus::converged);
  EXPECT_LT(report.newton_iterations, 3.0 * static_cast<double>(integrator.internal_steps()));
  EXPECT_LT(report.rejected, 0.1 * static_cast<double>(integrator.internal_steps()));
  EXPECT_LT(report.residual_norm, 1e-3);
  EXPECT_LE(report.local_error, 1e-8);
}

TEST(Ida, DoesNotDependOnTheUnitOfLength) {
  const CartesianPendulum metres;
  CartesianPendulum millimetres;
  millimetres.length *= 1000;
  millimetres.gravity *= 1000;
  IdaIntegrator one({}, metres, metres.at_angle(0, 1.2, 0));
  IdaIntegrator other({}, millimetres, millimetres.at_angle(0, 1.2, 0));
  const State a = advance_ida_evenly(one, 1.0, 4);
  State b = advance_ida_evenly(other, 1.0, 4);
  b.q /= 1000;
  b.v /= 1000;
  EXPECT_LT(ida_distance(a, b), 2e-6);
  EXPECT_NEAR(static_cast<double>(other.internal_steps()), static_cast<double>(one.internal_steps()), 20);
}

TEST(Ida, TakesNoStepBeyondTheLimit) {
  CartesianPendulum pendulum;
  pendulum.longest_step = 1e-4;
  IdaIntegrator integrator({.tolerance = 1e-4}, pendulum, pendulum.at_angle(0, 1.2, 0));
  ASSERT_EQ(integrator.advance(0.5).status, StepStatus::converged);
  EXPECT_GE(integrator.internal_steps(), 5000);
  const State before = integrator.state();
  for (const double nonsense : {0.0, -1.0, std::numeric_limits<double>::quiet_NaN()}) {
    pendulum.longest_step = nonsense;
    EXPECT_EQ(integrator.advance(0.01).status, StepStatus::inadmissible);
    EXPECT_EQ(integrator.state().q, before.q);
  }
}

TEST(Ida, GivesUpAfterItsLargestNumberOfSteps) {
  const CartesianPendulum pendulum;
  const State start = pendulum.at_angle(0, 1.2, 0);
  IdaIntegrator integrator({.max_steps = 20}, pendulum, start);
  EXPECT_EQ(integrator.advance(1).status, StepStatus::not_converged);
  EXPECT_EQ(integrator.state().t, 0);
  EXPECT_EQ(integrator.state().q, start.q);
}

void expect_ida_unchanged(const State& state, const State& before) {
  EXPECT_EQ(state.t, before.t);
  EXPECT_EQ(state.q, before.q);
  EXPECT_EQ(state.v, before.v);
  EXPECT_EQ(state.a, before.a);
  EXPECT_EQ(state.lambda, before.lambda);
}

TEST(Ida, GoesUpToAnInadmissiblePlaceAndNotBeyond) {
  CartesianPendulum pendulum;
  pendulum.wall = 0;
  IdaIntegrator integrator({}, pendulum, pendulum.at_angle(0, -0.5, 0));
  double step = 0.1;
  while (step > 1e-6) {
    const State before = integrator.state();
    const StepReport report = integrator.advance(step);
    EXPECT_LT(integrator.state().q[0], 0);
    ASSERT_LT(integrator.state().t, 1);
    if (report.status == StepStatus::converged) continue;
    EXPECT_EQ(report.status, StepStatus::inadmissible);
    EXPECT_EQ(report.step, 0);
    expect_ida_unchanged(integrator.state(), before);
    step /= 4;
  }
  EXPECT_GT(integrator.state().q[0], -1e-4);
}

TEST(Ida, AForceThatIsNoNumberIsAStatusAndLeavesTheStateAlone) {
  CartesianPendulum pendulum;
  for (const double failure_time : {-1.0, 1e-9, 0.35}) {
    pendulum.failure_time = failure_time;
    const State start = pendulum.at_angle(0, 1.2, 0);
    IdaIntegrator integrator({}, pendulum, start);
    EXPECT_EQ(integrator.advance(1).status, StepStatus::not_converged);
    expect_ida_unchanged(integrator.state(), start);
  }
  const State start = pendulum.at_angle(0, 1.2, 0);
  IdaIntegrator integrator({}, pendulum, start);
  EXPECT_EQ(integrator.advance(1).status, StepStatus::not_converged);
  EXPECT_EQ(integrator.advance(0.3).status, StepStatus::converged);
  EXPECT_LT(ida_distance(integrator.state(), pendulum.reference(1.2, 0.3, 3000)), 1e-6);
}

/// A pendulum whose constraint is stated twice.
class RedundantPendulum : public CartesianPendulum {
 public:
  int constraint_count() const override { return 2; }
  void residual(const State& state, Eigen::Ref<Eigen::VectorXd> dynamics,
                Eigen::Ref<Eigen::VectorXd> constraints) const override {
    State single = state;
    single.lambda = Eigen::VectorXd::Constant(1, state.lambda.sum());
    CartesianPendulum::residual(single, dynamics, constraints.head(1));
    constraints[1] = constraints[0];
  }
  Eigen::VectorXd constraint_curvature(const State& state) const override {
    return Eigen::VectorXd::Constant(2, state.v.squaredNorm());
  }

 protected:
  Eigen::MatrixXd stiffness(const State& state) const override {
    return state.lambda.sum() * Eigen::Matrix2d::Identity();
  }
  Eigen::MatrixXd constraint_jacobian(const State& state) const override {
    return state.q.transpose().replicate(2, 1);
  }
};

TEST(Ida, ASingularMatrixIsAStatus) {
  const RedundantPendulum pendulum;
  State start = pendulum.at_angle(0, 1.2, 0);
  start.lambda = Eigen::Vector2d::Constant(start.lambda[0] / 2);
  IdaIntegrator integrator({}, pendulum, start);
  for (int i = 0; i < 2; ++i) {
    EXPECT_EQ(integrator.advance(0.1).status, StepStatus::singular_matrix);
    expect_ida_unchanged(integrator.state(), start);
  }
}

/// Throws from one of its functions from a time on.
class ThrowingPendulum : public CartesianPendulum {
 public:
  struct Tantrum {};
  enum class Place { residual, tangent, rate, admissible, step_limit } place = Place::residual;
  double throw_time = std::numeric_limits<double>::infinity();

  void residual(const State& state, Eigen::Ref<Eigen::VectorXd> dynamics,
                Eigen::Ref<Eigen::VectorXd> constraints) const override {
    pass(Place::residual, state);
    CartesianPendulum::residual(state, dynamics, constraints);
  }
  void tangent(const State& state, const TangentWeights& w, SparseValues kkt) const override {
    pass(Place::tangent, state);
    CartesianPendulum::tangent(state, w, kkt);
  }
  Eigen::VectorXd constraint_rate(const State& state) const override {
    pass(Place::rate, state);
    return CartesianPendulum::constraint_rate(state);
  }
  bool admissible(const State& state) const override {
    pass(Place::admissible, state);
    return true;
  }
  double step_limit(const State& state) const override {
    pass(Place::step_limit, state);
    return std::numeric_limits<double>::infinity();
  }

 private:
  void pass(Place here, const State& state) const {
    if (here == place && state.t >= throw_time) throw Tantrum();
  }
};

TEST(Ida, WhatTheSystemThrowsArrivesAndLeavesTheStateAlone) {
  using Place = ThrowingPendulum::Place;
  for (const Place place :
       {Place::residual, Place::tangent, Place::rate, Place::admissible, Place::step_limit}) {
    ThrowingPendulum pendulum;
    pendulum.place = place;
    IdaIntegrator integrator({}, pendulum, pendulum.at_angle(0, 1.2, 0));
    ASSERT_EQ(integrator.advance(0.1).status, StepStatus::converged);
    pendulum.throw_time = 0.15;
    const State before = integrator.state();
    for (int i = 0; i < 2; ++i) {
      EXPECT_THROW((void)integrator.advance(0.1), ThrowingPendulum::Tantrum);
      expect_ida_unchanged(integrator.state(), before);
    }
    pendulum.throw_time = std::numeric_limits<double>::infinity();
    ASSERT_EQ(integrator.advance(0.1).status, StepStatus::converged);
    EXPECT_LT(ida_distance(integrator.state(), pendulum.reference(1.2, 0.2, 3000)), 1e-6);
  }
}

TEST(Ida, AStepThatIsNoNumberOrMovesNoTimeIsAStatus) {
  const CartesianPendulum pendulum;
  IdaIntegrator integrator({}, pendulum, pendulum.at_angle(1, 1.2, 0));
  for (const double step : {0.0, -1.0, 1e-17, 1e-15, std::numeric_limits<double>::quiet_NaN(),
                            std::numeric_limits<double>::infinity()})
    EXPECT_EQ(integrator.advance(step).status, StepStatus::inadmissible) << step;
  for (const double step : {1e-14, 1e-12, 1e-9, 1e-3})
    EXPECT_EQ(integrator.advance(step).status, StepStatus::converged) << step;
}

TEST(Ida, RefusesSettingsOutOfRangeAndStartsOfTheWrongSize) {
  const CartesianPendulum pendulum;
  const State start = pendulum.at_angle(0, 1.2, 0);
  const auto make = [&](Ida settings) { IdaIntegrator(settings, pendulum, start); };
  EXPECT_THROW(make({.tolerance = 0}), std::invalid_argument);
  EXPECT_THROW(make({.tolerance = std::numeric_limits<double>::quiet_NaN()}), std::invalid_argument);
  EXPECT_THROW(make({.time_scale = 0}), std::invalid_argument);
  EXPECT_THROW(make({.time_scale = std::numeric_limits<double>::infinity()}), std::invalid_argument);
  EXPECT_THROW(make({.max_order = 0}), std::invalid_argument);
  EXPECT_THROW(make({.max_order = 6}), std::invalid_argument);
  EXPECT_THROW(make({.max_steps = 0}), std::invalid_argument);
  EXPECT_THROW(IdaIntegrator({}, pendulum, State{}), std::invalid_argument);
}

}  // namespace
}  // namespace nurbeam
