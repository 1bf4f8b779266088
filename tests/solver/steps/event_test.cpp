#include "solver/steps/event.h"

#include <gtest/gtest.h>

#include <memory>

#include "solver/steps/explicit_integrator.h"
#include "solver/steps/generalized_alpha.h"
#include "solver/steps/radau_integrator.h"
#include "tests/support/ida/ida_integrator.h"
#include "tests/support/small_systems.h"

namespace nurbeam {
namespace {

using testing::CartesianPendulum;

// A pendulum let go at an angle passes the vertical: the angle is an event of known time.
void check_landing(Integrator& integrator, const CartesianPendulum& pendulum, double step, double accuracy) {
  const auto g = [](const State& state) { return -state.q[0]; };  // positive beyond the vertical
  for (int i = 0; i < 10'000; ++i) {
    const State before = integrator.state();
    const IntegratorHistory history = integrator.history();
    ASSERT_EQ(integrator.advance(step).status, StepStatus::converged);
    const State after = integrator.state();
    if (g(after) <= 0) continue;
    const double near = 1e-9;
    const State landed = land_before(integrator, {before, history, after, after.t - before.t}, g, near);
    EXPECT_LE(g(landed), 0);
    EXPECT_GT(g(landed), -near);
    EXPECT_GT(landed.t, before.t);
    EXPECT_LT(landed.t, after.t);
    // The reference at the landing's own time is at the vertical, too.
    EXPECT_NEAR(pendulum.reference(0.9, landed.t, 4000).q[0], 0, accuracy);
    return;
  }
  FAIL() << "the event never came";
}

TEST(Event, IsLandedJustBeforeByEveryMethod) {
  const CartesianPendulum pendulum;
  const State start = pendulum.at_angle(0, 0.9, 0);
  GeneralizedAlphaIntegrator alpha({.rho_infinity = 0.9}, pendulum, start);
  check_landing(alpha, pendulum, 1e-3, 1e-5);
  IdaIntegrator ida({.tolerance = 1e-9}, pendulum, start);
  check_landing(ida, pendulum, 1e-2, 1e-5);
  ExplicitIntegrator rk4({}, pendulum, start);
  check_landing(rk4, pendulum, 1e-3, 1e-8);
  RadauIntegrator radau({}, pendulum, start);
  check_landing(radau, pendulum, 3e-2, 1e-7);
}

TEST(Integrator, RestoredGoesOnAsIfItHadNotStopped) {
  const CartesianPendulum pendulum;
  const State start = pendulum.at_angle(0, 0.9, 0);
  GeneralizedAlphaIntegrator whole({.tolerance = 1e-6}, pendulum, start),
      other({.tolerance = 1e-6}, pendulum, start);
  double step = 1e-3;
  for (int i = 0; i < 20; ++i) step = whole.advance(step).next_step;
  other.restore(whole.state(), whole.history());
  for (int i = 0; i < 20; ++i) {
    const StepReport a = whole.advance(step), b = other.advance(step);
    EXPECT_EQ(a.next_step, b.next_step);
    step = a.next_step;
  }
  EXPECT_EQ(whole.state().q, other.state().q);
  EXPECT_EQ(whole.state().v, other.state().v);
}

// Its state after some steps, of which each gives the state before it away.
void check_state_before(Integrator& asked, Integrator& other) {
  for (int i = 0; i < 5; ++i) {
    const State before = asked.state();
    ASSERT_EQ(asked.advance(1e-3).status, StepStatus::converged);
    ASSERT_EQ(other.advance(1e-3).status, StepStatus::converged);
    const State given = asked.take_before();
    EXPECT_EQ(given.t, before.t);
    EXPECT_EQ(given.q, before.q);
    EXPECT_EQ(given.v, before.v);
    EXPECT_EQ(given.a, before.a);
    EXPECT_EQ(given.lambda, before.lambda);
  }
  EXPECT_EQ(asked.state().q, other.state().q);
  EXPECT_EQ(asked.state().v, other.state().v);
}

TEST(Integrator, GivesAwayTheStateBeforeAStep) {
  const CartesianPendulum pendulum;
  const State start = pendulum.at_angle(0, 0.9, 0);
  GeneralizedAlphaIntegrator alpha({}, pendulum, start), other_alpha({}, pendulum, start);
  check_state_before(alpha, other_alpha);
  IdaIntegrator ida({.tolerance = 1e-9}, pendulum, start), other_ida({.tolerance = 1e-9}, pendulum, start);
  check_state_before(ida, other_ida);
  ExplicitIntegrator rk4({}, pendulum, start), other_rk4({}, pendulum, start);
  check_state_before(rk4, other_rk4);
  RadauIntegrator radau({}, pendulum, start), other_radau({}, pendulum, start);
  check_state_before(radau, other_radau);
}

TEST(Integrator, GoesOnAfterARestAsIfThereHadBeenNone) {
  const CartesianPendulum pendulum;
  const State start = pendulum.at_angle(0, 0.9, 0);
  GeneralizedAlphaIntegrator whole({}, pendulum, start), rested({}, pendulum, start);
  for (int i = 0; i < 20; ++i) {
    if (i % 4 == 0) rested.rest();
    ASSERT_EQ(whole.advance(1e-2).newton_iterations, rested.advance(1e-2).newton_iterations);
  }
  EXPECT_EQ(whole.state().q, rested.state().q);
  EXPECT_EQ(whole.state().v, rested.state().v);
  EXPECT_EQ(whole.state().lambda, rested.state().lambda);
}

TEST(Integrator, RefusesTheHistoryOfAnother) {
  const CartesianPendulum pendulum;
  GeneralizedAlphaIntegrator integrator({}, pendulum, pendulum.at_angle(0, 0.9, 0));
  EXPECT_THROW(integrator.restore(integrator.state(), {}), std::invalid_argument);
  IntegratorHistory wrong = integrator.history();
  wrong.vectors[1].resize(7);
  EXPECT_THROW(integrator.restore(integrator.state(), wrong), std::invalid_argument);
}

TEST(Arguments, KeepTheirDigitsInMessages) {
  const CartesianPendulum pendulum;
  try {
    GeneralizedAlphaIntegrator({.tolerance = -1e-10}, pendulum, pendulum.at_angle(0, 0.9, 0));
    FAIL();
  } catch (const std::invalid_argument& refusal) {
    EXPECT_NE(std::string(refusal.what()).find("-1e-10"), std::string::npos) << refusal.what();
  }
}

}  // namespace
}  // namespace nurbeam
