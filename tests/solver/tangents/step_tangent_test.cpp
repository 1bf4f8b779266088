#include "solver/tangents/step_tangent.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "tests/support/small_systems.h"

namespace nurbeam {
namespace {

using testing::CartesianPendulum;

/// A pendulum whose length, weight, start and steps depend on one parameter.
CartesianPendulum pendulum_of(double p) {
  CartesianPendulum pendulum;
  pendulum.length = 1.5 + p;
  pendulum.gravity = 9.81 - 3 * p;
  return pendulum;
}
State pendulum_start(double p) { return pendulum_of(p).at_angle(0.1 * p, 0.7 - 0.2 * p, 0.5 + p); }
double length_of_step(std::size_t i, double p) {
  constexpr double parts[] = {1, 1, 1.3, 0.4, 5, 1, 0.9};  // 5 after 0.4: afresh
  return 0.01 * parts[i % std::size(parts)] * (1 + (i % 3 == 1 ? p : 0));
}
constexpr std::size_t pendulum_steps = 30;
constexpr GeneralizedAlpha exact_steps{.newton_tolerance = 1e-14, .settles = false};

State pendulum_end(double p) {
  const CartesianPendulum pendulum = pendulum_of(p);
  GeneralizedAlphaIntegrator integrator(exact_steps, pendulum, pendulum_start(p));
  for (std::size_t i = 0; i < pendulum_steps; ++i)
    EXPECT_EQ(integrator.advance(length_of_step(i, p)).status, StepStatus::converged);
  return integrator.state();
}

State rate_between(const State& more, const State& less, double step) {
  const double per = 1 / (2 * step);
  return {.t = per * (more.t - less.t),
          .q = per * (more.q - less.q),
          .v = per * (more.v - less.v),
          .a = per * (more.a - less.a),
          .lambda = per * (more.lambda - less.lambda)};
}

double error_of(const State& x, const State& y) {
  return std::abs(x.t - y.t) + (x.q - y.q).norm() + (x.v - y.v).norm() + (x.a - y.a).norm() +
         (x.lambda - y.lambda).norm();
}

TEST(StepTangent, IsWhatDifferencesTendToWithTheSquareOfTheirStep) {
  const CartesianPendulum pendulum = pendulum_of(0), more = pendulum_of(1e-6), less = pendulum_of(-1e-6);
  GeneralizedAlphaIntegrator integrator(exact_steps, pendulum, pendulum_start(0));
  // By p, 2 p, 4 p ...: as many as are taken side by side, and others beside them.
  constexpr int count = 13;
  const Eigen::RowVectorXd parts = Eigen::RowVectorXd::NullaryExpr(
      count, [](Eigen::Index k) { return std::ldexp(1, -static_cast<int>(k)); });
  MotionTangents tangents = MotionTangents::zero(2, 1, count);
  const State at_start = rate_between(pendulum_start(1e-5), pendulum_start(-1e-5), 1e-5);
  for (int k = 0; k < count; ++k) {
    tangents.move(k, at_start, parts[k]);
    tangents.start_afresh(k, tangents.of(k));
  }
  StepTangent step(exact_steps, pendulum);
  for (std::size_t i = 0; i < pendulum_steps; ++i) {
    const State before = integrator.state();
    const IntegratorHistory history = integrator.history();
    ASSERT_EQ(integrator.advance(length_of_step(i, 0)).status, StepStatus::converged);
    step.take(before, history, integrator.state(), false);
    ASSERT_TRUE(step.factorise());
    Eigen::VectorXd above(2), below(2), constraint_above(1), constraint_below(1);
    more.residual(integrator.state(), above, constraint_above);
    less.residual(integrator.state(), below, constraint_below);
    const double longer = (length_of_step(i, 1e-3) - length_of_step(i, -1e-3)) / 2e-3;
    tangents = step.end(tangents, longer * parts, (above - below) / 2e-6 * parts,
                        (constraint_above - constraint_below) / 2e-6 * parts);
  }
  const State tangent = tangents.of(0);
  const State zero = MotionTangents::zero(2, 1, 1).of(0);
  const double size = error_of(tangent, zero);
  for (int k = 1; k < count; ++k) {
    State whole = zero;
    const State part = tangents.of(k);
    whole.t = part.t / parts[k];
    whole.q = part.q / parts[k];
    whole.v = part.v / parts[k];
    whole.a = part.a / parts[k];
    whole.lambda = part.lambda / parts[k];
    EXPECT_LT(error_of(whole, tangent), 1e-12 * size) << k;
  }
  const auto error = [&](double p) {
    return error_of(tangent, rate_between(pendulum_end(p), pendulum_end(-p), p));
  };
  EXPECT_NEAR(error(8e-3) / error(4e-3), 4, 0.2);
  EXPECT_LT(error(1e-4), 1e-6 * size);
}

}  // namespace
}  // namespace nurbeam
