#include "tests/support/ida/stabilised_equations.h"

#include <gtest/gtest.h>

#include <memory>

#include "solver/algebra/sundials_border.h"
#include "tests/support/small_systems.h"

namespace nurbeam {
namespace {

using Outcome = StabilisedEquations::Outcome;
using testing::CartesianPendulum;
using testing::DrivenSlider;

struct Written {
  Eigen::VectorXd y, derivative;
};

Written written(const StabilisedEquations& equations, const State& state) {
  Written result{Eigen::VectorXd(equations.size()), Eigen::VectorXd(equations.size())};
  equations.write(state, result.y, result.derivative);
  return result;
}

TEST(StabilisedEquations, AreMetByTheMotionsOfClosedForm) {
  CartesianPendulum pendulum;
  const State swinging = pendulum.at_angle(0.3, 0.7, 1.3);
  const DrivenSlider slider;
  const State driven = slider.exact(0.4);
  const std::pair<const SecondOrderSystem*, State> motions[] = {{&pendulum, swinging}, {&slider, driven}};
  for (const auto& [system, state] : motions) {
    StabilisedEquations equations(*system, state, 0.05);
    const Written at = written(equations, state);
    Eigen::VectorXd rows(equations.size());
    ASSERT_EQ(equations.residual(state.t, at.y, at.derivative, rows), Outcome::finite);
    EXPECT_LT(rows.lpNorm<Eigen::Infinity>(), 1e-14);
  }
}

TEST(StabilisedEquations, ReadBackWhatTheyWrite) {
  const CartesianPendulum pendulum;
  const State state = pendulum.at_angle(0.3, 0.7, 1.3);
  const StabilisedEquations equations(pendulum, state, 0.05);
  const Written at = written(equations, state);
  State back = pendulum.at_angle(0, 0, 0);
  equations.read(state.t, at.y, at.derivative, back);
  EXPECT_EQ(back.t, state.t);
  EXPECT_LT((back.q - state.q).norm() + (back.v - state.v).norm(), 1e-14);
  EXPECT_LT((back.a - state.a).norm() + (back.lambda - state.lambda).norm(), 1e-13);
}

TEST(StabilisedEquations, ARowsOfMuFollowsTheDriftOfVelocityAndItsOwnForce) {
  // With m = 1 the rows of T x' - w lose H'm, and nothing else changes.
  const CartesianPendulum pendulum;
  const State state = pendulum.at_angle(0, 0.7, 1.3);
  StabilisedEquations equations(pendulum, state, 0.05);
  Written at = written(equations, state);
  Eigen::VectorXd rows(equations.size()), with(equations.size());
  ASSERT_EQ(equations.residual(0, at.y, at.derivative, rows), Outcome::finite);
  at.y.tail(1).setOnes();
  ASSERT_EQ(equations.residual(0, at.y, at.derivative, with), Outcome::finite);
  const Eigen::Vector2d H = state.q / state.q.lpNorm<1>();  // G s / sum |G| s
  EXPECT_LT((with.head<2>() - rows.head<2>() + H).norm(), 1e-14);
  EXPECT_EQ(with.tail(4), rows.tail(4));
}

TEST(StabilisedEquations, TheJacobianIsTheDerivativeOfTheRows) {
  CartesianPendulum pendulum;
  const State state = pendulum.at_angle(0, 0.7, 1.3);
  StabilisedEquations equations(pendulum, state, 0.05);
  const Written at = written(equations, state);
  const int size = equations.size();
  const sundials::Owner<_SUNContext> context(sundials::new_context());
  const sundials::Owner<_generic_SUNMatrix> matrix(
      SUNSparseMatrix(size, size, equations.entry_count(), CSC_MAT, context.get()));
  const double cj = 1.7;
  ASSERT_TRUE(equations.jacobian(0, cj, at.y, at.derivative, matrix.get()));
  Eigen::MatrixXd dense = Eigen::MatrixXd::Zero(size, size);
  const sunindextype* starts = SUNSparseMatrix_IndexPointers(matrix.get());
  EXPECT_LE(starts[size], equations.entry_count());
  for (int j = 0; j < size; ++j)
    for (sunindextype k = starts[j]; k < starts[j + 1]; ++k)
      dense(SUNSparseMatrix_IndexValues(matrix.get())[k], j) = SUNSparseMatrix_Data(matrix.get())[k];
  constexpr double h = 1e-4;
  for (int j = 0; j < size; ++j) {
    const Eigen::VectorXd step = h * Eigen::VectorXd::Unit(size, j);
    Eigen::VectorXd forward(size), backward(size);
    ASSERT_EQ(equations.residual(0, at.y + step, at.derivative + cj * step, forward), Outcome::finite);
    ASSERT_EQ(equations.residual(0, at.y - step, at.derivative - cj * step, backward), Outcome::finite);
    const Eigen::VectorXd column = (forward - backward) / (2 * h);
    // The rows of G v take theirs from a difference along the velocity, to the root of the round-off.
    EXPECT_LT((column - dense.col(j)).lpNorm<Eigen::Infinity>(), 1e-6) << j;
  }
}

TEST(StabilisedEquations, SayWhyThereAreNoRows) {
  CartesianPendulum pendulum;
  pendulum.failure_time = 1;
  pendulum.wall = 1.2;
  const State state = pendulum.at_angle(0, 0.7, 1.3);
  StabilisedEquations equations(pendulum, state, 0.05);
  Written at = written(equations, state);
  Eigen::VectorXd rows(equations.size());
  EXPECT_EQ(equations.residual(1, at.y, at.derivative, rows), Outcome::not_finite);
  at.y[0] = 1;  // x = length
  EXPECT_EQ(equations.residual(0, at.y, at.derivative, rows), Outcome::inadmissible);
  EXPECT_TRUE(equations.regular(state));
}

}  // namespace
}  // namespace nurbeam
