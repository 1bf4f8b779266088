#include "solver/algebra/quadratic_programme.h"

#include <gtest/gtest.h>

#include <random>

namespace nurbeam {
namespace {

// What says that x is least: within the bounds, pressed against none from behind, against none that it is not
// at, and in equilibrium with the pressures (Karush, Kuhn and Tucker).
void expect_least(const Eigen::MatrixXd& H, const Eigen::VectorXd& f, const Eigen::MatrixXd& rows,
                  const Eigen::VectorXd& bounds, const QuadraticMinimum& found) {
  const Eigen::VectorXd room = rows * found.x - bounds;
  EXPECT_GE(room.minCoeff(), -1e-9);
  EXPECT_GE(found.pressures.minCoeff(), -1e-9);
  EXPECT_LT(room.cwiseProduct(found.pressures).cwiseAbs().maxCoeff(), 1e-8);
  EXPECT_LT((H * found.x + f - rows.transpose() * found.pressures).norm(), 1e-8 * (1 + f.norm()));
}

TEST(QuadraticProgramme, MeetsWhatSaysThatItIsLeast) {
  std::mt19937 random(7);
  std::normal_distribution<double> normal;
  std::uniform_int_distribution<int> size(1, 8), integer(-1, 1);
  const auto any = [&] { return normal(random); };
  for (int problem = 0; problem < 300; ++problem) {
    const int n = size(random), m = 4 * n;
    const Eigen::MatrixXd A = Eigen::MatrixXd::NullaryExpr(n, n, any);
    const Eigen::MatrixXd H = A * A.transpose() + 0.01 * Eigen::MatrixXd::Identity(n, n);
    const Eigen::VectorXd f = 5 * Eigen::VectorXd::NullaryExpr(n, any);
    // Rows of -1, 0 and 1 depend on one another, and half the bounds meet in 0.
    Eigen::MatrixXd rows = Eigen::MatrixXd::NullaryExpr(m, n, [&] { return double(integer(random)); });
    Eigen::VectorXd bounds = -Eigen::VectorXd::NullaryExpr(m, any).cwiseAbs();
    for (int k = 0; k < m; k += 2) bounds[k] = 0;
    expect_least(H, f, rows, bounds, least_quadratic(H, f, rows, bounds, 1e-12));
  }
}

TEST(QuadraticProgramme, LetsGoOfABoundThatOthersReplace) {
  // The second is reached first; where the other two meet, it presses no more.
  const Eigen::MatrixXd H = (Eigen::Matrix2d() << 0.14, -0.036, -0.036, 0.72).finished();
  const Eigen::Vector2d f(49, 98);
  Eigen::MatrixXd rows(3, 2);
  rows << 1, 0, 0, 1, -1, 1;
  const Eigen::Vector3d bounds(-1e-4, -0.125, -1e-4);
  const QuadraticMinimum found = least_quadratic(H, f, rows, bounds, 1e-13);
  EXPECT_NEAR(found.x[0], -1e-4, 1e-12);
  EXPECT_NEAR(found.x[1], -2e-4, 1e-12);
  EXPECT_EQ(found.pressures[1], 0);
}

TEST(QuadraticProgramme, StaysWithinThoseFoundWhereNoneIsWithinAll) {
  const Eigen::MatrixXd H = Eigen::MatrixXd::Identity(1, 1);
  const Eigen::VectorXd f = Eigen::VectorXd::Constant(1, 1);
  const QuadraticMinimum found = least_quadratic(H, f, Eigen::Vector2d(1, -1), Eigen::Vector2d(2, -1), 1e-12);
  EXPECT_NEAR(found.x[0], 2, 1e-12);
}

}  // namespace
}  // namespace nurbeam
