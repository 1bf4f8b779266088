#include "solver/rest/kinsol.h"

#include <gtest/gtest.h>

#include <stdexcept>

#include "tests/support/small_systems.h"

namespace nurbeam {
namespace {

using testing::CartesianPendulum;

/// A pendulum whose residual throws below a height.
class Throwing : public CartesianPendulum {
 public:
  void residual(const State& state, Eigen::Ref<Eigen::VectorXd> dynamics,
                Eigen::Ref<Eigen::VectorXd> constraints) const override {
    if (state.q[1] < -1.4) throw std::domain_error("too low");
    CartesianPendulum::residual(state, dynamics, constraints);
  }
};

TEST(Kinsol, BringsAPendulumToItsRestWithinAFewNewtonSteps) {
  const CartesianPendulum pendulum;
  const State start = pendulum.at_angle(0, 0.5, 0);
  ScaledEquations equations(pendulum, start);
  equations.rescale(start, pendulum.point_mass * pendulum.gravity * pendulum.length);
  Kinsol solver(equations);
  Eigen::VectorXd x = equations.scaled_unknowns(start);
  const int iterations = solver.improve(x, Eigen::Vector3d::Constant(1e-13), KIN_LINESEARCH, 30);
  EXPECT_GT(iterations, 2);
  EXPECT_LT(iterations, 12);
  const State& found = equations.state_of(x);
  const State hanging = pendulum.at_angle(0, 0, 0);
  EXPECT_LT((found.q - hanging.q).norm(), 1e-12);
  EXPECT_NEAR(found.lambda[0], hanging.lambda[0], 1e-11);
}

TEST(Kinsol, StopsAtTheIterationsAllowedAndKeepsWhatItReached) {
  const CartesianPendulum pendulum;
  const State start = pendulum.at_angle(0, 0.5, 0);
  ScaledEquations equations(pendulum, start);
  equations.rescale(start, 1);
  Kinsol solver(equations);
  Eigen::VectorXd x = equations.scaled_unknowns(start);
  const double before = equations.quality(x, 0).residual_norm;
  EXPECT_EQ(solver.improve(x, Eigen::Vector3d::Constant(1e-13), KIN_LINESEARCH, 1), 1);
  EXPECT_LT(equations.quality(x, 0).residual_norm, before);
}

TEST(Kinsol, AnErrorOfTheSystemComesOutOfItsFrames) {
  const Throwing pendulum;
  const State start = pendulum.at_angle(0, 0.5, 0);
  ScaledEquations equations(pendulum, start);
  equations.rescale(start, 1);
  Kinsol solver(equations);
  Eigen::VectorXd x = equations.scaled_unknowns(start);
  EXPECT_THROW(solver.improve(x, Eigen::Vector3d::Constant(1e-13), KIN_NONE, 30), std::domain_error);
}

}  // namespace
}  // namespace nurbeam
