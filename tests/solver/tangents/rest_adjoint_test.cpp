#include "solver/tangents/rest_adjoint.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

namespace nurbeam {
namespace {

using Vector = Eigen::VectorXd;

constexpr int n = 40, m = 3, parameters = 60;

/// The tangent of a chain whose forces depend on its multipliers too: not symmetric.
Eigen::SparseMatrix<double> uneven_tangent() {
  Eigen::MatrixXd K = Eigen::MatrixXd::Zero(n + m, n + m);
  for (int i = 0; i < n; ++i)
    for (int j = std::max(0, i - 3); j < std::min(n, i + 4); ++j)
      K(i, j) = (i == j ? 1e3 : 0) + 100 * std::sin(3.1 * i + 1.7 * j);
  for (int c = 0; c < m; ++c)
    for (int i = 13 * c; i < 13 * c + 4; ++i) {
      K(n + c, i) = 0.5 + std::cos(2.3 * i);
      K(i, n + c) = K(n + c, i) + 0.1 * std::sin(i);
    }
  return K.sparseView();
}

MotionTangents::Matrix residuals(int rows) {
  return MotionTangents::Matrix::NullaryExpr(
      rows, parameters,
      [](Eigen::Index i, Eigen::Index k) {
        return std::sin(1.3 * static_cast<double>(i) + 0.7 * static_cast<double>(k * k));
      });
}

struct Fixture {
  Eigen::SparseMatrix<double> tangent = uneven_tangent();
  State rest;
  MotionTangents::Matrix dynamics = residuals(n), constraints = residuals(m);
  Fixture() {
    rest.q = Vector::LinSpaced(n, 0.2, 1.9);
    rest.v = rest.a = Vector::Zero(n);
    rest.lambda = Vector::LinSpaced(m, -30, 45);
  }
  /// By a solution for each parameter.
  Eigen::MatrixXd direct(const Eigen::MatrixXd& by_unknowns) const {
    Eigen::MatrixXd residual(n + m, parameters);
    residual << dynamics, constraints;
    return -by_unknowns.transpose() * Eigen::MatrixXd(tangent).partialPivLu().solve(residual);
  }
};

TEST(RestAdjoint, IsWhatASolutionForEachParameterGives) {
  const Fixture of;
  const RestAdjoint adjoint(of.rest, Vector::Ones(n), of.tangent);
  ASSERT_TRUE(adjoint.regular());
  int evaluations = 0;
  const auto quantities = [&](const State& at) {
    ++evaluations;
    return Vector(Eigen::Vector3d(std::exp(at.q[7]) * at.q[8], at.lambda[1] * std::sin(at.q[20]), 5));
  };
  Eigen::MatrixXd by = Eigen::MatrixXd::Zero(n + m, 3);
  by(7, 0) = std::exp(of.rest.q[7]) * of.rest.q[8];
  by(8, 0) = std::exp(of.rest.q[7]);
  by(20, 1) = of.rest.lambda[1] * std::cos(of.rest.q[20]);
  by(n + 1, 1) = std::sin(of.rest.q[20]);
  const Eigen::MatrixXd expected = of.direct(by);
  const Eigen::MatrixXd found = adjoint.through_rest(quantities, of.dynamics, of.constraints);
  EXPECT_LT((found - expected).cwiseAbs().maxCoeff(), 1e-10 * expected.cwiseAbs().maxCoeff());
  EXPECT_TRUE(found.row(2).isZero(0));
  EXPECT_LT(evaluations, n + m + 30);  // of 4 unknowns, found by halving
}

TEST(RestAdjoint, TakesWhatChangesWithAllUnknowns) {
  const Fixture of;
  const RestAdjoint adjoint(of.rest, Vector::Ones(n), of.tangent);
  const auto quantities = [&](const State& at) {
    return Vector(Vector::Constant(1, at.q.squaredNorm() + at.q.sum() * at.lambda.sum()));
  };
  Eigen::MatrixXd by(n + m, 1);
  by << 2 * of.rest.q + Vector::Constant(n, of.rest.lambda.sum()), Vector::Constant(m, of.rest.q.sum());
  const Eigen::MatrixXd expected = of.direct(by);
  EXPECT_LT((adjoint.through_rest(quantities, of.dynamics, of.constraints) - expected).cwiseAbs().maxCoeff(),
            1e-10 * expected.cwiseAbs().maxCoeff());
}

TEST(RestAdjoint, IsNotRegularWhereNothingHolds) {
  const Fixture of;
  Eigen::SparseMatrix<double> loose = of.tangent;
  for (int k = 0; k < loose.outerSize(); ++k)
    for (Eigen::SparseMatrix<double>::InnerIterator entry(loose, k); entry; ++entry)
      if (entry.row() == 5) entry.valueRef() = 0;
  EXPECT_FALSE(RestAdjoint(of.rest, Vector::Ones(n), loose).regular());
}

}  // namespace
}  // namespace nurbeam
