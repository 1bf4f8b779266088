#include "solver/tangents/step_adjoint.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/small_systems.h"

namespace nurbeam {
namespace {

/// A pendulum whose damping and stiffness are not symmetric, driven with time.
class UnevenPendulum : public testing::CartesianPendulum {
 public:
  void residual(const State& state, Eigen::Ref<Eigen::VectorXd> dynamics,
                Eigen::Ref<Eigen::VectorXd> constraints) const override {
    CartesianPendulum::residual(state, dynamics, constraints);
    dynamics += damper() * state.v + spring() * state.q;
    dynamics[0] -= std::sin(9 * state.t);
  }

 protected:
  Eigen::MatrixXd damping(const State&) const override { return damper(); }
  Eigen::MatrixXd stiffness(const State& state) const override {
    return CartesianPendulum::stiffness(state) + Eigen::MatrixXd(spring());
  }

 private:
  static Eigen::Matrix2d damper() { return (Eigen::Matrix2d() << 0.4, 0.9, -0.3, 0.2).finished(); }
  static Eigen::Matrix2d spring() { return (Eigen::Matrix2d() << 1.3, -2.1, 0.6, 0.8).finished(); }
};

using Rows = MotionTangents::Matrix;

/// Numbers without a pattern.
Rows some(Eigen::Index rows, Eigen::Index columns, double seed) {
  return Rows::NullaryExpr(
      rows, columns,
      [seed](Eigen::Index i, Eigen::Index j) {
        return std::sin(seed + 1.7 * static_cast<double>(i) + 2.9 * static_cast<double>(j * j));
      });
}

MotionTangents some_tangents(Eigen::Index columns, double seed) {
  return {.t = some(1, columns, seed),
          .last_step = some(1, columns, seed + 0.1),
          .q = some(2, columns, seed + 0.2),
          .v = some(2, columns, seed + 0.3),
          .a = some(2, columns, seed + 0.4),
          .lambda = some(1, columns, seed + 0.5),
          .algorithmic_acceleration = some(2, columns, seed + 0.6),
          .jerk = some(2, columns, seed + 0.7)};
}

/// (quantities x parameters)
Eigen::MatrixXd product(const MotionTangents& adjoints, const MotionTangents& tangents) {
  return adjoints.t.transpose() * tangents.t + adjoints.last_step.transpose() * tangents.last_step +
         adjoints.q.transpose() * tangents.q + adjoints.v.transpose() * tangents.v +
         adjoints.a.transpose() * tangents.a + adjoints.lambda.transpose() * tangents.lambda +
         adjoints.algorithmic_acceleration.transpose() * tangents.algorithmic_acceleration +
         adjoints.jerk.transpose() * tangents.jerk;
}

// What quantities do at the end of a step is the same through tangents to there as through adjoints from
// there, whatever both are: of steps like the one before, longer, shorter, five times as long, repeated.
class StepAdjointOf : public ::testing::TestWithParam<int> {};

TEST_P(StepAdjointOf, IsTheTransposeOfTheTangent) {
  const UnevenPendulum pendulum;
  constexpr GeneralizedAlpha exact{.newton_tolerance = 1e-14, .settles = false};
  const int quantities = GetParam();
  constexpr int parameters = 5;
  GeneralizedAlphaIntegrator integrator(exact, pendulum, pendulum.at_angle(0, 0.7, 0.5));
  StepTangent tangent(exact, pendulum);
  StepAdjoint adjoint(exact, pendulum);
  for (const double length : {0.01, 0.01, 0.013, 0.004, 0.02, 0.01, 0.05}) {
    const State before = integrator.state();
    const IntegratorHistory history = integrator.history();
    const bool repeated = length == 0.02;
    const StepReport taken =
        repeated ? integrator.repeat(before, history, length) : integrator.advance(length);
    ASSERT_EQ(taken.status, StepStatus::converged);
    const State& after = integrator.state();
    tangent.take(before, history, after, repeated);
    ASSERT_TRUE(tangent.factorise());
    adjoint.take(before, history, after, repeated);
    adjoint.go_on();
    State other = after;
    other.q *= 1.1;
    adjoint.take(before, history, other, repeated);  // which is not gone on to
    const MotionTangents start = some_tangents(parameters, length), at_end = some_tangents(quantities, 7);
    const Rows residual = some(3, parameters, 5);
    const Eigen::Vector3d later(0.3, -0.8, 0.1);
    const double by_time = -0.37;
    const Eigen::RowVectorXd longer = by_time * start.t;
    const Rows whole = residual + later * (start.t + longer);
    const MotionTangents end = tangent.end(start, longer, whole.topRows(2), whole.bottomRows(1));
    Rows mu;
    ASSERT_TRUE(adjoint.find_multipliers(at_end, mu));
    const Eigen::MatrixXd forward = product(at_end, end);
    const Eigen::MatrixXd back =
        product(adjoint.start(at_end, mu, by_time, later), start) - mu.transpose() * residual;
    // Few are corrected until the next correction is known to be this small.
    const double accuracy = quantities <= 2 ? 1e-7 : 1e-12;
    EXPECT_LT((forward - back).norm(), accuracy * forward.norm()) << length;
    EXPECT_GT(forward.norm(), 1);
  }
}

// One and few by factors of other steps, many by those of each.
INSTANTIATE_TEST_SUITE_P(Quantities, StepAdjointOf, ::testing::Values(1, 2, 3, 4, 7));

// The matrix of a linear system stays while steps are of one length: corrections with its factors leave
// nothing, which says nothing of another length.
TEST(StepAdjoint, ForgetsHowFastCorrectionsShrinkWhereStepsChangeTheirLength) {
  testing::Oscillator oscillator;
  oscillator.omega = 100;
  constexpr GeneralizedAlpha settings{.newton_tolerance = 1e-14};
  State start;
  start.q = start.v = start.a = Eigen::VectorXd::Constant(1, 0.1);
  GeneralizedAlphaIntegrator integrator(settings, oscillator, start);
  StepAdjoint adjoint(settings, oscillator);
  double quantity = 1;
  for (const double length : {0.01, 0.01, 0.01, 0.01, 0.02}) {
    const State before = integrator.state();
    const IntegratorHistory history = integrator.history();
    ASSERT_EQ(integrator.advance(length).status, StepStatus::converged);
    MotionTangents end = MotionTangents::zero(1, 0, 1);
    end.q(0, 0) = quantity *= -1.7;
    const auto multipliers_of = [&](StepAdjoint& of) {
      of.take(before, history, integrator.state(), false);
      of.go_on();
      Rows mu;
      EXPECT_TRUE(of.find_multipliers(end, mu));
      return mu(0, 0);
    };
    StepAdjoint afresh(settings, oscillator);
    const double expected = multipliers_of(afresh);
    EXPECT_NEAR(multipliers_of(adjoint), expected, 1e-7 * std::abs(expected)) << length;
  }
}

}  // namespace
}  // namespace nurbeam
