#include "solver/algebra/local_solution.h"

#include <gtest/gtest.h>

#include <Eigen/SparseLU>
#include <vector>

namespace nurbeam {
namespace {

using Matrix = Eigen::SparseMatrix<double>;
using Entry = Eigen::Triplet<double>;

Matrix matrix_of(int size, const std::vector<Entry>& entries) {
  Matrix A(size, size);
  A.setFromTriplets(entries.begin(), entries.end());
  return A;
}

// A chain of masses of linear elements: what one row is open by fades by 0.27 from each to the next.
std::vector<Entry> chain_of_masses(int n) {
  std::vector<Entry> entries;
  for (int i = 0; i < n; ++i) {
    entries.emplace_back(i, i, 4.0 + 0.3 * std::sin(i));
    if (i + 1 == n) continue;
    entries.emplace_back(i, i + 1, 1);
    entries.emplace_back(i + 1, i, 1);
  }
  return entries;
}

Eigen::VectorXd solved(const Matrix& A, const Eigen::VectorXd& b) {
  Eigen::SparseLU<Matrix> lu(A);
  return lu.solve(b);
}

TEST(LocalSolution, MovesNothingFarFromWhatIsOpen) {
  constexpr int n = 600, open = 250;
  const Matrix A = matrix_of(n, chain_of_masses(n));
  for (const bool at_rest : {false, true}) {
    Eigen::VectorXd x = Eigen::VectorXd::Zero(n);
    if (!at_rest) x = Eigen::VectorXd::LinSpaced(n, 1, 3).array().sin();
    const Eigen::VectorXd start = x;
    Eigen::VectorXd b = A * x;
    b[open] += 0.7;
    b[open + 3] -= 0.2;
    ASSERT_TRUE(correct_locally(A, b, {}, x));
    const Eigen::VectorXd exact = solved(A, b);
    EXPECT_LT((x - exact).lpNorm<Eigen::Infinity>(), 1e-15 * std::max(1.0, exact.norm()));
    EXPECT_GT(std::abs(x[open + 10] - start[open + 10]), 1e-9);
    for (const int far : {0, open - 60, open + 60, n - 1}) EXPECT_EQ(x[far], start[far]) << far;
  }
}

TEST(LocalSolution, LeavesWhatIsClosed) {
  const Matrix A = matrix_of(50, chain_of_masses(50));
  const Eigen::VectorXd start = Eigen::VectorXd::LinSpaced(50, -1, 1);
  Eigen::VectorXd x = start;
  ASSERT_TRUE(correct_locally(A, A * x, {}, x));
  EXPECT_EQ(x, start);
}

// A row that ties two far places together belongs to the window of the first.
TEST(LocalSolution, FollowsAConstraint) {
  constexpr int n = 600, a = 100, b = 500;
  std::vector<Entry> entries = chain_of_masses(n);
  for (const auto& [at, factor] : {std::pair{a, 1.0}, std::pair{b, -1.0}}) {
    entries.emplace_back(n, at, factor);
    entries.emplace_back(at, n, factor);
  }
  entries.emplace_back(n, n, 0);
  const Matrix A = matrix_of(n + 1, entries);
  Eigen::VectorXd x = Eigen::VectorXd::Zero(n + 1), rhs = x;
  rhs[a + 2] = 1;
  ASSERT_TRUE(correct_locally(A, rhs, {n}, x));
  const Eigen::VectorXd exact = solved(A, rhs);
  EXPECT_LT((x - exact).lpNorm<Eigen::Infinity>(), 1e-15);
  EXPECT_NEAR(x[a], x[b], 1e-15);
  EXPECT_GT(std::abs(x[b]), 1e-3);
  EXPECT_EQ(x[300], 0);
}

// Stiffness carries it to both ends.
TEST(LocalSolution, SolvesForAllWhereNothingFades) {
  constexpr int n = 300;
  std::vector<Entry> entries;
  for (int i = 0; i < n; ++i) {
    entries.emplace_back(i, i, 2);
    if (i > 0) entries.emplace_back(i, i - 1, -1);
    if (i + 1 < n) entries.emplace_back(i, i + 1, -1);
  }
  const Matrix A = matrix_of(n, entries);
  Eigen::VectorXd x = Eigen::VectorXd::Zero(n), b = x;
  b[120] = 1;
  ASSERT_TRUE(correct_locally(A, b, {}, x));
  EXPECT_LT((A * x - b).lpNorm<Eigen::Infinity>(), 1e-12);
  EXPECT_GT(x[5], 1);
}

TEST(LocalSolution, IsNoneOfASingularMatrix) {
  std::vector<Entry> entries = chain_of_masses(20);
  entries.emplace_back(20, 20, 0);
  const Matrix A = matrix_of(21, entries);
  const Eigen::VectorXd start = Eigen::VectorXd::Zero(21);
  Eigen::VectorXd x = start, b = start;
  b[20] = 1;
  EXPECT_FALSE(correct_locally(A, b, {}, x));
  EXPECT_EQ(x, start);
}

}  // namespace
}  // namespace nurbeam
