#include "solver/system/near_kkt.h"

#include <gtest/gtest.h>

#include <Eigen/SparseLU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace nurbeam {
namespace {

using Matrix = Eigen::SparseMatrix<double>;

/// A chain of masses of linear elements, each with the mass of its place, so that what one row is open by
/// fades by 0.27 from each to the next; the first is held, and two are tied together.
class Chain final : public SecondOrderSystem {
 public:
  static constexpr int masses = 600, tied = 300;

  Chain() : pattern_(matrix(Eigen::VectorXd::Zero(masses))) {}

  Matrix matrix(const Eigen::VectorXd& q) const {
    std::vector<Eigen::Triplet<double>> entries;
    const auto couple = [&](int i, int j, double value) {
      entries.emplace_back(i, j, value);
      if (i != j) entries.emplace_back(j, i, value);
    };
    for (int i = 0; i < masses; ++i) {
      couple(i, i, 4.0 + 0.3 * std::sin(i) + q[i]);
      if (i + 1 < masses) couple(i, i + 1, 1);
    }
    couple(masses, 0, 1);
    couple(masses, masses, 0);
    couple(masses + 1, tied, 1);
    couple(masses + 1, tied + 1, -1);
    couple(masses + 1, masses + 1, 0);
    Matrix all(masses + 2, masses + 2);
    all.setFromTriplets(entries.begin(), entries.end());
    return all;
  }

  int coordinate_count() const override { return masses; }
  int constraint_count() const override { return 2; }
  void residual(const State&, Eigen::Ref<Eigen::VectorXd>, Eigen::Ref<Eigen::VectorXd>) const override {}
  const SparsePattern& tangent_pattern() const override { return pattern_; }
  void tangent(const State& state, const TangentWeights&, SparseValues kkt) const override {
    const Matrix own = matrix(state.q);
    std::copy_n(own.valuePtr(), own.nonZeros(), kkt.valuePtr());
  }
  Eigen::VectorXd constraint_rate(const State&) const override { return Eigen::VectorXd::Zero(2); }
  Eigen::VectorXd constraint_curvature(const State&) const override { return Eigen::VectorXd::Zero(2); }

 private:
  SparsePattern pattern_;
};

struct Problem {
  Chain chain;
  State state;
  Eigen::VectorXd x, y, right;  ///< closed but in the rows of two masses

  explicit Problem(int open) : y(Eigen::VectorXd::LinSpaced(2, 0.4, -0.3)) {
    state.q = Eigen::VectorXd::Zero(Chain::masses);
    x = Eigen::VectorXd::LinSpaced(Chain::masses, 1, 3).array().sin();
    x[0] = 0;
    x[Chain::tied + 1] = x[Chain::tied];
    right = chain.matrix(state.q) * all();
    right[open] += 0.7;
    right[open + 2] -= 0.2;
  }

  Eigen::VectorXd all() const {
    Eigen::VectorXd both(x.size() + y.size());
    both << x, y;
    return both;
  }
  Eigen::VectorXd exact() const {
    Eigen::SparseLU<Matrix> lu(chain.matrix(state.q));
    return lu.solve(right);
  }
  bool correct(const NearKkt& near) { return near.correct(right.head(x.size()), right.tail(y.size()), x, y); }
};

TEST(CouplingLevels, AreThoseOfAChainWithConstraintsBesideWhatTheyHold) {
  const Chain chain;
  const CouplingLevels levels(chain.tangent_pattern(), Chain::masses, {Chain::tied - 3}, 6);
  ASSERT_EQ(levels.count(), 6);
  EXPECT_EQ(levels.starts, (std::vector<int>{0, 1, 3, 5, 7, 10, 12}));
  EXPECT_EQ(levels.unknowns[7], Chain::tied - 7);
  EXPECT_EQ(levels.unknowns[8], Chain::tied + 1);
  EXPECT_EQ(levels.unknowns[9], Chain::masses + 1) << "with the farther one of the two that it ties";
  const CouplingLevels at_end(chain.tangent_pattern(), Chain::masses, {0}, 2);
  EXPECT_EQ(at_end.unknowns, (std::vector<int>{0, Chain::masses, 1})) << "one with what it holds";
}

TEST(NearKkt, SolvesAsForAllWhereWhatIsOpenFades) {
  for (const int open : {1, 250, Chain::tied - 2, Chain::masses - 3}) {
    Problem problem(open);
    const Eigen::VectorXd start = problem.x, exact = problem.exact();
    NearKkt near(problem.chain, {open, open + 2}, 30);
    ASSERT_TRUE(near.factorise(problem.state, 0));
    ASSERT_TRUE(problem.correct(near));
    EXPECT_LT((problem.all() - exact).lpNorm<Eigen::Infinity>(), 2e-15) << open;
    EXPECT_GT(std::abs(problem.x[open] - start[open]), 0.01);
    for (int i = 0; i < Chain::masses; ++i)
      if (std::abs(i - open) > 34) EXPECT_EQ(problem.x[i], start[i]) << i;
  }
}

TEST(NearKkt, ChangesNothingWhereThatDoesNotSuffice) {
  Problem problem(250);
  const Eigen::VectorXd start = problem.all();
  NearKkt near(problem.chain, {250, 252}, 5);
  ASSERT_TRUE(near.factorise(problem.state, 0));
  EXPECT_FALSE(problem.correct(near));
  EXPECT_EQ(problem.all(), start);
}

TEST(NearKkt, HasTheUnknownsWithinItsReach) {
  const Problem problem(250);
  std::vector<int> expected;
  for (int i = 245; i <= 255; ++i) expected.push_back(i);
  EXPECT_EQ(NearKkt(problem.chain, {250}, 5).unknowns(), expected);
}

// By 1e-4 of what is open there; beyond it is as it was.
TEST(NearKkt, AnswersWhatIsOpenWhereThatFades) {
  for (const auto& [reach, fades] : {std::pair{4, false}, {9, true}}) {
    Problem problem(250);
    const Eigen::VectorXd start = problem.all();
    Eigen::VectorXd open = problem.right - problem.chain.matrix(problem.state.q) * start;
    open[250 + 2 + reach + 1] += 0.3;
    open[400] += 5;
    NearKkt near(problem.chain, {250, 252}, reach);
    ASSERT_TRUE(near.factorise(problem.state, 0));
    EXPECT_EQ(near.answer(open.head(start.size() - 2), open.tail(2), problem.x, problem.y), fades) << reach;
    if (!fades) EXPECT_EQ(problem.all(), start);
    if (!fades) continue;
    const Eigen::VectorXd left = open - problem.chain.matrix(problem.state.q) * (problem.all() - start);
    for (int i = 0; i < Chain::masses; ++i)
      if (i >= 250 - reach && i <= 252 + reach)
        EXPECT_NEAR(left[i], 0, 1e-14) << i;
      else
        EXPECT_NEAR(left[i], open[i], 1e-4) << i;
  }
}

// What has been eliminated of one matrix serves the next, which differs in some of its masses.
TEST(NearKkt, TakesTheNextMatrixAsOneThatIsMadeAnew) {
  Problem problem(250);
  NearKkt near(problem.chain, {250, 252}, 40);
  ASSERT_TRUE(near.factorise(problem.state, 0));
  for (const int changed : {250, 253, 256, 248}) {
    problem.state.q[changed] += 0.5;
    Problem fresh = problem;
    ASSERT_TRUE(near.factorise(problem.state, 0));
    ASSERT_TRUE(problem.correct(near));
    NearKkt anew(fresh.chain, {250, 252}, 40);
    ASSERT_TRUE(anew.factorise(fresh.state, 0));
    ASSERT_TRUE(fresh.correct(anew));
    EXPECT_EQ(problem.all(), fresh.all()) << changed;
    EXPECT_LT((problem.all() - problem.exact()).lpNorm<Eigen::Infinity>(), 2e-15) << changed;
  }
}

TEST(NearKkt, RefusesWhatCannotBeEliminatedSo) {
  Problem problem(250);
  problem.state.q[251] = std::numeric_limits<double>::quiet_NaN();
  NearKkt near(problem.chain, {250, 252}, 30);
  EXPECT_FALSE(near.factorise(problem.state, 0));
}

}  // namespace
}  // namespace nurbeam
