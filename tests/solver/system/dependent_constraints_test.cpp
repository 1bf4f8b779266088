#include "solver/system/dependent_constraints.h"

#include <gtest/gtest.h>

#include "tests/support/dense_system.h"

namespace nurbeam {
namespace {

/// Coordinates of unit mass with constraints of the given gradient.
class Constrained final : public testing::DenseSystem {
 public:
  explicit Constrained(Eigen::MatrixXd gradient) : gradient_(std::move(gradient)) {}

  int coordinate_count() const override { return static_cast<int>(gradient_.cols()); }
  int constraint_count() const override { return static_cast<int>(gradient_.rows()); }
  void residual(const State& state, Eigen::Ref<Eigen::VectorXd> dynamics,
                Eigen::Ref<Eigen::VectorXd> constraints) const override {
    dynamics = state.a;
    constraints = gradient_ * state.q;
  }

 private:
  Eigen::MatrixXd mass(const State&) const override {
    return Eigen::MatrixXd::Identity(gradient_.cols(), gradient_.cols());
  }
  Eigen::MatrixXd stiffness(const State&) const override {
    return Eigen::MatrixXd::Zero(gradient_.cols(), gradient_.cols());
  }
  Eigen::MatrixXd constraint_jacobian(const State&) const override { return gradient_; }

  Eigen::MatrixXd gradient_;
};

TEST(DependentConstraints, AreThoseThatAddUpToNothing) {
  Eigen::MatrixXd gradient(5, 6);
  gradient << 1, 0, 0, 0, 0, 0,  //
      0, 2, 0, 0, 0, 0,          //
      3, -4, 0, 0, 0, 0,         // of the two before
      0, 0, 1, 1, 0, 0,          //
      0, 0, 1, 1.001, 0, 0;      // nearly, but not
  const auto found = dependent_constraints(Constrained(gradient), State{});
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].rows, (std::vector<int>{0, 1, 2}));
  EXPECT_EQ(found[0].coordinates, (std::vector<int>{0, 1}));
}

TEST(DependentConstraints, AreOneThatFixesNothingAndNoneElse) {
  Eigen::MatrixXd gradient = Eigen::MatrixXd::Identity(2, 3);
  EXPECT_TRUE(dependent_constraints(Constrained(gradient), State{}).empty());
  gradient.row(1).setZero();
  const auto found = dependent_constraints(Constrained(gradient), State{});
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].rows, (std::vector<int>{1}));
}

}  // namespace
}  // namespace nurbeam
