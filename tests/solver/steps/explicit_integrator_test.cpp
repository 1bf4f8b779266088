#include "solver/steps/explicit_integrator.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <numbers>
#include <stdexcept>
#include <vector>

#include "solver/steps/generalized_alpha.h"
#include "tests/support/ida/ida_integrator.h"
#include "tests/support/small_systems.h"

namespace nurbeam {
namespace {

using testing::CartesianPendulum;
using testing::DrivenSlider;
using testing::KeplerOrbit;
using testing::Oscillator;

State oscillator_state(const Oscillator& oscillator, double t) {
  const double w = oscillator.omega;
  State state;
  state.t = t;
  state.q = Eigen::VectorXd::Constant(1, std::cos(w * t));
  state.v = Eigen::VectorXd::Constant(1, -w * std::sin(w * t));
  state.a = Eigen::VectorXd::Constant(1, -w * w * std::cos(w * t));
  state.lambda.resize(0);
  return state;
}

State advance_evenly(Integrator& integrator, double time, int calls) {
  for (int i = 0; i < calls; ++i) {
    const StepReport report = integrator.advance(time / calls);
    EXPECT_EQ(report.status, StepStatus::converged);
    EXPECT_NEAR(report.step, time / calls, 1e-14);
    EXPECT_EQ(report.rejected, 0);
  }
  return integrator.state();
}

double distance(const State& a, const State& b) { return (a.q - b.q).norm() + (a.v - b.v).norm(); }

void expect_unchanged(const State& state, const State& before) {
  EXPECT_EQ(state.t, before.t);
  EXPECT_EQ(state.q, before.q);
  EXPECT_EQ(state.v, before.v);
  EXPECT_EQ(state.a, before.a);
}

TEST(ClassicalRungeKutta, MultipliesALinearSystemByTheTaylorPolynomialOfDegreeFour) {
  Oscillator oscillator;
  oscillator.damping_ratio = 0.1;
  const double w = oscillator.omega;
  const double h = 0.3;
  const Eigen::Matrix2d A = h * (Eigen::Matrix2d() << 0, 1, -w * w, -0.2 * w).finished();
  const Eigen::Matrix2d growth =
      Eigen::Matrix2d::Identity() + A + A * A / 2 + A * A * A / 6 + A * A * A * A / 24;
  ExplicitIntegrator integrator({}, oscillator, oscillator_state(oscillator, 0));
  Eigen::Vector2d y(1, 0);
  for (int i = 0; i < 50; ++i) {
    y = growth * y;
    ASSERT_EQ(integrator.advance(h).status, StepStatus::converged);
    EXPECT_NEAR(integrator.state().q[0], y[0], 1e-13);
    EXPECT_NEAR(integrator.state().v[0], y[1], 1e-13);
    EXPECT_NEAR(integrator.state().a[0], -w * w * y[0] - 0.2 * w * y[1], 1e-12);
  }
}

TEST(ClassicalRungeKutta, IsOfFourthOrderOnAnOrbitWhoseMassDependsOnPosition) {
  const KeplerOrbit orbit;
  const State start = orbit.at_nearest_point();
  State closed = start;
  closed.q[1] += 2 * std::numbers::pi;
  std::array<double, 4> errors;
  for (std::size_t i = 0; i < errors.size(); ++i) {
    ExplicitIntegrator integrator({}, orbit, start);
    errors[i] = distance(advance_evenly(integrator, 2 * std::numbers::pi, 200 << i), closed);
  }
  for (std::size_t i = 1; i < errors.size(); ++i)
    EXPECT_NEAR(std::log2(errors[i - 1] / errors[i]), 4, 0.25) << errors[i];
}

TEST(ClassicalRungeKutta, IsOfFourthOrderInAConstrainedPendulum) {
  const CartesianPendulum pendulum;
  const double time = 1.5;
  const State exact = pendulum.reference(1, time, 20000);
  std::array<double, 3> errors, drifts;
  for (std::size_t i = 0; i < errors.size(); ++i) {
    ExplicitIntegrator integrator({}, pendulum, pendulum.at_angle(0, 1, 0));
    const State end = advance_evenly(integrator, time, 50 << i);
    errors[i] = (end.q - exact.q).norm() + (end.lambda - exact.lambda).norm();
    drifts[i] = std::abs(end.q.norm() - pendulum.length);
  }
  for (std::size_t i = 1; i < errors.size(); ++i) {
    EXPECT_NEAR(std::log2(errors[i - 1] / errors[i]), 4, 0.4) << errors[i];
    EXPECT_GT(std::log2(drifts[i - 1] / drifts[i]), 3.5) << drifts[i];
  }
}

TEST(ClassicalRungeKutta, KeepsALinearConstraintToRoundOff) {
  const DrivenSlider slider;
  ExplicitIntegrator integrator({}, slider, slider.exact(0));
  const State end = advance_evenly(integrator, 2, 400);
  EXPECT_LT((end.q - slider.exact(end.t).q).norm(), 1e-7);
}

/// Counts the evaluations of the force.
class CountingOscillator : public Oscillator {
 public:
  mutable int evaluations = 0;
  void residual(const State& state, Eigen::Ref<Eigen::VectorXd> dynamics,
                Eigen::Ref<Eigen::VectorXd> constraints) const override {
    ++evaluations;
    Oscillator::residual(state, dynamics, constraints);
  }
};

TEST(ClassicalRungeKutta, EvaluatesTheForceFourTimesAStep) {
  const CountingOscillator oscillator;
  ExplicitIntegrator integrator({}, oscillator, oscillator_state(oscillator, 0));
  advance_evenly(integrator, 1, 100);
  EXPECT_EQ(oscillator.evaluations, 401);  // and the acceleration of the start
}

TEST(DormandPrince, ClosesAnOrbitAsCloselyAsItsToleranceSays) {
  const KeplerOrbit orbit;
  State closed = orbit.at_nearest_point();
  closed.q[1] += 2 * std::numbers::pi;
  for (const double tolerance : {1e-5, 1e-7, 1e-9, 1e-11}) {
    ExplicitIntegrator integrator({.tolerance = tolerance}, orbit, orbit.at_nearest_point());
    const StepReport report = integrator.advance(2 * std::numbers::pi);
    const State& end = integrator.state();
    ASSERT_EQ(report.status, StepStatus::converged);
    EXPECT_DOUBLE_EQ(end.t, 2 * std::numbers::pi);
    EXPECT_LT(report.local_error, 2 * tolerance);
    EXPECT_LT(distance(end, closed), 500 * tolerance);
    const double momentum = end.q[0] * end.q[0] * end.v[1];
    EXPECT_NEAR(momentum, std::sqrt(1 - orbit.eccentricity * orbit.eccentricity), 100 * tolerance);
    EXPECT_LT((end.a - closed.a).norm(), 1000 * tolerance);
  }
}

TEST(DormandPrince, GivesTheSameOverAThousandCallsAsOverTen) {
  const KeplerOrbit orbit;
  const ExplicitRungeKutta settings{.tolerance = 1e-9};
  ExplicitIntegrator few(settings, orbit, orbit.at_nearest_point());
  ExplicitIntegrator many(settings, orbit, orbit.at_nearest_point());
  EXPECT_LT(distance(advance_evenly(few, 3, 10), advance_evenly(many, 3, 1000)), 1e-6);
}

TEST(EveryIntegrator, BehindOneInterfaceFindsTheSameOscillation) {
  const Oscillator oscillator;
  const State start = oscillator_state(oscillator, 0);
  std::vector<std::unique_ptr<Integrator>> integrators;
  integrators.push_back(std::make_unique<GeneralizedAlphaIntegrator>(GeneralizedAlpha{}, oscillator, start));
  integrators.push_back(std::make_unique<IdaIntegrator>(Ida{}, oscillator, start));
  integrators.push_back(std::make_unique<ExplicitIntegrator>(ExplicitRungeKutta{}, oscillator, start));
  integrators.push_back(
      std::make_unique<ExplicitIntegrator>(ExplicitRungeKutta{.tolerance = 1e-8}, oscillator, start));
  const State exact = oscillator_state(oscillator, 2);
  for (const auto& integrator : integrators) {
    const State end = advance_evenly(*integrator, 2, 2000);
    EXPECT_NEAR(end.t, 2, 1e-12);
    EXPECT_LT(distance(end, exact), 1e-5);
    EXPECT_LT((end.a - exact.a).norm(), 1e-4);
  }
}

/// What can go wrong, from a place or a time on.
class FragileOscillator : public Oscillator {
 public:
  struct Tantrum {};
  double inertia = 1;
  double wall = std::numeric_limits<double>::infinity();
  double failure_time = std::numeric_limits<double>::infinity();
  double throw_time = std::numeric_limits<double>::infinity();
  double longest_step = std::numeric_limits<double>::infinity();

  void residual(const State& state, Eigen::Ref<Eigen::VectorXd> dynamics,
                Eigen::Ref<Eigen::VectorXd> constraints) const override {
    if (state.t >= throw_time) throw Tantrum();
    Oscillator::residual(state, dynamics, constraints);
    if (state.t >= failure_time) dynamics[0] = std::numeric_limits<double>::quiet_NaN();
  }
  bool admissible(const State& state) const override { return -state.q[0] < wall; }
  double step_limit(const State&) const override { return longest_step; }

 protected:
  Eigen::MatrixXd mass(const State&) const override { return Eigen::MatrixXd::Constant(1, 1, inertia); }
};

class ExplicitRungeKuttaFailure : public ::testing::TestWithParam<double> {
 protected:
  ExplicitIntegrator make() const {
    return ExplicitIntegrator({.tolerance = GetParam()}, oscillator, oscillator_state(oscillator, 0));
  }
  FragileOscillator oscillator;
};
INSTANTIATE_TEST_SUITE_P(WithFixedAndControlledSteps, ExplicitRungeKuttaFailure, ::testing::Values(0, 1e-8));

TEST_P(ExplicitRungeKuttaFailure, GoesUpToAnInadmissiblePlaceAndNotBeyond) {
  oscillator.wall = 0.5;
  ExplicitIntegrator integrator = make();
  double step = 0.1;
  while (step > 1e-6) {
    const State before = integrator.state();
    const StepReport report = integrator.advance(step);
    EXPECT_GT(integrator.state().q[0], -0.5);
    ASSERT_LT(integrator.state().t, 2);
    if (report.status == StepStatus::converged) continue;
    EXPECT_EQ(report.status, StepStatus::inadmissible);
    expect_unchanged(integrator.state(), before);
    step /= 4;
  }
  EXPECT_LT(integrator.state().q[0], -0.5 + 1e-4);
}

TEST_P(ExplicitRungeKuttaFailure, AForceThatIsNoNumberIsAStatusAndLeavesTheStateAlone) {
  for (const double failure_time : {-1.0, 1e-9}) {
    oscillator.failure_time = failure_time;
    ExplicitIntegrator integrator = make();
    const State start = integrator.state();
    const StepReport report = integrator.advance(0.1);
    EXPECT_EQ(report.status, StepStatus::not_converged);
    EXPECT_EQ(report.step, 0);
    expect_unchanged(integrator.state(), start);
    oscillator.failure_time = std::numeric_limits<double>::infinity();
    ASSERT_EQ(integrator.advance(0.001).status, StepStatus::converged);
    EXPECT_LT(distance(integrator.state(), oscillator_state(oscillator, 0.001)), 1e-9);
  }
}

TEST_P(ExplicitRungeKuttaFailure, ASingularMassIsAStatus) {
  oscillator.inertia = 0;
  ExplicitIntegrator integrator = make();
  const State start = integrator.state();
  EXPECT_EQ(integrator.advance(0.1).status, StepStatus::singular_matrix);
  expect_unchanged(integrator.state(), start);
}

TEST_P(ExplicitRungeKuttaFailure, WhatTheSystemThrowsArrivesAndLeavesTheStateAlone) {
  ExplicitIntegrator integrator = make();
  ASSERT_EQ(integrator.advance(0.001).status, StepStatus::converged);
  oscillator.throw_time = 0.0015;
  const State before = integrator.state();
  for (int i = 0; i < 2; ++i) {
    EXPECT_THROW((void)integrator.advance(0.001), FragileOscillator::Tantrum);
    expect_unchanged(integrator.state(), before);
  }
  oscillator.throw_time = std::numeric_limits<double>::infinity();
  ASSERT_EQ(integrator.advance(0.001).status, StepStatus::converged);
  EXPECT_LT(distance(integrator.state(), oscillator_state(oscillator, 0.002)), 1e-9);
}

TEST_P(ExplicitRungeKuttaFailure, AStepLimitBinds) {
  oscillator.longest_step = 0.003;
  ExplicitIntegrator integrator = make();
  const StepReport report = integrator.advance(0.01);
  ASSERT_EQ(report.status, StepStatus::converged);
  EXPECT_NEAR(report.step, GetParam() == 0 ? 0.003 : 0.01, 1e-15);
  for (const double nonsense : {0.0, -1.0, std::numeric_limits<double>::quiet_NaN()}) {
    oscillator.longest_step = nonsense;
    EXPECT_EQ(integrator.advance(0.01).status, StepStatus::inadmissible);
  }
}

TEST_P(ExplicitRungeKuttaFailure, AStepThatIsNoNumberOrMovesNoTimeIsAStatus) {
  ExplicitIntegrator integrator({.tolerance = GetParam()}, oscillator, oscillator_state(oscillator, 1));
  for (const double step : {0.0, -1.0, 1e-17, 1e-15, std::numeric_limits<double>::quiet_NaN(),
                            std::numeric_limits<double>::infinity()})
    EXPECT_EQ(integrator.advance(step).status, StepStatus::inadmissible) << step;
  for (const double step : {1e-14, 1e-12, 1e-9, 1e-3})
    EXPECT_EQ(integrator.advance(step).status, StepStatus::converged) << step;
}

TEST(DormandPrince, GivesUpAfterItsLargestNumberOfSteps) {
  const Oscillator oscillator;
  const State start = oscillator_state(oscillator, 0);
  ExplicitIntegrator integrator({.tolerance = 1e-10, .max_steps = 20}, oscillator, start);
  EXPECT_EQ(integrator.advance(10).status, StepStatus::not_converged);
  expect_unchanged(integrator.state(), start);
}

TEST(ExplicitRungeKuttaSettings, OutOfRangeAreRefused) {
  const Oscillator oscillator;
  const State start = oscillator_state(oscillator, 0);
  const auto make = [&](ExplicitRungeKutta settings) { ExplicitIntegrator(settings, oscillator, start); };
  EXPECT_THROW(make({.tolerance = -1}), std::invalid_argument);
  EXPECT_THROW(make({.tolerance = std::numeric_limits<double>::quiet_NaN()}), std::invalid_argument);
  EXPECT_THROW(make({.time_scale = 0}), std::invalid_argument);
  EXPECT_THROW(make({.max_halvings = -1}), std::invalid_argument);
  EXPECT_THROW(make({.max_steps = 0}), std::invalid_argument);
  EXPECT_THROW(ExplicitIntegrator({}, oscillator, State{}), std::invalid_argument);
}

}  // namespace
}  // namespace nurbeam
