#include "solver/kkt_solver.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <limits>

namespace nurbeam {
namespace {

Eigen::MatrixXd saddle_point() {
  Eigen::MatrixXd matrix(3, 3);
  matrix << 4, 1, 2, 1, 3, -1, 2, -1, 0;
  return matrix;
}

TEST(KktSolver, SolvesASaddlePointSystemToRoundOff) {
  const Eigen::SparseMatrix<double> matrix = saddle_point().sparseView();
  const Eigen::Vector3d expected(1, -2, 3);
  KktSolver solver;
  ASSERT_TRUE(solver.factorise(matrix));
  EXPECT_LT((solver.solve(matrix * expected) - expected).norm(), 1e-14);
}

TEST(KktSolver, FollowsAChangeOfValuesOfPatternAndOfSize) {
  KktSolver solver;
  Eigen::MatrixXd diagonal_apart = saddle_point();
  diagonal_apart(0, 0) = 0;
  diagonal_apart(2, 2) = 5;
  for (const Eigen::MatrixXd& dense : {saddle_point(), Eigen::MatrixXd(2 * saddle_point()), diagonal_apart,
                                       Eigen::MatrixXd(saddle_point().topLeftCorner(2, 2))}) {
    const Eigen::SparseMatrix<double> matrix = dense.sparseView();
    const Eigen::VectorXd expected = Eigen::VectorXd::LinSpaced(dense.rows(), 1, 2);
    ASSERT_TRUE(solver.factorise(matrix));
    EXPECT_LT((solver.solve(matrix * expected) - expected).norm(), 1e-14);
  }
}

TEST(KktSolver, ReportsASingularMatrixAndRecoversFromIt) {
  Eigen::MatrixXd dense = saddle_point();
  dense.col(2) = dense.col(0) / 3;
  const Eigen::SparseMatrix<double> singular = dense.sparseView();
  const Eigen::SparseMatrix<double> regular = saddle_point().sparseView();
  KktSolver solver;
  EXPECT_FALSE(solver.factorise(singular));
  EXPECT_TRUE(solver.factorise(regular));
}

TEST(KktSolver, ReportsANumericallySingularMatrix) {
  Eigen::MatrixXd dense(3, 3);
  dense << 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9;
  const Eigen::SparseMatrix<double> matrix = dense.sparseView();
  KktSolver solver;
  EXPECT_FALSE(solver.factorise(matrix));
}

TEST(KktSolver, ReportsAStructurallySingularMatrix) {
  Eigen::SparseMatrix<double> matrix(2, 2);
  matrix.insert(0, 0) = 1;
  matrix.insert(0, 1) = 1;
  matrix.makeCompressed();
  KktSolver solver;
  EXPECT_FALSE(solver.factorise(matrix));
}

TEST(KktSolver, ReportsAMatrixThatHoldsNoNumber) {
  Eigen::MatrixXd dense = saddle_point();
  dense(1, 1) = std::numeric_limits<double>::quiet_NaN();
  const Eigen::SparseMatrix<double> matrix = dense.sparseView();
  KktSolver solver;
  EXPECT_FALSE(solver.factorise(matrix));
}

}  // namespace
}  // namespace nurbeam
