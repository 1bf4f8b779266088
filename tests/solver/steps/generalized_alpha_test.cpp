#include "solver/steps/generalized_alpha.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <complex>
#include <limits>
#include <stdexcept>
#include <vector>

#include "solver/system/consistent.h"
#include "tests/support/small_systems.h"

namespace nurbeam {
namespace {

using testing::CartesianPendulum;
using testing::DrivenSlider;
using testing::Oscillator;

struct Errors {
  double q = 0;
  double v = 0;
  double lambda = 0;
};

Errors difference(const State& state, const State& exact) {
  return {(state.q - exact.q).norm(), (state.v - exact.v).norm(), (state.lambda - exact.lambda).norm()};
}

/// Advances to `time` in steps whose lengths repeat the given proportions; the number of rounds is `rounds`.
State advance_in_rounds(GeneralizedAlphaIntegrator& integrator, double time, int rounds,
                        const std::vector<double>& proportions) {
  double sum = 0;
  for (const double p : proportions) sum += p;
  for (int i = 0; i < rounds; ++i)
    for (const double p : proportions) {
      const StepReport report = integrator.advance(time / rounds * p / sum);
      EXPECT_EQ(report.status, StepStatus::converged);
      EXPECT_EQ(report.rejected, 0);
    }
  return integrator.state();
}

/// Asserts second order in q, v and lambda over three refinements.
template <class ErrorOf>
void expect_second_order(int rounds, ErrorOf error_of) {
  std::array<Errors, 4> errors;
  for (std::size_t i = 0; i < errors.size(); ++i) errors[i] = error_of(rounds << i);
  for (std::size_t i = 1; i < errors.size(); ++i) {
    EXPECT_NEAR(std::log2(errors[i - 1].q / errors[i].q), 2, 0.25) << "q " << errors[i].q;
    EXPECT_NEAR(std::log2(errors[i - 1].v / errors[i].v), 2, 0.25) << "v " << errors[i].v;
    EXPECT_NEAR(std::log2(errors[i - 1].lambda / errors[i].lambda), 2, 0.25) << "lambda " << errors[i].lambda;
  }
}

Errors pendulum_error(double rho_infinity, int rounds, const std::vector<double>& proportions) {
  const CartesianPendulum pendulum;
  GeneralizedAlphaIntegrator integrator({.rho_infinity = rho_infinity}, pendulum,
                                        pendulum.at_angle(0, 1.2, 0));
  const double time = 2.0;
  State end = advance_in_rounds(integrator, time, rounds, proportions);
  if (proportions.size() > 1)
    EXPECT_EQ(make_accelerations_consistent(pendulum, end), ConsistencyStatus::done);
  return difference(end, pendulum.reference(1.2, time, 20000));
}

TEST(GeneralizedAlpha, IsOfSecondOrderInAllOfAPendulum) {
  for (const double rho : {0.0, 0.5, 0.8, 0.9})
    expect_second_order(
        400, [rho](int rounds) { return pendulum_error(rho, rounds, {1}); });
}

TEST(GeneralizedAlpha, KeepsItsOrderUnderVaryingSteps) {
  for (const double rho : {0.5, 0.8})
    expect_second_order(
        100,
        [rho](int rounds) {
          return pendulum_error(rho, rounds, {1, 1.7, 2.4, 1.1, 0.6, 0.5, 1.5});
        });
}

TEST(GeneralizedAlpha, IsOfSecondOrderInAMovingConstraint) {
  const DrivenSlider slider;
  expect_second_order(100, [&slider](int rounds) {
    GeneralizedAlphaIntegrator integrator({}, slider, slider.exact(0.3));
    return difference(advance_in_rounds(integrator, 1.7, rounds, {1}), slider.exact(2.0));
  });
}

/// Energy of 1 kg on a free rod of 1 m at 1 m/s, without other forces, which is 0.5 J at the start.
double energy_of_turning_rod(double rho_infinity, double step, double time) {
  CartesianPendulum rod;
  rod.point_mass = rod.length = 1;
  rod.gravity = 0;
  GeneralizedAlphaIntegrator integrator({.rho_infinity = rho_infinity}, rod, rod.at_angle(0, 0, 1));
  for (int i = 0; i < std::lround(time / step); ++i)
    EXPECT_EQ(integrator.advance(step).status, StepStatus::converged);
  return rod.energy(integrator.state());
}

TEST(GeneralizedAlpha, StaysStableWhereAConstraintKeepsTurning) {
  // Bounds: relative losses of an independent program that settles each step. Without settling the energy
  // grows beyond a hundred times in all rows but the first.
  const auto loss = [](double rho_infinity, double step, double time) {
    return 1 - energy_of_turning_rod(rho_infinity, step, time) / 0.5;
  };
  for (const auto& [rho_infinity, step, time, most] : {std::array{0.8, 0.1, 100.0, 3.3e-4},
                                                       {0.8, 0.2, 600.0, 1.01e-2},
                                                       {0.8, 0.3, 200.0, 1.14e-2},
                                                       {0.95, 0.1, 200.0, 1.3e-5},
                                                       {1.0, 0.1, 200.0, 1e-6}}) {
    EXPECT_LT(loss(rho_infinity, step, time), most) << rho_infinity << ' ' << step;
    EXPECT_GT(loss(rho_infinity, step, time), -1e-9) << rho_infinity << ' ' << step;
  }
}

TEST(GeneralizedAlpha, BalancesDampersAtTheVelocitiesThatItSettles) {
  CartesianPendulum rod;
  rod.viscosity = 40;
  GeneralizedAlphaIntegrator integrator({}, rod, rod.at_angle(0, 0, 8));
  State start = rod.at_angle(0, 0, 8);
  ASSERT_EQ(make_accelerations_consistent(rod, start), ConsistencyStatus::done);
  integrator.restore(start, GeneralizedAlphaIntegrator({}, rod, start).history());
  for (int i = 0; i < 30; ++i) {
    ASSERT_EQ(integrator.advance(0.01).status, StepStatus::converged);
    const State& state = integrator.state();
    Eigen::VectorXd forces(2), open(1);
    rod.residual(state, forces, open);
    EXPECT_LT(forces.norm(), 1e-8 * rod.viscosity * state.v.norm() + 1e-8) << i;
    EXPECT_LT(std::abs(open[0]), 1e-10) << i;
  }
}

TEST(GeneralizedAlpha, WithoutDissipationKeepsTheEnergyOfAnOscillator) {
  // rho = 1 is the average-acceleration rule up to where the force is sampled: its linear map is a rotation.
  const Oscillator oscillator;
  const double q0 = 0.3;
  State start{.t = 0,
              .q = Eigen::VectorXd::Constant(1, q0),
              .v = Eigen::VectorXd::Zero(1),
              .a = Eigen::VectorXd::Constant(1, -oscillator.omega * oscillator.omega * q0),
              .lambda = Eigen::VectorXd(0)};
  GeneralizedAlphaIntegrator integrator({.rho_infinity = 1}, oscillator, start);
  double largest = 0;
  double smallest = 1;
  for (int i = 0; i < 20000; ++i) {
    ASSERT_EQ(integrator.advance(0.05).status, StepStatus::converged);
    const double amplitude = std::hypot(integrator.state().q[0], integrator.state().v[0] / oscillator.omega);
    if (i >= 10000) largest = std::max(largest, amplitude);
    if (i < 10000) smallest = std::min(smallest, amplitude);
  }
  EXPECT_NEAR(largest, q0, 0.01 * q0);
  EXPECT_NEAR(smallest, q0, 0.01 * q0);
}

/// The numerical solution of q'' = -omega^2 q obeys a linear recurrence; its principal root is found here
/// from the method's formulas as the eigenvalue of the one-step map of (q, h v, h^2 a, h^2 alg) nearest to
/// exp(i omega h).
std::complex<double> principal_root(double rho, double omega_h) {
  const double am = (2 * rho - 1) / (rho + 1);
  const double af = rho / (rho + 1);
  const double gamma = 0.5 - am + af;
  const double beta = 0.25 * (gamma + 0.5) * (gamma + 0.5);
  Eigen::Matrix4d implicit;
  Eigen::Matrix4d explicit_part;
  implicit << 1, 0, 0, -beta, 0, 1, 0, -gamma, 0, 0, -(1 - af), 1 - am, omega_h * omega_h, 0, 1, 0;
  explicit_part << 1, 1, 0, 0.5 - beta, 0, 1, 0, 1 - gamma, 0, 0, af, -am, 0, 0, 0, 0;
  const Eigen::Vector4cd roots = Eigen::Matrix4d(implicit.inverse() * explicit_part).eigenvalues();
  std::complex<double> nearest = roots[0];
  const std::complex<double> exact = std::polar(1.0, omega_h);
  for (const std::complex<double>& root : roots)
    if (std::abs(root - exact) < std::abs(nearest - exact)) nearest = root;
  return nearest;
}

TEST(GeneralizedAlpha, DampsAndShiftsAnOscillatorAsItsPrincipalRootSays) {
  const Oscillator oscillator;
  const double h = 0.1;
  for (const double rho : {0.5, 0.8}) {
    State start{.t = 0,
                .q = Eigen::VectorXd::Constant(1, 1),
                .v = Eigen::VectorXd::Zero(1),
                .a = Eigen::VectorXd::Constant(1, -4),
                .lambda = Eigen::VectorXd(0)};
    GeneralizedAlphaIntegrator integrator({.rho_infinity = rho}, oscillator, start);
    std::vector<double> q;
    for (int i = 0; i < 200; ++i) {
      ASSERT_EQ(integrator.advance(h).status, StepStatus::converged);
      q.push_back(integrator.state().q[0]);
    }
    const std::complex<double> root = principal_root(rho, oscillator.omega * h);
    for (std::size_t i = 100; i + 2 < q.size(); ++i)
      EXPECT_NEAR(q[i + 2], 2 * root.real() * q[i + 1] - std::norm(root) * q[i], 1e-12);
  }
}

TEST(GeneralizedAlpha, EndsWhereItsConstraintHoldsToRoundOff) {
  const CartesianPendulum pendulum;
  GeneralizedAlphaIntegrator integrator({}, pendulum, pendulum.at_angle(0, 1.2, 0));
  for (int i = 0; i < 500; ++i) {
    ASSERT_EQ(integrator.advance(4e-3).status, StepStatus::converged);
    EXPECT_NEAR(integrator.state().q.norm(), pendulum.length, 1e-14);
  }
}

TEST(GeneralizedAlpha, TakesFewIterationsAndFewerMatrices) {
  struct CountingPendulum : CartesianPendulum {
    mutable int tangents = 0;
    void tangent(const State& state, const TangentWeights& w, SparseValues kkt) const override {
      ++tangents;
      CartesianPendulum::tangent(state, w, kkt);
    }
  };
  const CountingPendulum pendulum;
  GeneralizedAlphaIntegrator integrator({}, pendulum, pendulum.at_angle(0, 1.2, 0));
  int iterations = 0;
  for (int i = 0; i < 500; ++i) iterations += integrator.advance(1e-3).newton_iterations;
  EXPECT_LE(iterations, 4 * 500);
  EXPECT_LE(pendulum.tangents, 500 / 10);
}

TEST(GeneralizedAlpha, ErrorControlMeetsItsToleranceInProportion) {
  const CartesianPendulum pendulum;
  const double time = 2;
  const State exact = pendulum.reference(1.2, time, 20000);
  double last_error = 0;
  for (const double tolerance : {1e-5, 1e-6, 1e-7, 1e-8}) {
    GeneralizedAlphaIntegrator integrator({.tolerance = tolerance}, pendulum, pendulum.at_angle(0, 1.2, 0));
    double step = 1e-3;
    int steps = 0;
    while (integrator.state().t < time * (1 - 1e-12)) {
      const double rest = time - integrator.state().t;
      const StepReport report =
          integrator.advance(rest <= 2 * step && rest > step ? 0.5 * rest : std::min(step, rest));
      ASSERT_EQ(report.status, StepStatus::converged);
      EXPECT_LE(report.local_error, tolerance);
      EXPECT_LE(report.next_step, 2.0001 * report.step);
      step = report.next_step;
      ++steps;
    }
    const double error = difference(integrator.state(), exact).q / pendulum.length;
    EXPECT_LT(error, steps * tolerance);
    // Steps go with the cube root of the local error, the global error with the square of the steps: 10^(2/3)
    // = 4.6.
    if (last_error > 0) EXPECT_NEAR(std::log10(last_error / error), 2.0 / 3, 0.25);
    last_error = error;
  }
}

TEST(GeneralizedAlpha, ItsMatrixStaysWellConditionedAsTheStepVanishes) {
  const CartesianPendulum pendulum;
  for (double step = 1e-2; step > 0.9e-7; step /= 10) {
    GeneralizedAlphaIntegrator integrator({}, pendulum, pendulum.at_angle(0, 1.2, 0.5));
    ASSERT_EQ(integrator.advance(step).status, StepStatus::converged) << step;
    const Eigen::MatrixXd matrix = integrator.iteration_matrix();
    const Eigen::VectorXd singular_values = matrix.jacobiSvd().singularValues();
    EXPECT_LT(singular_values[0] / singular_values[2], 10) << step;
  }
}

TEST(GeneralizedAlpha, AStepTooLongForNewtonIsHalved) {
  const CartesianPendulum pendulum;
  GeneralizedAlphaIntegrator integrator({.max_iterations = 3}, pendulum, pendulum.at_angle(0, 1.2, 0));
  const StepReport report = integrator.advance(1.0);
  ASSERT_EQ(report.status, StepStatus::converged);
  EXPECT_GT(report.rejected, 0);
  EXPECT_DOUBLE_EQ(report.step, std::ldexp(1.0, -report.rejected));
  EXPECT_DOUBLE_EQ(integrator.state().t, report.step);
  EXPECT_DOUBLE_EQ(report.next_step, 1.0);
}

TEST(GeneralizedAlpha, AMatrixFromBeforeThatLeadsAwayIsTakenAnew) {
  // A spring becomes 1e6 times as stiff at once, 25 times what the kept matrix has: of a place 1 mm off the
  // first correction leads to -25 mm, the second to 0.6 m, which is out of bounds.
  struct Spring : testing::DenseSystem {
    static double stiffness_at(double t) { return t < 0.055 ? 1 : 1e6; }
    int coordinate_count() const override { return 1; }
    int constraint_count() const override { return 0; }
    void residual(const State& state, Eigen::Ref<Eigen::VectorXd> dynamics,
                  Eigen::Ref<Eigen::VectorXd>) const override {
      dynamics = state.a + stiffness_at(state.t) * state.q;
    }
    bool admissible(const State& state) const override { return std::abs(state.q[0]) < 0.1; }

   protected:
    Eigen::MatrixXd mass(const State&) const override { return Eigen::MatrixXd::Identity(1, 1); }
    Eigen::MatrixXd stiffness(const State& state) const override {
      return Eigen::MatrixXd::Constant(1, 1, stiffness_at(state.t));
    }
  };
  const Spring spring;
  State start;
  start.q = Eigen::VectorXd::Constant(1, 1e-3);
  start.v = Eigen::VectorXd::Zero(1);
  start.a = -start.q;
  start.lambda = Eigen::VectorXd(0);
  GeneralizedAlphaIntegrator integrator({}, spring, start);
  for (int i = 0; i < 6; ++i) {
    const StepReport report = integrator.advance(1e-2);
    ASSERT_EQ(report.status, StepStatus::converged) << i;
    EXPECT_EQ(report.rejected, 0) << i;
  }
  EXPECT_NEAR(integrator.state().t, 0.06, 1e-12);
}

TEST(GeneralizedAlpha, BalancesForcesHoweverSmallWhatTheyMoveIs) {
  // A tangent that is a quarter too stiff, as where a part of it is left out, makes corrections that shrink
  // by a fifth each: those of a micrometre are soon as small as the tolerance while the forces are far from
  // balanced.
  struct Spring : testing::DenseSystem {
    static double true_stiffness() { return 1e6; }
    int coordinate_count() const override { return 1; }
    int constraint_count() const override { return 0; }
    void residual(const State& state, Eigen::Ref<Eigen::VectorXd> dynamics,
                  Eigen::Ref<Eigen::VectorXd>) const override {
      dynamics = state.a + true_stiffness() * state.q;
    }

   protected:
    Eigen::MatrixXd mass(const State&) const override { return Eigen::MatrixXd::Identity(1, 1); }
    Eigen::MatrixXd stiffness(const State&) const override {
      return Eigen::MatrixXd::Constant(1, 1, 1.25 * true_stiffness());
    }
  };
  const Spring spring;
  State start;
  start.q = Eigen::VectorXd::Constant(1, 1e-6);
  start.v = Eigen::VectorXd::Zero(1);
  start.a = -Spring::true_stiffness() * start.q;
  start.lambda = Eigen::VectorXd(0);
  GeneralizedAlphaIntegrator integrator({.max_iterations = 50}, spring, start);
  for (int i = 0; i < 5; ++i) {
    ASSERT_EQ(integrator.advance(3e-3).status, StepStatus::converged) << i;
    const State& state = integrator.state();
    EXPECT_NEAR(state.a[0] + Spring::true_stiffness() * state.q[0], 0,
                1e-9 * std::max(std::abs(state.a[0]), Spring::true_stiffness() * 1e-6))
        << i;
  }
}

TEST(GeneralizedAlpha, AnErrorAboveTheToleranceIsAStatusOfItsOwn) {
  const CartesianPendulum pendulum;
  const State start = pendulum.at_angle(0, 1.2, 0);
  GeneralizedAlphaIntegrator integrator({.max_halvings = 0, .tolerance = 1e-12}, pendulum, start);
  const StepReport report = integrator.advance(0.1);
  EXPECT_EQ(report.status, StepStatus::inaccurate);
  EXPECT_GT(report.local_error, 1e-12);
  EXPECT_EQ(report.rejected, 1);
  EXPECT_EQ(integrator.state().q, start.q);
}

TEST(GeneralizedAlpha, TheSystemsLimitBoundsTheStep) {
  CartesianPendulum pendulum;
  pendulum.longest_step = 0.003;
  GeneralizedAlphaIntegrator integrator({}, pendulum, pendulum.at_angle(0, 1.2, 0));
  EXPECT_DOUBLE_EQ(integrator.advance(0.01).step, 0.003);
  for (const double nonsense : {0.0, -1.0, std::numeric_limits<double>::quiet_NaN()}) {
    pendulum.longest_step = nonsense;
    EXPECT_EQ(integrator.advance(0.01).status, StepStatus::inadmissible);
  }
}

TEST(GeneralizedAlpha, GoesUpToAnInadmissiblePlaceAndNotBeyond) {
  CartesianPendulum pendulum;
  pendulum.wall = 0;
  GeneralizedAlphaIntegrator integrator({}, pendulum, pendulum.at_angle(0, -0.5, 0));
  StepReport report;
  do {
    report = integrator.advance(0.01);
    EXPECT_LT(integrator.state().q[0], 0);
    ASSERT_LT(integrator.state().t, 1);
  } while (report.status == StepStatus::converged);
  EXPECT_EQ(report.status, StepStatus::inadmissible);
  EXPECT_EQ(report.rejected, GeneralizedAlpha{}.max_halvings + 1);
  EXPECT_GT(integrator.state().q[0], -1e-4);
}

TEST(GeneralizedAlpha, AForceThatIsNoNumberIsAStatusAndLeavesTheStateAlone) {
  CartesianPendulum pendulum;
  pendulum.failure_time = 1e-9;
  const State start = pendulum.at_angle(0, 1.2, 0);
  GeneralizedAlphaIntegrator integrator({}, pendulum, start);
  const StepReport report = integrator.advance(0.01);
  EXPECT_EQ(report.status, StepStatus::not_converged);
  EXPECT_EQ(report.step, 0);
  EXPECT_EQ(integrator.state().t, 0);
  EXPECT_EQ(integrator.state().q, start.q);
}

TEST(GeneralizedAlpha, AStepThatIsNoNumberOrMovesNoTimeIsAStatus) {
  const CartesianPendulum pendulum;
  State start = pendulum.at_angle(1, 1.2, 0);
  GeneralizedAlphaIntegrator integrator({}, pendulum, start);
  for (const double step :
       {0.0, -1.0, 1e-17, std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()})
    EXPECT_EQ(integrator.advance(step).status, StepStatus::inadmissible) << step;
}

TEST(GeneralizedAlpha, ContinuesFromARestartPointAsIfItHadNotStopped) {
  const CartesianPendulum pendulum;
  GeneralizedAlphaIntegrator whole({}, pendulum, pendulum.at_angle(0, 1.2, 0));
  for (int i = 0; i < 10; ++i) ASSERT_EQ(whole.advance(0.01).status, StepStatus::converged);
  GeneralizedAlphaIntegrator restarted({}, pendulum, whole.state());
  restarted.restore(whole.state(), whole.history());
  for (int i = 0; i < 10; ++i) {
    ASSERT_EQ(whole.advance(0.01).status, StepStatus::converged);
    ASSERT_EQ(restarted.advance(0.01).status, StepStatus::converged);
  }
  EXPECT_EQ(restarted.state().q, whole.state().q);
  EXPECT_EQ(restarted.state().lambda, whole.state().lambda);
}

TEST(GeneralizedAlpha, RefusesSettingsOutOfRangeAndStartsOfTheWrongSize) {
  const CartesianPendulum pendulum;
  const State start = pendulum.at_angle(0, 1.2, 0);
  const auto make = [&](GeneralizedAlpha settings) { GeneralizedAlphaIntegrator(settings, pendulum, start); };
  EXPECT_THROW(make({.rho_infinity = 1.01}), std::invalid_argument);
  EXPECT_THROW(make({.newton_tolerance = 0}), std::invalid_argument);
  EXPECT_THROW(make({.max_iterations = 0}), std::invalid_argument);
  EXPECT_THROW(make({.max_halvings = -1}), std::invalid_argument);
  EXPECT_THROW(make({.tolerance = std::numeric_limits<double>::quiet_NaN()}), std::invalid_argument);
  EXPECT_THROW(GeneralizedAlphaIntegrator({}, pendulum, State{}), std::invalid_argument);
}

}  // namespace
}  // namespace nurbeam
