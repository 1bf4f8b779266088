#include "solver/rest/mechanism.h"

#include <gtest/gtest.h>

#include <cmath>
#include <utility>

#include "tests/support/dense_system.h"

namespace nurbeam {
namespace {

using testing::DenseSystem;

/// A mass (x, y) on a rod of length 1 about the origin, under a weight w along -y and with a spring k that
/// pulls it to y = 0.
class Pendulum : public DenseSystem {
 public:
  double weight = 0, spring = 0, scale = 1;

  int coordinate_count() const override { return 2; }
  int constraint_count() const override { return 1; }
  Eigen::VectorXd coordinate_scale() const override { return Eigen::VectorXd::Constant(2, scale); }
  void residual(const State& state, Eigen::Ref<Eigen::VectorXd> dynamics,
                Eigen::Ref<Eigen::VectorXd> constraints) const override {
    dynamics = state.a + state.lambda[0] * state.q;
    dynamics[1] += state.load * weight + spring * state.q[1];
    constraints[0] = (state.q.squaredNorm() - 1) / 2;
  }

 protected:
  Eigen::MatrixXd mass(const State&) const override { return Eigen::MatrixXd::Identity(2, 2); }
  Eigen::MatrixXd stiffness(const State& state) const override {
    Eigen::MatrixXd K = state.lambda[0] * Eigen::MatrixXd::Identity(2, 2);
    K(1, 1) += spring;
    return K;
  }
  Eigen::MatrixXd constraint_jacobian(const State& state) const override { return state.q.transpose(); }
};

State at_rest(double x, double y, double lambda) {
  State state;
  state.q = Eigen::Vector2d(x, y);
  state.v = state.a = Eigen::Vector2d::Zero();
  state.lambda = Eigen::VectorXd::Constant(1, lambda);
  state.load = 1;
  return state;
}

TEST(Mechanism, IsARodThatNothingTurnsBack) {
  Pendulum rod;
  for (const double scale : {1.0, 4.0, 0.25}) {
    rod.scale = scale;
    const auto motion = find_mechanism(rod, at_rest(0.6, 0.8, 0));
    ASSERT_TRUE(motion);
    EXPECT_NEAR(std::abs((*motion)[0]), scale, 1e-9);
    EXPECT_NEAR((*motion)[0] * 0.6 + (*motion)[1] * 0.8, 0, 1e-9);
  }
}

TEST(Mechanism, IsNoneWhereAWeightTurnsItBack) {
  Pendulum hanging;
  hanging.weight = 3;
  EXPECT_FALSE(find_mechanism(hanging, at_rest(0, -1, 3)));
}

TEST(Mechanism, IsNoneWhereASoftSpringTurnsItBack) {
  Pendulum held;
  for (const double spring : {1.0, 1e-6, 1e-11}) {
    held.spring = spring;
    EXPECT_FALSE(find_mechanism(held, at_rest(1, 0, 0))) << spring;
  }
}

/// Stiff beside soft: y has no stiffness to first order, but a force -c y^3.
class Flat : public DenseSystem {
 public:
  int coordinate_count() const override { return 2; }
  int constraint_count() const override { return 0; }
  Eigen::VectorXd coordinate_scale() const override { return Eigen::VectorXd::Ones(2); }
  void residual(const State& state, Eigen::Ref<Eigen::VectorXd> dynamics,
                Eigen::Ref<Eigen::VectorXd>) const override {
    dynamics = state.a;
    dynamics[0] += state.q[0] - 1;
    dynamics[1] += std::pow(state.q[1], 3);
  }

 protected:
  Eigen::MatrixXd mass(const State&) const override { return Eigen::MatrixXd::Identity(2, 2); }
  Eigen::MatrixXd stiffness(const State& state) const override {
    return Eigen::Vector2d(1, 3 * state.q[1] * state.q[1]).asDiagonal();
  }
};

TEST(Mechanism, IsNoneWhereOnlyTheLinearForceIsZero) {
  State state;
  state.q = Eigen::Vector2d(1, 0);
  state.v = state.a = Eigen::Vector2d::Zero();
  state.lambda.resize(0);
  state.load = 1;
  EXPECT_FALSE(find_mechanism(Flat{}, state));
}

}  // namespace
}  // namespace nurbeam
