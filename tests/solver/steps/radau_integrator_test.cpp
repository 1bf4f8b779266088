#include "solver/steps/radau_integrator.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "solver/steps/radau_method.h"
#include "solver/steps/stage_equations.h"
#include "tests/support/small_systems.h"

namespace nurbeam {
namespace {

using testing::CartesianPendulum;
using testing::DrivenSlider;
using testing::KeplerOrbit;
using testing::Oscillator;

constexpr int stages = RadauMethod::stages;

TEST(RadauMethod, HasTheCoefficientsOfTheBook) {
  // Hairer & Wanner, Solving ODEs II, Table IV.5.6.
  const double r = std::sqrt(6.0);
  Eigen::Matrix3d a;
  a << (88 - 7 * r) / 360, (296 - 169 * r) / 1800, (-2 + 3 * r) / 225,  //
      (296 + 169 * r) / 1800, (88 + 7 * r) / 360, (-2 - 3 * r) / 225,   //
      (16 - r) / 36, (16 + r) / 36, 1.0 / 9;
  EXPECT_LT((radau_method().a - a).cwiseAbs().maxCoeff(), 1e-14);
  // IV.8.15: of the inverse, 3 + 3^(2/3) - 3^(1/3).
  EXPECT_NEAR(1 / radau_method().gamma, 3 + std::cbrt(9.0) - std::cbrt(3.0), 1e-13);
}

TEST(RadauMethod, IsDiagonalised) {
  const RadauMethod& method = radau_method();
  const Eigen::Matrix3cd part = method.to_c * method.gamma_c * method.from_c;
  const Eigen::Matrix3d whole = method.gamma * method.to * method.from + 2 * part.real();
  EXPECT_LT((whole - method.a).cwiseAbs().maxCoeff(), 1e-14);
  EXPECT_GT(method.gamma_c.imag(), 0.1);
}

TEST(RadauMethod, ItsOtherFormulaIntegratesQuadraticsAndNoCubics) {
  const RadauMethod& method = radau_method();
  const Eigen::RowVector3d weights = method.a.row(2) + method.error;
  EXPECT_NEAR(method.gamma + weights.sum(), 1, 1e-14);
  EXPECT_NEAR(weights * method.c, 1.0 / 2, 1e-14);
  EXPECT_NEAR(weights * method.c.cwiseAbs2(), 1.0 / 3, 1e-14);
  EXPECT_GT(std::abs(weights * method.c.cwiseProduct(method.c.cwiseAbs2()) - 1.0 / 4), 1e-2);
}

TEST(RadauMethod, PolynomialsThroughItsStagesAreReadAnywhere) {
  const RadauMethod& method = radau_method();
  const auto parabola = [](double x) { return 3 - 2 * x + 0.7 * x * x; };
  const Eigen::Vector3d at_stages = method.c.unaryExpr(parabola);
  for (const double x : {-0.5, 0.0, 0.3, 1.0, 2.5})
    EXPECT_NEAR(method.weights(x) * at_stages, parabola(x), 1e-12) << x;
}

/// The pendulum with a drag, that all three tangents differ.
struct DraggedPendulum : CartesianPendulum {
  double drag = 0.7;
  void residual(const State& state, Eigen::Ref<Eigen::VectorXd> dynamics,
                Eigen::Ref<Eigen::VectorXd> constraints) const override {
    CartesianPendulum::residual(state, dynamics, constraints);
    dynamics += drag * state.v;
  }

 protected:
  Eigen::MatrixXd damping(const State&) const override { return drag * Eigen::Matrix2d::Identity(); }
};

TEST(StageEquations, AnswerAsTheEquationsOfAllStagesTogetherDo) {
  const DraggedPendulum pendulum;
  const State place = pendulum.at_angle(0, 1.2, 0.5);
  const double h = 0.07;
  StageEquations equations(pendulum, place);
  ASSERT_TRUE(equations.linearise(place, h, 1e-10));
  StageEquations::Residuals residuals;
  for (int i = 0; i < stages; ++i) residuals[i] = Eigen::Vector3d(1 + i, 0.3 - i, 0.01 * (i - 1.5));

  // In accelerations and multipliers, stage by stage, by a dense matrix.
  const RadauMethod& method = radau_method();
  const double m = pendulum.point_mass, lambda = place.lambda[0];
  Eigen::Matrix<double, 9, 9> matrix = Eigen::Matrix<double, 9, 9>::Zero();
  Eigen::Matrix<double, 9, 1> right;
  for (int i = 0; i < stages; ++i) {
    right.segment<3>(3 * i) = -residuals[i];
    for (int j = 0; j < stages; ++j) {
      const double of_v = h * method.a(i, j), of_q = h * h * method.a_squared(i, j);
      matrix.block<2, 2>(3 * i, 3 * j) =
          ((i == j ? m : 0) + of_v * pendulum.drag + of_q * lambda) * Eigen::Matrix2d::Identity();
      if (i == j) matrix.block<2, 1>(3 * i, 3 * j + 2) = place.q;
      matrix.block<1, 2>(3 * i + 2, 3 * j) = of_q * place.q.transpose();
    }
  }
  const Eigen::Matrix<double, 9, 1> expected = matrix.partialPivLu().solve(right);

  ASSERT_TRUE(std::isfinite(equations.scale(residuals)));
  std::array<StageCorrection, stages> corrections;
  const double largest = equations.solve(residuals, corrections);
  double of_q = 0;
  for (int i = 0; i < stages; ++i) {
    EXPECT_LT((corrections[i].a - expected.segment<2>(3 * i)).norm(), 1e-12 * expected.norm()) << i;
    EXPECT_NEAR(corrections[i].lambda[0], expected[3 * i + 2], 1e-12 * expected.norm()) << i;
    Eigen::Vector2d v = Eigen::Vector2d::Zero(), q = v;
    for (int j = 0; j < stages; ++j) {
      v += h * method.a(i, j) * expected.segment<2>(3 * j);
      q += h * h * method.a_squared(i, j) * expected.segment<2>(3 * j);
    }
    EXPECT_LT((corrections[i].v - v).norm(), 1e-11 * v.norm()) << i;
    EXPECT_LT((corrections[i].q - q).norm(), 1e-11 * q.norm()) << i;
    of_q = std::max(of_q, q.lpNorm<Eigen::Infinity>());
  }
  EXPECT_NEAR(largest, of_q / pendulum.length, 1e-12 * of_q);
}

TEST(StageEquations, FilterErrorsByTheEquationsOfFirstOrder) {
  const DraggedPendulum pendulum;
  const State place = pendulum.at_angle(0, 1.2, 0.5);
  const double h = 0.07, g = radau_method().gamma * h;
  StageEquations equations(pendulum, place);
  ASSERT_TRUE(equations.linearise(place, h, 1e-10));
  const Eigen::Vector2d of_q(3e-3, -1e-3);
  // x - g y = of_q;  m y + g (drag y + lambda x + q nu) = 0;  q.x = 0.
  Eigen::Matrix<double, 5, 5> matrix = Eigen::Matrix<double, 5, 5>::Zero();
  const Eigen::Matrix2d one = Eigen::Matrix2d::Identity();
  matrix.block<2, 2>(0, 0) = one;
  matrix.block<2, 2>(0, 2) = -g * one;
  matrix.block<2, 2>(2, 0) = g * place.lambda[0] * one;
  matrix.block<2, 2>(2, 2) = (pendulum.point_mass + g * pendulum.drag) * one;
  matrix.block<2, 1>(2, 4) = place.q;
  matrix.block<1, 2>(4, 0) = place.q.transpose();
  Eigen::Matrix<double, 5, 1> right;
  right << of_q, 0, 0, 0;
  const Eigen::Matrix<double, 5, 1> x = matrix.partialPivLu().solve(right);
  EXPECT_NEAR(equations.filtered(of_q), x.head(2).lpNorm<Eigen::Infinity>() / pendulum.length, 1e-14);
}

/// How errors of q, v and lambda go with the step, from one number of steps to twice as many.
template <class ErrorOf>
std::array<double, 3> orders(int steps, const ErrorOf& error_of) {
  const std::array<double, 3> coarse = error_of(steps), fine = error_of(2 * steps);
  std::array<double, 3> found{};
  for (std::size_t i = 0; i < found.size(); ++i) found[i] = std::log2(coarse[i] / fine[i]);
  return found;
}

template <class System>
State advanced(const System& system, const State& start, double time, int steps) {
  RadauIntegrator integrator({}, system, start);
  for (int i = 0; i < steps; ++i) {
    const StepReport report = integrator.advance(time / steps);
    EXPECT_EQ(report.status, StepStatus::converged);
    EXPECT_EQ(report.rejected, 0);
  }
  return integrator.state();
}

std::array<double, 3> errors(const State& state, const State& exact) {
  return {(state.q - exact.q).norm(), (state.v - exact.v).norm(), (state.lambda - exact.lambda).norm()};
}

TEST(Radau, IsOfOrderFiveInAPendulumsPositionAndOfItsStagesElsewhere) {
  const CartesianPendulum pendulum;
  const State exact = pendulum.reference(1.2, 2.0, 20000);
  const auto error = [&](int steps) {
    return errors(advanced(pendulum, pendulum.at_angle(0, 1.2, 0), 2.0, steps), exact);
  };
  const auto [q, v, lambda] = orders(40, error);
  EXPECT_GT(q, 4.7);
  EXPECT_GT(v, 2.7);
  EXPECT_GT(lambda, 1.7);
  EXPECT_LT(error(40)[0], 1e-6);
}

TEST(Radau, IsOfItsOrdersWhereAConstraintMoves) {
  const DrivenSlider slider;
  const auto error = [&](int steps) {
    return errors(advanced(slider, slider.exact(0.3), 2.0, steps), slider.exact(2.3));
  };
  const auto [q, v, lambda] = orders(20, error);
  EXPECT_GT(q, 4.7);
  EXPECT_GT(v, 2.7);
  EXPECT_GT(lambda, 1.7);
}

TEST(Radau, ClosesAnOrbitWithAMassThatDependsOnPosition) {
  const KeplerOrbit orbit;
  const State start = orbit.at_nearest_point();
  const auto error = [&](int steps) {
    const State end = advanced(orbit, start, 2 * M_PI, steps);
    return std::hypot(end.q[0] - start.q[0], std::remainder(end.q[1], 2 * M_PI));
  };
  EXPECT_NEAR(std::log2(error(60) / error(120)), 5, 0.4);
}

TEST(Radau, IsExactWhereForcesGoWithTheSquareOfTime) {
  struct Pushed : testing::DenseSystem {
    int coordinate_count() const override { return 1; }
    int constraint_count() const override { return 0; }
    void residual(const State& state, Eigen::Ref<Eigen::VectorXd> dynamics,
                  Eigen::Ref<Eigen::VectorXd>) const override {
      dynamics[0] = 2 * state.a[0] - 12 * state.t * state.t;
    }

   protected:
    Eigen::MatrixXd mass(const State&) const override { return Eigen::MatrixXd::Constant(1, 1, 2); }
    Eigen::MatrixXd stiffness(const State&) const override { return Eigen::MatrixXd::Zero(1, 1); }
  };
  State start;
  start.q = start.v = start.a = Eigen::VectorXd::Zero(1);
  start.lambda = Eigen::VectorXd(0);
  const State end = advanced(Pushed(), start, 1.5, 1);
  EXPECT_NEAR(end.q[0], std::pow(1.5, 4) / 2, 1e-13);
  EXPECT_NEAR(end.v[0], 2 * std::pow(1.5, 3), 1e-13);
}

TEST(Radau, WhatIsMuchQuickerThanTheStepDiesOutInIt) {
  Oscillator oscillator;
  oscillator.omega = 1e4;
  State start;
  start.q = Eigen::VectorXd::Constant(1, 1e-3);
  start.v = Eigen::VectorXd::Zero(1);
  start.a = -1e8 * start.q;
  start.lambda = Eigen::VectorXd(0);
  const State end = advanced(oscillator, start, 0.1, 1);
  // R(z) is 3 / z for large z.
  EXPECT_LT(std::abs(end.q[0]), 4e-3 * start.q[0]);
}

TEST(Radau, UnderErrorControlComesNearerWithItsTolerance) {
  const CartesianPendulum pendulum;
  const double time = 2.0;
  const State exact = pendulum.reference(1.2, time, 20000);
  double last_error = std::numeric_limits<double>::infinity();
  int last_steps = 0;
  for (const double tolerance : {1e-4, 1e-6, 1e-8}) {
    RadauIntegrator integrator({.tolerance = tolerance}, pendulum, pendulum.at_angle(0, 1.2, 0));
    double step = 1e-3;
    int steps = 0;
    while (integrator.state().t < time) {
      const StepReport report = integrator.advance(std::min(step, time - integrator.state().t));
      ASSERT_EQ(report.status, StepStatus::converged);
      EXPECT_LE(report.local_error, tolerance);
      step = report.next_step;
      ++steps;
    }
    const double error = (integrator.state().q - exact.q).norm();
    EXPECT_LT(error, tolerance);
    EXPECT_LT(error, last_error / 10);
    // Of a local error of fourth degree: 100^(1/4) = 3.2.
    if (last_steps > 0) EXPECT_NEAR(static_cast<double>(steps) / last_steps, 3.2, 0.8);
    last_error = error;
    last_steps = steps;
  }
}

TEST(Radau, AStepTooLongForNewtonIsHalved) {
  const CartesianPendulum pendulum;
  RadauIntegrator integrator({.max_iterations = 3}, pendulum, pendulum.at_angle(0, 1.2, 0));
  const StepReport report = integrator.advance(1.0);
  ASSERT_EQ(report.status, StepStatus::converged);
  EXPECT_GT(report.rejected, 0);
  EXPECT_DOUBLE_EQ(report.step, std::ldexp(1.0, -report.rejected));
  EXPECT_DOUBLE_EQ(integrator.state().t, report.step);
}

TEST(Radau, AnErrorAboveTheToleranceIsAStatusOfItsOwn) {
  const CartesianPendulum pendulum;
  const State start = pendulum.at_angle(0, 1.2, 0);
  RadauIntegrator integrator({.max_halvings = 0, .tolerance = 1e-12}, pendulum, start);
  const StepReport report = integrator.advance(0.1);
  EXPECT_EQ(report.status, StepStatus::inaccurate);
  EXPECT_GT(report.local_error, 1e-12);
  EXPECT_EQ(report.rejected, 1);
  EXPECT_EQ(integrator.state().q, start.q);
}

TEST(Radau, ASystemsLimitBoundsTheStep) {
  CartesianPendulum pendulum;
  pendulum.longest_step = 0.003;
  RadauIntegrator integrator({}, pendulum, pendulum.at_angle(0, 1.2, 0));
  EXPECT_DOUBLE_EQ(integrator.advance(0.01).step, 0.0045);
  for (const double nonsense : {0.0, -1.0, std::numeric_limits<double>::quiet_NaN()}) {
    pendulum.longest_step = nonsense;
    EXPECT_EQ(integrator.advance(0.01).status, StepStatus::inadmissible);
  }
}

TEST(Radau, GoesUpToAnInadmissiblePlaceAndNotBeyond) {
  CartesianPendulum pendulum;
  pendulum.wall = 0;
  RadauIntegrator integrator({}, pendulum, pendulum.at_angle(0, -0.5, 0));
  StepReport report;
  do {
    report = integrator.advance(0.01);
    EXPECT_LT(integrator.state().q[0], 0);
    ASSERT_LT(integrator.state().t, 1);
  } while (report.status == StepStatus::converged);
  EXPECT_EQ(report.status, StepStatus::inadmissible);
  EXPECT_GT(integrator.state().q[0], -1e-4);
}

TEST(Radau, AForceThatIsNoNumberIsAStatusAndLeavesTheStateAlone) {
  CartesianPendulum pendulum;
  pendulum.failure_time = 1e-9;
  const State start = pendulum.at_angle(0, 1.2, 0);
  RadauIntegrator integrator({}, pendulum, start);
  const StepReport report = integrator.advance(0.01);
  EXPECT_EQ(report.status, StepStatus::not_converged);
  EXPECT_EQ(report.step, 0);
  EXPECT_EQ(integrator.state().t, 0);
  EXPECT_EQ(integrator.state().q, start.q);
}

TEST(Radau, ASingularMatrixIsAStatus) {
  struct Massless : testing::DenseSystem {
    int coordinate_count() const override { return 1; }
    int constraint_count() const override { return 0; }
    void residual(const State&, Eigen::Ref<Eigen::VectorXd> dynamics,
                  Eigen::Ref<Eigen::VectorXd>) const override {
      dynamics[0] = -1;
    }

   protected:
    Eigen::MatrixXd mass(const State&) const override { return Eigen::MatrixXd::Zero(1, 1); }
    Eigen::MatrixXd stiffness(const State&) const override { return Eigen::MatrixXd::Zero(1, 1); }
  };
  const Massless massless;
  State start;
  start.q = start.v = start.a = Eigen::VectorXd::Zero(1);
  start.lambda = Eigen::VectorXd(0);
  RadauIntegrator integrator({}, massless, start);
  EXPECT_EQ(integrator.advance(0.01).status, StepStatus::singular_matrix);
}

TEST(Radau, AStepThatIsNoNumberOrMovesNoTimeIsAStatus) {
  const CartesianPendulum pendulum;
  RadauIntegrator integrator({}, pendulum, pendulum.at_angle(1, 1.2, 0));
  for (const double step :
       {0.0, -1.0, 1e-17, std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()})
    EXPECT_EQ(integrator.advance(step).status, StepStatus::inadmissible) << step;
}

TEST(Radau, ContinuesFromARestartPointAsIfItHadNotStopped) {
  const DraggedPendulum pendulum;
  RadauIntegrator whole({}, pendulum, pendulum.at_angle(0, 1.2, 0));
  for (int i = 0; i < 5; ++i) ASSERT_EQ(whole.advance(0.05).status, StepStatus::converged);
  RadauIntegrator restarted({}, pendulum, whole.state());
  restarted.restore(whole.state(), whole.history());
  for (int i = 0; i < 5; ++i) {
    ASSERT_EQ(whole.advance(0.05).status, StepStatus::converged);
    ASSERT_EQ(restarted.advance(0.05).status, StepStatus::converged);
  }
  EXPECT_EQ(restarted.state().q, whole.state().q);
  EXPECT_EQ(restarted.state().lambda, whole.state().lambda);
  EXPECT_THROW(restarted.restore(whole.state(), {}), std::invalid_argument);
  IntegratorHistory shortened = whole.history();
  shortened.vectors.back().resize(0);
  EXPECT_THROW(restarted.restore(whole.state(), shortened), std::invalid_argument);
}

TEST(Radau, AStepThatIsRepeatedTakesItsOwnStagesForAGuess) {
  const DraggedPendulum pendulum;
  RadauIntegrator integrator({}, pendulum, pendulum.at_angle(0, 1.2, 0));
  const State before = integrator.state();
  const IntegratorHistory history = integrator.history();
  const int first = integrator.advance(0.05).newton_iterations;
  const State after = integrator.state();
  const StepReport again = integrator.repeat(before, history, 0.05);
  ASSERT_EQ(again.status, StepStatus::converged);
  EXPECT_LT(again.newton_iterations, first);
  EXPECT_LT((integrator.state().q - after.q).norm(), 1e-10);
  EXPECT_EQ(integrator.repeat(before, history, 0.02).step, 0.02);
}

TEST(Radau, RefusesSettingsOutOfRangeAndStartsOfTheWrongSize) {
  const CartesianPendulum pendulum;
  const State start = pendulum.at_angle(0, 1.2, 0);
  const auto make = [&](Radau settings) { RadauIntegrator(settings, pendulum, start); };
  EXPECT_THROW(make({.newton_tolerance = 0}), std::invalid_argument);
  EXPECT_THROW(make({.max_iterations = 0}), std::invalid_argument);
  EXPECT_THROW(make({.max_halvings = -1}), std::invalid_argument);
  EXPECT_THROW(make({.tolerance = std::numeric_limits<double>::quiet_NaN()}), std::invalid_argument);
  EXPECT_THROW(RadauIntegrator({}, pendulum, State{}), std::invalid_argument);
}

}  // namespace
}  // namespace nurbeam
